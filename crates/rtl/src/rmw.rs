//! Read, modify, write: a word of memory is read for every fragment, changed, and written back, while others are on the way.
//!
//! ```text
//!         ┌───────────── read (address) ──> memory
//!  frag ──┴─> [in-flight queue] ─ the unit's modification ─> [w] ── write ──> memory
//!             memory ── data ──────┘        [stages]
//! ```
//! The unit says what the modification is, and in how many stages; queue, hazard policy, forwarding and w are here. The order of calls
//! is that of the data: [`Rmw::enter`], [`Rmw::turn`], [`Rmw::old`], [`Rmw::write`], [`Rmw::move_up`].

mod write;

use edgewalk_machine::Hazard;
use edgewalk_netlist::{Module, Reg, Signal};

use crate::ports::Interface;
use crate::wires::{Part, Registers, Token, parts};
use write::Write;
pub(crate) use write::{Leaves, Way};

/// For the header of a unit that has one: what happens when a fragment's word is still in flight.
pub(crate) fn hazard_doc(hazard: Hazard, word: &str) -> String {
    match hazard {
        Hazard::Drain => "Hazard: a fragment with fence waits until nothing is in flight.".to_owned(),
        Hazard::Interlock => {
            format!(
                "Hazard: a fragment waits while one of its own address is in flight and may change its {word}."
            )
        }
        Hazard::Forward => {
            format!("Hazard: a fragment takes the {word} from the last older fragment that writes its pixel.")
        }
    }
}

/// What a unit makes of it.
pub(crate) struct Shape<'a, 'm> {
    /// The memory's name among the ports.
    pub memory: &'a str,
    pub hazard: Hazard,
    /// Of the queue.
    pub places: u32,
    /// What the queue keeps of a fragment, its `addr` among it; `need` for a unit that does not read for every fragment.
    pub entry: Vec<Part>,
    /// Whether words are written at all, constant while fragments are in flight; `None`: always.
    pub writes: Option<Signal<'m>>,
    /// What has left the queue and is not in w yet.
    pub stages: Vec<InFlight<'m>>,
    /// The links by which what is in w leaves, the one to the memory first.
    pub ways: &'a [Way<'a>],
    /// Prefix and fields of w.
    pub write: (&'a str, Vec<Part>),
}

/// A fragment in a stage.
#[derive(Clone, Copy)]
pub(crate) struct InFlight<'m> {
    pub valid: Signal<'m>,
    pub addr: Signal<'m>,
}

/// The state: the queue of what waits for its old word, and the pixel being written.
pub(crate) struct Rmw<'m> {
    m: &'m Module,
    hazard: Hazard,
    names: Names,
    writes: Option<Signal<'m>>,
    /// Clocks from a read to its word, at the least.
    latency: u32,
    places: Vec<Place<'m>>,
    /// Entries taken, from place 0.
    count: Reg<'m>,
    stages: Vec<InFlight<'m>>,
    w: Write<'m>,
    /// The head is of the pixel that left the queue in the cycle before; only in machines that forward to a head that does not
    /// wait.
    head_follows: Option<Reg<'m>>,
}

/// Of the links, for the handshakes.
struct Names {
    frag: &'static str,
    read: &'static str,
    data: &'static str,
}

/// One place of the queue.
struct Place<'m> {
    entry: Registers<'m>,
    forwarded: Option<Forwarded<'m>>,
}

/// The word that an older fragment writes to an entry's pixel; only in machines that forward.
struct Forwarded<'m> {
    valid: Reg<'m>,
    word: Registers<'m>,
}

/// How a fragment enters.
pub(crate) struct Enter<'m> {
    pub full: Signal<'m>,
    pub hazard: Signal<'m>,
    pub read_valid: Signal<'m>,
    pub frag_ready: Signal<'m>,
    /// It enters in this cycle.
    push: Signal<'m>,
}

/// How the head leaves.
pub(crate) struct Turn<'m> {
    pub data_ready: Signal<'m>,
    /// It leaves in this cycle.
    pub fires: Signal<'m>,
}

