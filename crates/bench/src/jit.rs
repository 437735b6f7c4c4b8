//! The netlist as native code, with memories as in Verilator's harness. Compiling is part of the first frame.

use super::job::{Job, Times, Work};
use super::ports::frame_fields;
use super::stopwatch::Stopwatch;
use anyhow::{Result, anyhow};
use edgewalk_jit::{InputId, OutputId, Simulator};
use edgewalk_lockstep::{Direction, Interface, Link, Memory, MemorySetting, Triangles, Unit};
use edgewalk_machine::Plan;
use edgewalk_model::fifo::Fifo;
use edgewalk_model::prefetch;
use edgewalk_netlist::SimError;

/// Times it.
pub fn time(job: &Job) -> Result<Times> {
    if job.has_wide_words() { timed::<u128>(job) } else { timed::<u64>(job) }
}

fn timed<W: Word>(job: &Job) -> Result<Times> {
    let start = Stopwatch::start();
    let mut native = Native::<W>::new(job)?;
    job.time(&start, || Ok(native.frame(job)))
}

/// A word of a memory: 64 bits where the machine has no wider ones.
trait Word: Copy + Default + Into<u128> {
    /// The word, which has room.
    fn of(word: u128) -> Self;
}

impl Word for u64 {
    fn of(word: u128) -> u64 {
        word as u64
    }
}

impl Word for u128 {
    fn of(word: u128) -> u128 {
        word
    }
}

/// The machine with its ports, found by their declared names, and what stands behind them.
struct Native<W> {
    simulator: Simulator,
    rst: InputId,
    idle: OutputId,
    /// Where triangles or their words enter: valid, fields, ready.
    tri: (InputId, Vec<InputId>, OutputId),
    port: Triangles,
    memories: Vec<Served<W>>,
    /// Valid of what asks for something: reads and writes.
    calls: Vec<OutputId>,
    /// The write: valid, address, and what the picture keeps of it.
    write: (OutputId, OutputId, Vec<OutputId>),
    /// Memory of the picture; allocated before the first frame, like the harness's.
    picture: Vec<u64>,
}

/// A memory and its ports.
struct Served<W> {
    setting: MemorySetting,
    /// By address; beyond them it is 0.
    words: Vec<W>,
    /// Words from a pixel to the one below.
    pitch: usize,
    /// Words read, with the cycle from which on they are offered; as many as in the harness.
    reads: Fifo<(u64, W), 64>,
    /// A word is offered.
    offers: bool,
    data_valid: InputId,
    data: InputId,
    data_ready: OutputId,
    read_valid: OutputId,
    address: OutputId,
    write: Option<[OutputId; 4]>,
}

impl<W: Word> Native<W> {
    fn new(job: &Job) -> Result<Native<W>> {
        let netlist =
            edgewalk_rtl::machine(job.machine).map_err(|e| anyhow!("the netlist cannot be built: {e}"))?;
        let mut simulator = Simulator::new(&netlist)?;
        let interface = Interface::new(job.machine, Unit::MACHINE);
        for link in interface.links_of(Direction::Out) {
            simulator.set_input(&format!("{}_ready", link.name), 1)?;
        }
        for (port, value) in interface.constants.iter().zip(job.constants()?) {
            simulator.set_input(&port.name, value)?;
        }
        let (Some(tri), Some(wr)) = (interface.links.first(), interface.links.last()) else {
            return Err(anyhow!("a machine takes triangles and gives writes"));
        };
        let output = |name: &str| simulator.output(name);
        let (address, kept) = frame_fields(&interface, wr);
        let fields = |places: Vec<usize>| -> Result<Vec<OutputId>, SimError> {
            places.into_iter().map(|place| output(&wr.fields[place].name)).collect()
        };
        let memories =
            interface.memories.iter().map(|memory| Served::new(memory, job, &interface, &simulator));
        let memories = memories.collect::<Result<Vec<_>, _>>()?;
        let written = memories.iter().filter_map(|memory| memory.write.map(|[valid, ..]| valid));
        let calls =
            memories.iter().map(|memory| memory.read_valid).chain(written).chain([output(&valid(wr))?]);
        Ok(Native {
            rst: simulator.input("rst")?,
            idle: output("idle")?,
            tri: (
                simulator.input(&valid(tri))?,
                tri.fields.iter().map(|port| simulator.input(&port.name)).collect::<Result<_, _>>()?,
                output(&ready(tri))?,
            ),
            port: Triangles::new(job.machine),
            write: (output(&valid(wr))?, output(&wr.fields[address].name)?, fields(kept)?),
            calls: calls.collect(),
            memories,
            picture: vec![0; words(job.machine)],
            simulator,
        })
    }

