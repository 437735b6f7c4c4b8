//! When the memory makes the machine wait: never, at a fixed pace, at random, or as pages of a dynamic memory do.
//!
//! ```text
//!  read, write that fired ─> Pacer ─┬─> clocks that the data comes later than L
//!                                   └─> readies of the next cycle
//! ```
//! Written as `none`, `fixed:rd=1,data=4`, `random:seed=1,rd=64`, `dram:banks=4,page=256`: a kind, and the parameters that are
//! not to stand as they are by themselves.

mod pages;

use pages::Pages;
pub use pages::{Dram, PageCounts};

use rand_pcg::Pcg32;
use rand_pcg::rand_core::{RngCore, SeedableRng};
use std::fmt;
use std::str::FromStr;

/// How often the memory makes the machine wait, in 256ths; all zero: never. The same seed stalls in the same cycles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stalls {
    /// Seed of the pattern.
    pub seed: u64,
    /// `rd_ready` is low in so many of 256 cycles.
    pub rd: u8,
    /// So many of 256 reads take 1 to 8 cycles longer.
    pub data: u8,
    /// `wr_ready` is low in so many of 256 cycles.
    pub wr: u8,
}

impl Stalls {
    /// A memory that is always ready.
    pub const NONE: Stalls = Stalls { seed: 0, rd: 0, data: 0, wr: 0 };
}

/// The same clocks for every access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fixed {
    /// `rd_ready` is low for so many clocks after a read.
    pub rd: u32,
    /// Depths come so many clocks later.
    pub data: u32,
    /// `wr_ready` is low for so many clocks after a write.
    pub wr: u32,
}

/// How a memory makes the machine wait.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Waits {
    /// Never.
    #[default]
    Never,
    /// At a fixed pace.
    Fixed(Fixed),
    /// At random, by seed.
    Random(Stalls),
    /// As its pages do; [`Dram`] is made by [`Waits::from_str`] alone.
    Dram(Dram),
}

impl From<Stalls> for Waits {
    fn from(stalls: Stalls) -> Self {
        if stalls == Stalls::NONE { Waits::Never } else { Waits::Random(stalls) }
    }
}

/// The kinds, gentlest first.
pub const KINDS: [&str; 4] = ["none", "fixed", "random", "dram"];

/// The most clocks of a parameter.
const MOST: u32 = 1 << 20;

impl Waits {
    /// The kind with its usual parameters.
    fn usual(kind: &str) -> Option<Waits> {
        match kind {
            "none" => Some(Waits::Never),
            "fixed" => Some(Waits::Fixed(Fixed { rd: 1, data: 4, wr: 1 })),
            "random" => Some(Waits::Random(Stalls { seed: 1, rd: 64, data: 64, wr: 64 })),
            "dram" => Some(Waits::Dram(Dram {
                banks: 4,
                page: 256,
                miss: 6,
                turn: 2,
                refresh: 780,
                busy: 13,
                word: 1,
                line: 1,
            })),
            _ => None,
        }
    }

    /// Waits of another memory: as often, but at random in other cycles.
    pub(crate) fn of_another(self, number: u64) -> Waits {
        match self {
            Waits::Random(stalls) => {
                Waits::Random(Stalls { seed: stalls.seed.wrapping_add(number), ..stalls })
            }
            as_often => as_often,
        }
    }