impl<'m> Rmw<'m> {
    /// The registers.
    pub fn new(m: &'m Module, ports: &Interface<'m>, shape: Shape<'_, 'm>) -> Rmw<'m> {
        let Shape { hazard, places, entry, writes, stages, ways, write, .. } = shape;
        let (frag, memory) = (ports.takes_link(), ports.memory_port(shape.memory));
        let bits = (places + 1).next_power_of_two().ilog2();
        let count = m.reg("count", bits).doc("fragments in flight").reset(0);
        let mut word = parts(&memory.data.fields);
        word.iter_mut().for_each(|part| part.doc = format!("the {} it wrote", memory.name));
        let place = |i| Place {
            entry: Registers::new(m, &format!("place{i}"), entry.clone()),
            forwarded: (hazard == Hazard::Forward).then(|| Forwarded {
                valid: m.reg(&format!("place{i}_fwd_valid"), 1).doc("an older fragment wrote this pixel"),
                word: Registers::new(m, &format!("place{i}_fwd"), word.clone()),
            }),
        };
        let places = (0..places).map(place).collect();
        let w = Write::new(m, ways, write, memory.enable);
        let head_follows = (hazard == Hazard::Forward && stages.is_empty())
            .then(|| m.reg("head_follows", 1).doc("the head is of the pixel that left in the cycle before"));
        let names = Names { frag: frag.name, read: memory.read.name, data: memory.data.name };
        let latency = memory.latency;
        Rmw { m, hazard, names, writes, latency, places, count, stages, w, head_follows }
    }

    /// A fragment enters when the queue has room and no hazard holds it, in the cycle its word is read. `needs` it the word, and
    /// without reads nothing; `None`: every fragment does.
    pub fn enter(
        &self,
        frag_valid: Signal<'m>,
        frag: &Token<'m>,
        needs: Option<Signal<'m>>,
        read_ready: Signal<'m>,
    ) -> Enter<'m> {
        let full = self.count.q().eq(self.places.len() as i32).named("full");
        let hazard = self.must_wait(frag, needs).named("hazard");
        let clear = (!full & !hazard).named("clear_to_read");
        let enters = frag_valid & clear;
        let read_valid = needs.map_or(enters, |needs| enters & needs);
        let read_valid = read_valid.named(&format!("{}_valid", self.names.read));
        let read_done = needs.map_or(read_ready, |needs| read_ready | !needs);
        let frag_ready = (read_done & clear).named(&format!("{}_ready", self.names.frag));
        let push = match needs {
            None => read_valid & read_ready,
            Some(_) => frag_valid & frag_ready,
        };
        Enter { full, hazard, read_valid, frag_ready, push: push.named("push") }
    }

    /// The head leaves when its old word comes, if it needs one, and there is `room` for it; `name` says what happens to it then.
    pub fn turn(&self, data_valid: Signal<'m>, room: Signal<'m>, name: &str) -> Turn<'m> {
        let may = self.count.q().any() & room;
        let may = self.head_waits().map_or(may, |waits| may & !waits);
        let named = |ready: Signal<'m>| ready.named(&format!("{}_ready", self.names.data));
        match self.places[0].entry.get("need").map(Reg::q) {
            None => {
                let data_ready = named(may);
                Turn { data_ready, fires: (data_valid & data_ready).named(name) }
            }
            Some(need) => {
                let may = may.named_doc("head_may_leave", "but for its word");
                Turn { data_ready: named(may & need), fires: (may & (data_valid | !need)).named(name) }
            }
        }
    }

    /// The head's word is being made in a stage.
    fn head_waits(&self) -> Option<Signal<'m>> {
        let same = |stage: &InFlight<'m>| stage.valid & stage.addr.eq(self.head("addr"));
        let same = self.stages.iter().map(same).reduce(|any, one| any | one);
        let same = same.filter(|_| self.hazard == Hazard::Forward)?;
        Some((self.head("need") & same).named_doc("head_waits", "its old word is being made"))
    }

    /// A field of the oldest fragment in the queue.
    pub fn head(&self, field: &str) -> Signal<'m> {
        self.places[0].entry[field].q()
    }

    /// A field of the head's old word: what an older fragment wrote, or else what memory says. What is in w since this cycle is
    /// nowhere else yet.
    pub fn old(&self, field: &str, data: &Token<'m>) -> Signal<'m> {
        let Some(own) = &self.places[0].forwarded else { return data[field] };
        let in_queue =
            own.valid.q().mux(own.word[field], data[field]).named(&format!("old_{field}_in_queue"));
        let from_w = match self.head_follows {
            Some(follows) => follows.q() & self.w.changes(),
            None => self.w.of(self.head("addr")),
        };
        from_w.named("head_after_w").mux(self.w[field], in_queue)
    }

    /// Nothing is in w, or all of it leaves in this cycle; a ready a way.
    pub fn w_free(&self, ready: &[Signal<'m>]) -> Signal<'m> {
        self.w.free(ready).named("w_free")
    }

    /// What is in w leaves by each way by itself; a fragment takes its place, `when` it comes.
    pub fn write(&self, when: Signal<'m>, ways: &[Leaves<'m>], value: impl Fn(&str) -> Signal<'m>) {
        self.w.load(when, ways, value);
    }

    /// The queue moves up when its head leaves, in a cycle of `pop`; an entry enters with these values of its fields.
    pub fn move_up(&self, enter: &Enter<'m>, pop: Signal<'m>, value: impl Fn(&str) -> Signal<'m>) {
        self.m.comment("The queue moves up when its head leaves; what enters goes behind the last.");
        let (push, count) = (enter.push, self.count);
        count.when(push & !pop, count.q() + 1).when(pop & !push, count.q() - 1);
        // A free place takes what may enter in every cycle: neither push nor pop, which may come late, leads into an entry.
        for (i, place) in self.places.iter().enumerate() {
            let moves = (pop | count.q().le(i as i32)).named(&format!("place{i}_moves"));
            match self.places.get(i + 1) {
                Some(behind) => {
                    let follows = count.q().gt(i as i32 + 1).named(&format!("place{i}_has_next"));
                    place.entry.load(moves, |f| follows.mux(behind.entry[f], value(f)));
                }
                None => place.entry.load(moves, &value),
            }
        }
        if self.hazard == Hazard::Forward {
            let end = pop.mux(count.q() - 1, count).named("end_place");
            let enters = |i| (push & end.eq(i as i32)).named(&format!("enters{i}"));
            let enters: Vec<Signal> = (0..self.places.len()).map(enters).collect();
            self.forward(value("addr"), pop, &enters);
        }
    }

    /// Something is in flight.
    pub fn any(&self) -> Signal<'m> {
        self.w.ways().skip(1).fold(self.may_change(), |any, way| any | way)
    }

    /// Valid of a way by which w leaves.
    pub fn valid(&self, way: usize) -> Reg<'m> {
        self.w.valid(way)
    }

    /// A field of w.
    pub fn written(&self, field: &str) -> Signal<'m> {
        self.w[field].q()
    }

    /// Something is in flight that may go to the memory.
    fn may_change(&self) -> Signal<'m> {
        let stages = self.stages.iter().fold(self.count.q().any(), |any, stage| any | stage.valid);
        stages | self.w.valid(0)
    }

    /// The hazard policy.
    fn must_wait(&self, frag: &Token<'m>, needs: Option<Signal<'m>>) -> Signal<'m> {
        let addr = frag["addr"];
        match self.hazard {
            Hazard::Drain => frag["fence"] & self.may_change(),
            Hazard::Interlock => {
                let same = |(i, place): (usize, &Place<'m>)| {
                    let same = self.count.q().gt(i as i32) & place.entry["addr"].q().eq(addr);
                    same.named(&format!("same{i}"))
                };
                let in_queue = self.places.iter().enumerate().map(same);
                let any = in_queue.fold(self.w.of(addr), |any, one| any | one);
                let same = |stage: &InFlight<'m>| stage.valid & stage.addr.eq(addr);
                let any = self.stages.iter().fold(any, |any, stage| any | same(stage));
                [self.writes, needs].into_iter().flatten().fold(any, |any, only| only & any)
            }
            Hazard::Forward => self.m.lit(1, 0),
        }
    }

    /// Fragments in the queue take the word being written, if it is of their pixel; so does one that enters.
    fn forward(&self, enters_addr: Signal<'m>, pop: Signal<'m>, enters: &[Signal<'m>]) {
        self.m.comment("Forward: a word being written goes to every fragment of its pixel in the queue.");
        let after_w = |(i, place): (usize, &Place<'m>)| {
            self.w.of(place.entry["addr"].q()).named(&format!("place{i}_after_w"))
        };
        // Where w takes the head itself, nobody stands in the last place in the cycle in which w is new: the head has just left.
        let matched = self.places.len() - usize::from(self.stages.is_empty());
        let after_w: Vec<Signal> = self.places.iter().enumerate().take(matched).map(after_w).collect();
        let enters_after_w = self.w.of(enters_addr).named("enters_after_w");
        for (i, place) in self.places.iter().enumerate() {
            let Some(own) = &place.forwarded else { continue };
            if let Some(stays) = after_w.get(i).copied() {
                own.valid.when(stays, 1);
                own.word.load(stays, |f| self.w[f].q());
            }
            if let Some(Place { forwarded: Some(from), .. }) = self.places.get(i + 1) {
                match after_w.get(i + 1).copied() {
                    Some(same) => {
                        own.valid.when(pop, from.valid.q() | same);
                        own.word.load(pop, |f| same.mux(self.w[f], from.word[f]));
                    }
                    None => {
                        own.valid.when(pop, from.valid.q());
                        own.word.load(pop, |f| from.word[f].q());
                    }
                }
            }
            own.valid.when(enters[i], enters_after_w);
            own.word.load(enters[i], |f| self.w[f].q());
        }

        let Some(follows) = self.head_follows else { return };
        self.m.comment("What the head writes is in w a cycle later, when the next may be compared already.");
        let addr = self.head("addr");
        let behind =
            self.places.get(1).map(|place| place.entry["addr"].q().eq(addr).named("place1_after_head"));
        // A fragment that enters is compared in the next cycle only if its word comes at once.
        let enters = (self.latency == 1).then(|| enters_addr.eq(addr).named("enters_after_head"));
        let next = match (behind, enters) {
            (Some(behind), Some(enters)) => self.count.q().gt(1).mux(behind, enters),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => self.m.lit(1, 0),
        };
        follows.set(pop & next);
    }
}