    /// Clear and draw all, no more than Verilator's harness does.
    fn frame(&mut self, job: &Job) -> Work {
        self.memories.iter_mut().for_each(Served::clear);
        self.picture.fill(0);
        let mut work = Work { cycles: 0, writes: 0 };
        self.reset();
        let port = self.port.clone();
        let mut tokens = job.triangles.iter().flat_map(|triangle| port.offers(triangle, 0));
        let mut next = tokens.next();
        self.offer(next.as_deref());
        loop {
            let mut due = u64::MAX;
            for memory in &mut self.memories {
                due = due.min(memory.offer(&mut self.simulator, work.cycles));
            }
            // Until the next word is due, or a port moves, there is nothing to be done.
            let end = if next.is_some() { self.tri.2 } else { self.idle };
            loop {
                self.simulator.tick();
                if work.cycles + 1 >= due
                    || self.is_high(end)
                    || self.calls.iter().any(|call| self.is_high(*call))
                {
                    break;
                }
                work.cycles += 1;
            }
            for memory in &mut self.memories {
                memory.serve(&self.simulator, &self.picture, work.cycles);
            }
            if self.is_high(self.write.0) {
                let word = |port: &OutputId| self.simulator.sampled(*port) as u64;
                let kept = self.write.2.iter().fold(0u64, |kept, port| kept.rotate_left(16) ^ word(port));
                self.picture[word(&self.write.1) as usize] = kept;
                work.writes += 1;
            }
            work.cycles += 1;
            if next.is_some() && self.is_high(self.tri.2) {
                next = tokens.next();
                self.offer(next.as_deref());
            } else if next.is_none() && self.is_high(self.idle) {
                return work;
            }
        }
    }

    fn reset(&mut self) {
        self.offer(None);
        for memory in &mut self.memories {
            memory.offer(&mut self.simulator, 0);
        }
        self.simulator.set(self.rst, 1);
        self.simulator.tick();
        self.simulator.set(self.rst, 0);
    }

    fn offer(&mut self, token: Option<&[u128]>) {
        let (valid, fields, _) = &self.tri;
        self.simulator.set(*valid, token.is_some().into());
        for (port, value) in fields.iter().zip(token.into_iter().flatten()) {
            self.simulator.set(*port, *value);
        }
    }

    /// An output as it was before the clock.
    fn is_high(&self, output: OutputId) -> bool {
        self.simulator.sampled(output) as u64 == 1
    }
}

impl<W: Word> Served<W> {
    fn new(
        memory: &Memory,
        job: &Job,
        interface: &Interface,
        simulator: &Simulator,
    ) -> Result<Served<W>, SimError> {
        let (read, data) = (&interface.links[memory.read], &interface.links[memory.data]);
        let write = memory.write.map(|write| {
            let link = &interface.links[write.link];
            let port = |place: usize| simulator.output(&link.fields[place].name);
            Ok([
                simulator.output(&valid(link))?,
                write.enable.map_or_else(|| simulator.output(&valid(link)), port)?,
                port(write.address)?,
                port(write.word)?,
            ])
        });
        Ok(Served {
            setting: MemorySetting::of(memory),
            words: job.words(memory.name).into_iter().map(W::of).collect(),
            pitch: 1 << job.machine.widths().x,
            reads: Fifo::default(),
            offers: false,
            data_valid: simulator.input(&valid(data))?,
            data: simulator.input(&data.fields[0].name)?,
            data_ready: simulator.output(&ready(data))?,
            read_valid: simulator.output(&valid(read))?,
            address: simulator.output(&read.fields[0].name)?,
            write: write.transpose()?,
        })
    }

    fn clear(&mut self) {
        if self.write.is_some() {
            self.words.clear();
            self.words.resize(self.setting.words, W::of(self.setting.clear));
        }
        self.reads.clear();
    }

    /// Offers the oldest word if it is there. Returns when it is due, if there is one.
    #[inline]
    fn offer(&mut self, simulator: &mut Simulator, cycle: u64) -> u64 {
        let (due, word) = if self.reads.is_empty() { (u64::MAX, W::default()) } else { *self.reads.head() };
        let offers = due <= cycle;
        if offers != self.offers {
            simulator.set(self.data_valid, offers.into());
            self.offers = offers;
        }
        if offers {
            simulator.set(self.data, word.into());
        }
        due
    }

    /// What moved in the cycle; a read sees the word before a write of its own cycle.
    #[inline]
    fn serve(&mut self, simulator: &Simulator, picture: &[u64], cycle: u64) {
        let word = |port: OutputId| simulator.sampled(port) as u64; // an address, or one bit
        if self.offers && word(self.data_ready) == 1 {
            self.reads.pop();
        }
        if word(self.read_valid) == 1 {
            let address = word(self.address) as usize;
            let read = self.words.get(address).copied().unwrap_or_default();
            self.reads.push((cycle + self.setting.latency, read));
            if self.write.is_some() {
                // Triangles go down, as the model's memory says.
                prefetch(&self.words, address + self.pitch);
                prefetch(picture, address + self.pitch);
            }
        }
        if let Some([valid, enable, address, data]) = self.write
            && word(valid) == 1
            && word(enable) == 1
        {
            self.words[word(address) as usize] = W::of(simulator.sampled(data));
        }
    }
}

fn valid(link: &Link) -> String {
    format!("{}_valid", link.name)
}

fn ready(link: &Link) -> String {
    format!("{}_ready", link.name)
}

/// Pixels of the picture, with those beside the screen.
fn words(plan: &Plan) -> usize {
    1 << plan.widths().address
}