    fn kind(&self) -> &'static str {
        match self {
            Waits::Never => "none",
            Waits::Fixed(_) => "fixed",
            Waits::Random(_) => "random",
            Waits::Dram(_) => "dram",
        }
    }

    /// Names, values and least and most of the parameters.
    fn parameters(&self) -> Vec<(&'static str, u64, u64, u64)> {
        let most = u64::from(MOST);
        let clocks = |name, value: u32| (name, u64::from(value), 0, most);
        match *self {
            Waits::Never => Vec::new(),
            Waits::Fixed(Fixed { rd, data, wr }) => {
                vec![clocks("rd", rd), clocks("data", data), clocks("wr", wr)]
            }
            Waits::Random(Stalls { seed, rd, data, wr }) => {
                let share = |name, value: u8| (name, u64::from(value), 0, 255);
                vec![("seed", seed, 0, u64::MAX), share("rd", rd), share("data", data), share("wr", wr)]
            }
            Waits::Dram(Dram { banks, page, miss, turn, refresh, busy, word, line }) => vec![
                ("banks", u64::from(banks), 1, 256),
                ("page", u64::from(page), 1, most),
                clocks("miss", miss),
                clocks("turn", turn),
                clocks("refresh", refresh),
                clocks("busy", busy),
                ("word", u64::from(word), 1, most),
                ("line", u64::from(line), 1, 64),
            ],
        }
    }

    /// Sets a parameter to a value in its range.
    fn set(&mut self, name: &str, value: u64) {
        let clocks = value as u32; // within MOST
        match (self, name) {
            (Waits::Fixed(fixed), "rd") => fixed.rd = clocks,
            (Waits::Fixed(fixed), "data") => fixed.data = clocks,
            (Waits::Fixed(fixed), _) => fixed.wr = clocks,
            (Waits::Random(random), "seed") => random.seed = value,
            (Waits::Random(random), "rd") => random.rd = value as u8,
            (Waits::Random(random), "data") => random.data = value as u8,
            (Waits::Random(random), _) => random.wr = value as u8,
            (Waits::Dram(dram), "banks") => dram.banks = clocks,
            (Waits::Dram(dram), "page") => dram.page = clocks,
            (Waits::Dram(dram), "miss") => dram.miss = clocks,
            (Waits::Dram(dram), "turn") => dram.turn = clocks,
            (Waits::Dram(dram), "refresh") => dram.refresh = clocks,
            (Waits::Dram(dram), "busy") => dram.busy = clocks,
            (Waits::Dram(dram), "word") => dram.word = clocks,
            (Waits::Dram(dram), _) => dram.line = clocks,
            (Waits::Never, _) => {}
        }
    }
}

impl fmt::Display for Waits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.kind())?;
        // A memory with a word a clock and without lines is called by the other parameters alone.
        let shown =
            |(name, value, ..): &(&str, u64, u64, u64)| !["word", "line"].contains(name) || *value != 1;
        for (place, (name, value, ..)) in self.parameters().into_iter().filter(shown).enumerate() {
            write!(f, "{}{name}={value}", if place == 0 { ':' } else { ',' })?;
        }
        Ok(())
    }
}

/// What is wrong with a description of waits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WaitsError(String);

impl fmt::Display for WaitsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for WaitsError {}

impl FromStr for Waits {
    type Err = WaitsError;

    fn from_str(text: &str) -> Result<Self, WaitsError> {
        let (kind, settings) = text.split_once(':').unwrap_or((text, ""));
        let mut waits = Waits::usual(kind).ok_or_else(|| {
            WaitsError(edgewalk_machine::Unknown::new("stalls", kind, KINDS.iter().copied()).to_string())
        })?;
        for setting in settings.split(',').filter(|setting| !setting.is_empty()) {
            let (name, value) = setting
                .split_once('=')
                .ok_or_else(|| WaitsError(format!("{setting}: write name=value, as in fixed:rd=2")))?;
            let parameters = waits.parameters();
            let Some((_, _, least, most)) = parameters.iter().find(|parameter| parameter.0 == name) else {
                let names = parameters.iter().map(|parameter| parameter.0);
                let has = if parameters.is_empty() {
                    "none".to_owned()
                } else {
                    names.collect::<Vec<_>>().join(", ")
                };
                return Err(WaitsError(format!("{kind} has no {name}; it has: {has}")));
            };
            let number = value.parse().ok().filter(|value| (*least..=*most).contains(value));
            let number = number.ok_or_else(|| {
                WaitsError(format!("{kind}: {name} = {value} is not permitted ({least} to {most})"))
            })?;
            waits.set(name, number);
        }
        if let Waits::Dram(Dram { refresh, busy, .. }) = waits
            && (1..=busy).contains(&refresh)
        {
            // The next refresh would come before the end of the last, and no access ever.
            return Err(WaitsError(format!(
                "dram: refresh = {refresh} is not permitted with busy = {busy} (0, or more than busy)"
            )));
        }
        Ok(waits)
    }
}

/// Says in which cycles the memory is ready, and how late its data comes.
#[derive(Clone, Debug)]
pub(crate) struct Pacer {
    waits: Waits,
    random: Pcg32,
    /// Until a port may be ready again.
    free: [u64; 2],
    pages: Pages,
    /// In this cycle.
    pub rd_ready: bool,
    pub wr_ready: bool,
}

