//! MEMORY alone.

use edgewalk_machine::{Machine, Plan};
use edgewalk_model::{Memory, Stalls, Write};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

use super::rgb;
use crate::common::probe::{Failure, Probe};
use crate::common::tokens;

/// MEMORY: reads and writes on all pixels, depths taken at random; at the end the contents.
pub fn memory(machine: &Plan, cycles: u64, rng: &mut Pcg64Mcg) -> Result<Probe, Failure> {
    let mut probe = Probe::new(edgewalk_rtl::memory(machine, machine.z.max()))?;
    let inputs = ["rd_valid", "rd_addr", "data_ready", "wr_valid"].map(|name| probe.input(name));
    let [rd_valid, rd_addr, data_ready, wr_valid] = inputs;
    let (rd_valid, rd_addr, data_ready, wr_valid) = (rd_valid?, rd_addr?, data_ready?, wr_valid?);
    let without_tag = Machine { tag_bits: 0, ..Machine::clone(machine) }.plan().expect("can be built");
    let wr = probe.input_channel("wr", &tokens::write(&without_tag, &Write::default()))?;
    let rd_ready = probe.port("memory", "rd_ready", "rd_ready")?;
    let wr_ready = probe.port("memory", "wr_ready", "wr_ready")?;
    let data_valid = probe.port("memory", "data_valid", "data_valid")?;
    let data_z = probe.port("memory", "data_z", "data_z")?;
    let mut model = Memory::new(machine, [0; 3], Stalls::NONE);
    let words = 1 << machine.widths().address;
    let often = rng.random_range(0.1..1.0);
    let mut in_flight = 0;
    probe.reset()?;
    while probe.cycle < cycles {
        let read = rng.random_bool(0.7).then(|| rng.random_range(0..words));
        let write = rng.random_bool(0.5).then(|| Write {
            addr: rng.random_range(0..words),
            z: rng.random_range(0..=machine.z.max()) as u32, // at most 32 bits
            z_en: rng.random(),
            rgb: rgb(machine, rng),
            ..Write::default()
        });
        let ready = rng.random_bool(often);
        probe.set(rd_valid, read.is_some());
        probe.set(rd_addr, read.unwrap_or(0));
        probe.set(wr_valid, write.is_some());
        probe.set_channel(&wr, &tokens::write(&without_tag, &write.unwrap_or_default()));
        probe.set(data_ready, ready);
        probe.check(&wr_ready, true)?;
        let data = model.data();
        probe.check(&data_valid, data.is_some())?;
        if let Some(z) = data {
            probe.check(&data_z, z)?;
        }
        let takes = probe.value(&rd_ready) == 1;
        // It may refuse a read only while as many are on their way as it has stages.
        if in_flight < machine.latency {
            probe.check(&rd_ready, true)?;
        }
        probe.tick();
        let (read, taken) = (read.filter(|_| takes), ready && data.is_some());
        in_flight = in_flight + u32::from(read.is_some()) - u32::from(taken);
        model.step(read, taken, write.as_ref());
    }
    probe.check_words("memory", "depths", |addr| model.pixel(addr).z.into())?;
    let bits = machine.color.bits;
    probe.check_words("memory", "frame", |addr| {
        model.pixel(addr).rgb.channels().into_iter().fold(0, |word, color| (word << bits) | u128::from(color))
    })?;
    Ok(probe)
}
