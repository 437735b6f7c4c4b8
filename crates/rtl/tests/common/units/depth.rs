//! DEPTH alone.

use edgewalk_machine::Plan;
use edgewalk_model::depth::{Depth, DepthInputs};
use edgewalk_model::tokens::Fragment;
use edgewalk_model::{Coverage, Write};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

use super::{Stream, rgb, source};
use crate::common::probe::{Failure, Probe};
use crate::common::tokens;

/// DEPTH: fragments on few pixels, depths that come at random, everything taken at random.
pub fn depth(machine: &Plan, cycles: u64, rng: &mut Pcg64Mcg) -> Result<Probe, Failure> {
    let mut probe = Probe::new(edgewalk_rtl::depth(machine))?;
    let inputs = ["depth_func", "depth_write", "frag_valid", "rd_ready", "data_valid", "data_z", "wr_ready"];
    let [func, write, frag_valid, rd_ready, data_valid, data_z, wr_ready] =
        inputs.map(|name| probe.input(name));
    let (func, write, frag_valid, rd_ready) = (func?, write?, frag_valid?, rd_ready?);
    let (data_valid, data_z, wr_ready) = (data_valid?, data_z?, wr_ready?);
    let frag = probe.input_channel("frag", &tokens::fragment(machine, &Fragment::default()))?;
    let ports = ["frag_ready", "rd_valid", "rd_addr", "data_ready", "wr_valid", "occupied"];
    let [frag_ready, rd_valid, rd_addr, data_ready, wr_valid, occupied] =
        ports.map(|name| probe.port("depth", name, name));
    let (frag_ready, rd_valid, rd_addr) = (frag_ready?, rd_valid?, rd_addr?);
    let (data_ready, wr_valid, occupied) = (data_ready?, wr_valid?, occupied?);
    let wr = probe.channel("depth", "", "wr", &tokens::write(machine, &Write::default()))?;
    let (mut model, mut stream) = (Depth::new(machine), Stream { token: None });
    let often: [f64; 3] = std::array::from_fn(|_| rng.random_range(0.2..1.0));
    let (depth_func, depth_write) = (rng.random_range(0..8), rng.random_bool(0.9));
    let few = 1 + machine.z.max().min(3);
    probe.reset()?;
    while probe.cycle < cycles {
        stream.next(rng, |rng| Fragment {
            addr: rng.random_range(0..3.min(1 << machine.widths().address)),
            z: rng.random_range(0..few) as u32, // at most 4
            rgb: rgb(machine, rng),
            fence: rng.random_bool(0.3),
            source: source(machine, rng),
        });
        let inputs = DepthInputs {
            depth_func,
            depth_write,
            rd_ready: rng.random_bool(often[0]),
            data: rng.random_bool(often[1]).then(|| rng.random_range(0..few)),
            wr_ready: rng.random_bool(often[2]),
        };
        probe.set(func, depth_func);
        probe.set(write, depth_write);
        probe.set(frag_valid, stream.token.is_some());
        probe.set(rd_ready, inputs.rd_ready);
        probe.set(data_valid, inputs.data.is_some());
        probe.set(data_z, inputs.data.unwrap_or(0));
        probe.set(wr_ready, inputs.wr_ready);
        let block = model.block(stream.token.as_ref(), depth_write);
        if let Some(token) = &stream.token {
            probe.set_channel(&frag, &tokens::fragment(machine, token));
            probe.check(&frag_ready, inputs.rd_ready && block.is_none())?;
        }
        let reads = stream.token.filter(|_| block.is_none());
        probe.check(&rd_valid, reads.is_some())?;
        if let Some(read) = reads {
            probe.check(&rd_addr, read.addr)?;
        }
        probe.check(&data_ready, model.data_ready(inputs.wr_ready))?;
        probe.check(&wr_valid, model.write().is_some())?;
        if let Some(expected) = model.write() {
            probe.check_channel(&wr, &tokens::write(machine, expected))?;
        }
        probe.check(&occupied, model.occupied())?;
        probe.tick();
        model.step(stream.token.as_ref(), block, &inputs, &mut Coverage::default());
        stream.taken(reads.is_some() && inputs.rd_ready);
    }
    Ok(probe)
}