impl Pacer {
    pub fn new(waits: Waits) -> Self {
        let seed = if let Waits::Random(Stalls { seed, .. }) = waits { seed } else { 0 };
        let pages = if let Waits::Dram(dram) = waits { Pages::new(&dram) } else { Pages::default() };
        let random = Pcg32::seed_from_u64(seed);
        let mut pacer = Pacer { waits, random, free: [0; 2], pages, rd_ready: true, wr_ready: true };
        pacer.draw_readies();
        pacer
    }

    /// What the pages did so far.
    pub fn counts(&self) -> PageCounts {
        self.pages.counts
    }

    /// The first cycle in which the read port is ready again.
    pub fn free(&self) -> u64 {
        self.free[0]
    }

    /// Clock edge: addresses that were read and written in cycle `now`. Returns how many clocks later than L the depth comes.
    #[inline(always)]
    pub fn step(&mut self, now: u64, read: Option<u32>, write: Option<u32>) -> u64 {
        if self.waits == Waits::Never { 0 } else { self.paced(now, read, write) }
    }

    fn paced(&mut self, now: u64, read: Option<u32>, write: Option<u32>) -> u64 {
        let late = match self.waits {
            Waits::Never => 0,
            Waits::Random(stalls) => {
                let late = if read.is_some() { self.late(stalls.data) } else { 0 };
                self.draw_readies();
                return late;
            }
            Waits::Fixed(Fixed { rd, data, wr }) => {
                for (free, (fired, clocks)) in self.free.iter_mut().zip([(read, rd), (write, wr)]) {
                    if fired.is_some() {
                        *free = now + 1 + u64::from(clocks);
                    }
                }
                u64::from(data)
            }
            Waits::Dram(dram) => self.pages(dram, now, read, write),
        };
        [self.rd_ready, self.wr_ready] = self.free.map(|free| free <= now + 1);
        late
    }

    /// Accesses of one cycle, the read first.
    fn pages(&mut self, dram: Dram, now: u64, read: Option<u32>, write: Option<u32>) -> u64 {
        let pages = &mut self.pages;
        // A word that is there after a clock is not late; behind a clock the port is free in the next cycle.
        let [there, mut busy] = read.map_or([1, 0], |addr| pages.read(&dram, addr));
        busy += write.map_or(0, |addr| pages.write(&dram, addr));
        if busy > 0 {
            self.free = [now + busy; 2];
        }
        if dram.refresh > 0 && now >= pages.refresh {
            pages.close(&dram);
            self.free = [self.free[0].max(now + 1) + u64::from(dram.busy); 2];
        }
        there - 1
    }

    /// So many of 256 reads take 1 to 8 cycles longer.
    fn late(&mut self, share: u8) -> u64 {
        if share == 0 {
            return 0;
        }
        let [chance, cycles, ..] = self.random.next_u32().to_le_bytes();
        if chance < share { 1 + u64::from(cycles % 8) } else { 0 }
    }

