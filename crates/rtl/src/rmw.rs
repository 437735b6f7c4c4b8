//! Read, modify, write: a word of memory is read for every fragment, changed, and written back, while others are on the way.
//!
//! ```text
//!         ┌───────────── read (address) ──> memory
//!  frag ──┴─> [in-flight queue] ─ the unit's modification ─> [w] ── write ──> memory
//!             memory ── data ──────┘
//! ```
//! The unit says what the modification is; queue, hazard policy and forwarding are here. The order of calls is that of the data:
//! [`Rmw::enter`], [`Rmw::turn`], [`Rmw::old`], [`Rmw::finish`].

use edgewalk_machine::{Hazard, Plan};
use edgewalk_netlist::{Module, Reg, Signal};

use crate::ports::Interface;
use crate::wires::{Registers, Token, parts};

/// For the header of a unit that has one: what happens when a fragment's word is still in flight.
pub(crate) fn hazard_doc(plan: &Plan, word: &str) -> String {
    match plan.hazard {
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

/// The state: the queue of what waits for its old word, and the pixel being written.
pub(crate) struct Rmw<'m> {
    m: &'m Module,
    hazard: Hazard,
    names: Names,
    /// The field of the write that permits the word to be written.
    enable: &'static str,
    /// Whether words are written at all; constant while fragments are in flight.
    writes: Signal<'m>,
    /// Clocks from a read to its word, at the least.
    latency: u32,
    places: Vec<Place<'m>>,
    /// Entries taken, from place 0.
    count: Reg<'m>,
    w_valid: Reg<'m>,
    w: Registers<'m>,
    /// The head is of the pixel that left the queue in the cycle before; only in machines that forward.
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
    /// The registers, for the memory of that name: an entry is what the unit takes but for the fence, and w is what it gives.
    pub fn new(
        m: &'m Module,
        plan: &Plan,
        ports: &Interface<'m>,
        memory: &str,
        writes: Signal<'m>,
    ) -> Rmw<'m> {
        let (frag, write, memory) = (ports.takes_link(), ports.gives_link(), ports.memory_port(memory));
        let entry = frag.fields.iter().filter(|field| field.name != "fence");
        let entry = parts(entry);
        let bits = (plan.inflight + 1).next_power_of_two().ilog2();
        let count = m.reg("count", bits).doc("fragments in flight").reset(0);
        let mut word = parts(&memory.data.fields);
        word.iter_mut().for_each(|part| part.doc = format!("the {} it wrote", memory.name));
        let place = |i| Place {
            entry: Registers::new(m, &format!("place{i}"), entry.clone()),
            forwarded: (plan.hazard == Hazard::Forward).then(|| Forwarded {
                valid: m.reg(&format!("place{i}_fwd_valid"), 1).doc("an older fragment wrote this pixel"),
                word: Registers::new(m, &format!("place{i}_fwd"), word.clone()),
            }),
        };
        let places = (0..plan.inflight).map(place).collect();
        let w_valid = m.reg(&format!("{}_valid", write.name), 1).doc("a pixel is being written").reset(0);
        let w = Registers::new(m, write.name, parts(&write.fields));
        let head_follows = (plan.hazard == Hazard::Forward)
            .then(|| m.reg("head_follows", 1).doc("the head is of the pixel that left in the cycle before"));
        let names = Names { frag: frag.name, read: memory.read.name, data: memory.data.name };
        Rmw { m, hazard: plan.hazard, names, enable: memory.enable, writes, latency: memory.latency, places, count, w_valid, w, head_follows }
    }

    /// A fragment enters when the queue has room and no hazard holds it, in the cycle its word is read.
    pub fn enter(&self, frag_valid: Signal<'m>, frag: &Token<'m>, read_ready: Signal<'m>) -> Enter<'m> {
        let full = self.count.q().eq(self.places.len() as i32).named("full");
        let hazard = self.must_wait(frag).named("hazard");
        let clear = (!full & !hazard).named("clear_to_read");
        let read_valid = (frag_valid & clear).named(&format!("{}_valid", self.names.read));
        let frag_ready = (read_ready & clear).named(&format!("{}_ready", self.names.frag));
        let push = (read_valid & read_ready).named("push");
        Enter { full, hazard, read_valid, frag_ready, push }
    }

    /// The head leaves when its old word comes and w is free; `name` says what happens to it then.
    pub fn turn(&self, data_valid: Signal<'m>, write_ready: Signal<'m>, name: &str) -> Turn<'m> {
        let w_free = (!self.w_valid.q() | write_ready).named("w_free");
        let data_ready = (self.count.q().any() & w_free).named(&format!("{}_ready", self.names.data));
        let fires = (data_valid & data_ready).named(name);
        Turn { data_ready, fires }
    }

    /// A field of the oldest fragment in the queue.
    pub fn head(&self, field: &str) -> Signal<'m> {
        self.places[0].entry[field].q()
    }

    /// A field of the head's old word: what an older fragment wrote, or else what memory says. What left the queue in the cycle before
    /// is in w alone.
    pub fn old(&self, field: &str, data: &Token<'m>) -> Signal<'m> {
        let (Some(own), Some(follows)) = (&self.places[0].forwarded, self.head_follows) else {
            return data[field];
        };
        let in_queue = own.valid.q().mux(own.word[field], data[field]).named(&format!("old_{field}_in_queue"));
        let from_w = (follows.q() & self.w_writes()).named("head_after_w");
        from_w.mux(self.w[field], in_queue)
    }

    /// The head leaves: if it passes it is written, with these values of the write's fields; then the queue moves up.
    pub fn finish(
        &self,
        frag: &Token<'m>,
        enter: &Enter<'m>,
        turn: &Turn<'m>,
        write_ready: Signal<'m>,
        passes: Signal<'m>,
        value: impl Fn(&str) -> Signal<'m>,
    ) {
        self.m.comment("Write what passes.");
        self.w_valid.when(write_ready, 0).when(turn.fires, passes);
        // What does not pass is loaded as well and means nothing: so the compare leads to one register only.
        self.w.load(turn.fires, |f| if f == self.enable { self.writes } else { value(f) });

        self.m.comment("The queue moves up when its head leaves; what enters goes behind the last.");
        let (push, pop, count) = (enter.push, turn.fires, self.count);
        count.when(push & !pop, count.q() + 1).when(pop & !push, count.q() - 1);
        let end = pop.mux(count.q() - 1, count).named("end_place");
        let enters = |i| (push & end.eq(i as i32)).named(&format!("enters{i}"));
        let enters: Vec<Signal> = (0..self.places.len()).map(enters).collect();
        for (i, place) in self.places.iter().enumerate() {
            if let Some(behind) = self.places.get(i + 1) {
                place.entry.load(pop, |f| behind.entry[f].q());
            }
            place.entry.load(enters[i], |f| frag[f]);
        }
        if self.hazard == Hazard::Forward {
            self.forward(frag, pop, &enters);
        }
    }

    /// Something is in flight.
    pub fn any(&self) -> Signal<'m> {
        self.count.q().any() | self.w_valid
    }

    /// The write: its valid and its fields.
    pub fn write(&self) -> (Reg<'m>, Token<'m>) {
        (self.w_valid, self.w.token())
    }

    /// A word is being written.
    fn w_writes(&self) -> Signal<'m> {
        self.w_valid.q() & self.w[self.enable]
    }

    /// The word of `addr` is being written.
    fn in_write(&self, addr: Signal<'m>) -> Signal<'m> {
        self.w_writes() & self.w["addr"].q().eq(addr)
    }

    /// The hazard policy.
    fn must_wait(&self, frag: &Token<'m>) -> Signal<'m> {
        let addr = frag["addr"];
        match self.hazard {
            Hazard::Drain => frag["fence"] & self.any(),
            Hazard::Interlock => {
                let same = |(i, place): (usize, &Place<'m>)| {
                    let same = self.count.q().gt(i as i32) & place.entry["addr"].q().eq(addr);
                    same.named(&format!("same{i}"))
                };
                let in_queue = self.places.iter().enumerate().map(same);
                self.writes & in_queue.fold(self.in_write(addr), |any, one| any | one)
            }
            Hazard::Forward => self.m.lit(1, 0),
        }
    }

    /// Fragments in the queue take the word being written, if it is of their pixel; so does one that enters.
    fn forward(&self, frag: &Token<'m>, pop: Signal<'m>, enters: &[Signal<'m>]) {
        self.m.comment("Forward: a word being written goes to every fragment of its pixel in the queue.");
        let after_w = |(i, place): (usize, &Place<'m>)| {
            self.in_write(place.entry["addr"].q()).named(&format!("place{i}_after_w"))
        };
        let after_w: Vec<Signal> = self.places.iter().enumerate().map(after_w).collect();
        let enters_after_w = self.in_write(frag["addr"]).named("enters_after_w");
        for (i, place) in self.places.iter().enumerate() {
            let Some(own) = &place.forwarded else { continue };
            let stays = after_w[i];
            own.valid.when(stays, 1);
            own.word.load(stays, |f| self.w[f].q());
            if let Some(Place { forwarded: Some(from), .. }) = self.places.get(i + 1) {
                let same = after_w[i + 1];
                own.valid.when(pop, from.valid.q() | same);
                own.word.load(pop, |f| same.mux(self.w[f], from.word[f]));
            }
            own.valid.when(enters[i], enters_after_w);
            own.word.load(enters[i], |f| self.w[f].q());
        }

        self.m.comment("What the head writes is in w a cycle later, when the next may be compared already.");
        let addr = self.head("addr");
        let behind = self.places.get(1).map(|place| place.entry["addr"].q().eq(addr).named("place1_after_head"));
        // A fragment that enters is compared in the next cycle only if its word comes at once.
        let enters = (self.latency == 1).then(|| frag["addr"].eq(addr).named("enters_after_head"));
        let next = match (behind, enters) {
            (Some(behind), Some(enters)) => self.count.q().gt(1).mux(behind, enters),
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => self.m.lit(1, 0),
        };
        if let Some(follows) = self.head_follows {
            follows.set(pop & next);
        }
    }
}