    fn draw_readies(&mut self) {
        if let Waits::Random(Stalls { rd, wr, .. }) = self.waits
            && rd | wr != 0
        {
            let [rd_draw, wr_draw, ..] = self.random.next_u32().to_le_bytes();
            self.rd_ready = rd_draw >= rd;
            self.wr_ready = wr_draw >= wr;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Memories that stall at random by one seed stall in cycles of their own, and as often.
    #[test]
    fn memories_of_one_seed_stall_apart() {
        let waits: Waits = "random:seed=1,rd=64,wr=64".parse().expect("a kind of waits");
        let pace = |number| {
            let mut pacer = Pacer::new(waits.of_another(number));
            let ready = |now| (pacer.step(now, None, None), pacer.rd_ready, pacer.wr_ready);
            (0..1000).map(ready).collect::<Vec<_>>()
        };
        let paces = [0, 1, 2].map(pace);
        assert!(paces[0] != paces[1] && paces[1] != paces[2] && paces[0] != paces[2]);
        for pace in paces {
            let ready = pace.iter().filter(|(_, rd, _)| *rd).count();
            assert!((700..800).contains(&ready), "a quarter of the cycles stall: {ready}");
        }
    }

    #[test]
    fn what_is_written_reads_back() {
        for kind in KINDS {
            let waits: Waits = kind.parse().expect(kind);
            assert_eq!(waits.to_string().parse(), Ok(waits), "{kind}");
        }
        let waits = "dram:miss=9,banks=2".parse::<Waits>().expect("two parameters");
        assert_eq!(waits.to_string(), "dram:banks=2,page=256,miss=9,turn=2,refresh=780,busy=13");
        for (text, wrong) in [
            ("drm", "unknown stalls drm; permitted: none, fixed, random, dram; nearest: dram"),
            ("fixed:rd", "rd: write name=value, as in fixed:rd=2"),
            ("fixed:banks=2", "fixed has no banks; it has: rd, data, wr"),
            ("none:rd=2", "none has no rd; it has: none"),
            ("dram:banks=0", "dram: banks = 0 is not permitted (1 to 256)"),
            ("random:rd=256", "random: rd = 256 is not permitted (0 to 255)"),
            ("dram:refresh=13", "dram: refresh = 13 is not permitted with busy = 13 (0, or more than busy)"),
            (
                "dram:refresh=1,busy=1",
                "dram: refresh = 1 is not permitted with busy = 1 (0, or more than busy)",
            ),
        ] {
            assert_eq!(text.parse::<Waits>().expect_err(text).to_string(), wrong);
        }
    }

    /// Readies after each step, and how late the reads' data is.
    fn run(waits: &str, accesses: &[(Option<u32>, Option<u32>)]) -> Vec<([bool; 2], u64)> {
        let mut pacer = Pacer::new(waits.parse().expect(waits));
        let step = |(now, (read, write)): (u64, &(Option<u32>, Option<u32>))| {
            let late = pacer.step(now, *read, *write);
            ([pacer.rd_ready, pacer.wr_ready], late)
        };
        (0..).zip(accesses).map(step).collect()
    }

    #[test]
    fn a_fixed_pace_by_hand() {
        let (yes, no) = (true, false);
        let steps =
            run("fixed:rd=2,data=3,wr=1", &[(Some(5), None), (None, Some(5)), (None, None), (None, None)]);
        assert_eq!(
            steps.iter().map(|step| step.0).collect::<Vec<_>>(),
            [[no, yes], [no, no], [yes, yes], [yes, yes]]
        );
        assert_eq!(steps[0].1, 3);
    }

    #[test]
    fn pages_by_hand() {
        // Pages of 4 words in 2 banks: 0 to 3 and 8 to 11 share bank 0, 4 to 7 lies in bank 1.
        let dram = "dram:banks=2,page=4,miss=2,turn=1,refresh=0";
        let read = |addr| (Some(addr), None);
        let none = (None, None);
        let open = run(dram, &[read(0), none, none, read(3), read(4), none, none, read(3), read(8)]);
        let late: Vec<u64> = open.iter().map(|step| step.1).collect();
        assert_eq!(
            late,
            [2, 0, 0, 0, 2, 0, 0, 0, 2],
            "a miss, open, another bank, the first still open, another page"
        );
        let ready: Vec<bool> = open.iter().map(|step| step.0[0]).collect();
        assert_eq!(ready, [false, false, true, true, false, false, true, true, false]);
        // A write turns the bus, one that comes with a read takes a clock more.
        let turned =
            run(dram, &[read(0), none, none, (None, Some(1)), none, (Some(2), Some(3)), none, none, none]);
        let ready: Vec<bool> = turned.iter().map(|step| step.0[1]).collect();
        assert_eq!(ready, [false, false, true, false, true, false, false, false, true]);
        assert_eq!(turned[5].1, 1);
        // A refresh closes the page; that of cycle 10 begins behind the access.
        let steps = [read(0), none, none, read(1), none, none, none, none, none, none, read(2), none, none];
        let refreshed = run("dram:miss=2,refresh=5,busy=4", &steps);
        let ready: String = refreshed.iter().map(|step| if step.0[0] { '1' } else { '0' }).collect();
        assert_eq!(ready, "0011100001000");
        assert_eq!([refreshed[3].1, refreshed[10].1], [0, 2], "open, and closed");
        for waits in ["dram:refresh=14", "dram:refresh=1,busy=0", "dram:refresh=0"] {
            waits.parse::<Waits>().expect(waits);
        }
    }
}
