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
        Hazard::Drain => "Hazard: a fragment with fence waits until no fragment is in flight.".to_owned(),
        Hazard::Interlock => {
            format!(
                "Hazard: a fragment waits while a fragment in flight at its address may change its {word}."
            )
        }
        Hazard::Forward => {
            format!(
                "Hazard: a fragment takes its {word} from the youngest older fragment that writes its pixel."
            )
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
    /// Only where w is filled from the queue itself. Nobody stands in the last place then: the head has just left.
    follows: Option<Follows<'m>>,
}

/// What w holds since this cycle may be an entry's old word.
#[derive(Clone, Copy)]
struct Follows<'m> {
    /// Of the pixel that left the queue at the last clock.
    flag: Reg<'m>,
    /// And that one is written.
    after_w: Signal<'m>,
}

/// What a place of the queue does in a cycle.
struct Move<'m> {
    /// The entry takes the one behind it, or the one that enters.
    moves: Signal<'m>,
    /// There is one behind it; no place is behind the last.
    has_next: Option<Signal<'m>>,
}

/// How a fragment enters.
pub(crate) struct Enter<'m> {
    pub full: Signal<'m>,
    pub hazard: Signal<'m>,
    pub read_valid: Signal<'m>,
    pub frag_ready: Signal<'m>,
    /// The access enters in this cycle.
    push: Signal<'m>,
}

/// How the head leaves.
pub(crate) struct Turn<'m> {
    pub data_ready: Signal<'m>,
    /// The head leaves in this cycle.
    pub fires: Signal<'m>,
    /// A head that is there leaves.
    goes: Signal<'m>,
}

impl<'m> Rmw<'m> {
    /// The registers.
    pub fn new(m: &'m Module, ports: &Interface<'m>, shape: Shape<'_, 'm>) -> Rmw<'m> {
        let Shape { hazard, places, entry, writes, stages, ways, write, .. } = shape;
        let (frag, memory) = (ports.takes_link(), ports.memory_port(shape.memory));
        let bits = (places + 1).next_power_of_two().ilog2();
        let count = m.reg("count", bits).doc("fragments in flight").reset(0);
        let mut word = parts(&memory.data.fields);
        word.iter_mut().for_each(|part| {
            part.doc = format!("{} from the youngest older fragment of this pixel", memory.name)
        });
        let w = Write::new(m, ways, write, memory.enable);
        let place = |i| Place {
            entry: Registers::new(m, &format!("place{i}"), entry.clone()),
            forwarded: (hazard == Hazard::Forward).then(|| Forwarded {
                valid: m.reg(&format!("place{i}_fwd_valid"), 1).doc("an older fragment wrote this pixel"),
                word: Registers::new(m, &format!("place{i}_fwd"), word.clone()),
                follows: (stages.is_empty() && i + 1 < places).then(|| {
                    let flag = m.reg(&format!("place{i}_follows"), 1);
                    let flag = flag.doc("same pixel as the fragment that left one cycle earlier");
                    let after_w = (flag.q() & w.changes()).named(&format!("place{i}_after_w"));
                    Follows { flag, after_w }
                }),
            }),
        };
        let places = (0..places).map(place).collect();
        let names = Names { frag: frag.name, read: memory.read.name, data: memory.data.name };
        Rmw { m, hazard, names, writes, latency: memory.latency, places, count, stages, w }
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
        let (count, places) = (self.count.q(), self.places.len());
        // frag_ready goes on to the unit before, and to that before it: a bit where it can be one.
        let full = if places.is_power_of_two() { count.msb() } else { count.eq(places as i32) };
        let full = full.named("full");
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
        let any = self.count.q().any().named("has_head");
        let may = self.head_waits().map_or(room, |waits| room & !waits);
        let named = |ready: Signal<'m>| ready.named(&format!("{}_ready", self.names.data));
        let (data_ready, goes) = match self.places[0].entry.get("need").map(Reg::q) {
            None => (any & may, data_valid & may),
            Some(need) => {
                let may = may.named_doc("head_may_leave", "the head may leave once its word arrives");
                (any & may & need, may & (data_valid | !need))
            }
        };
        let goes = goes.named_doc("goes", "the head leaves, if the queue holds one");
        Turn { data_ready: named(data_ready), fires: (any & goes).named(name), goes }
    }

    /// The head's word is being made in a stage.
    fn head_waits(&self) -> Option<Signal<'m>> {
        let same = |stage: &InFlight<'m>| stage.valid & stage.addr.eq(self.head("addr"));
        let same = self.stages.iter().map(same).reduce(|any, one| any | one);
        let same = same.filter(|_| self.hazard == Hazard::Forward)?;
        Some((self.head("need") & same).named_doc("head_waits", "the head's old word is still in a stage"))
    }

    /// A field of the oldest fragment in the queue.
    pub fn head(&self, field: &str) -> Signal<'m> {
        self.places[0].entry[field].q()
    }

    /// A field of the head's old word: what an older fragment wrote, or else what memory says. What w holds since this cycle is
    /// nowhere else yet: where w is filled from the queue itself that is asked of [`Rmw::behind_w`].
    pub fn old(&self, field: &str, data: &Token<'m>) -> Signal<'m> {
        let Some(own) = &self.places[0].forwarded else { return data[field] };
        let in_queue = own.valid.q().mux(own.word[field], data[field]);
        if self.stages.is_empty() {
            return in_queue;
        }
        let in_queue = in_queue.named(&format!("old_{field}_in_queue"));
        self.w.of(self.head("addr")).named("head_after_w").mux(self.w[field], in_queue)
    }

    /// Whether the old word of the head is what w holds since this cycle; `None`: never. And a field of the one that will be
    /// the head in the next cycle if this one leaves, `frag` being what enters: so the two can meet a clock ahead.
    pub fn behind_w(&self, field: &str, frag: &Token<'m>) -> Option<(Signal<'m>, Signal<'m>)> {
        let after_w = self.places[0].forwarded.as_ref()?.follows?.after_w;
        let behind = self.places[1].entry[field].q();
        // A fragment that enters is a head in the next cycle that can leave only if its word comes at once.
        let enters = (self.latency == 1).then(|| frag[field]);
        let next = enters.map_or(behind, |enters| self.count.q().gt(1).mux(behind, enters));
        Some((after_w, next))
    }

    /// Nothing is in w, or all of it leaves in this cycle; a ready a way.
    pub fn w_free(&self, ready: &[Signal<'m>]) -> Signal<'m> {
        self.w.free(ready).named("w_free")
    }

    /// What is in w leaves by each way by itself; a fragment takes its place, `when` it comes to a `free` w.
    pub fn write(
        &self,
        free: Signal<'m>,
        when: Signal<'m>,
        ways: &[Leaves<'m>],
        value: impl Fn(&str) -> Signal<'m>,
    ) {
        self.w.load(free, when, ways, value);
    }

    /// The queue moves up when its head leaves; an entry enters with these values of its fields.
    pub fn move_up(&self, enter: &Enter<'m>, turn: &Turn<'m>, value: impl Fn(&str) -> Signal<'m>) {
        self.m.comment("The queue moves up when its head leaves; a new fragment goes behind the last one.");
        let (push, pop, count) = (enter.push, turn.fires, self.count);
        count.when(push & !pop, count.q() + 1).when(pop & !push, count.q() - 1);
        // A free place takes what may enter in every cycle: neither push nor pop, which may come late, leads into an entry.
        let steps = (0..self.places.len()).map(|i| Move {
            moves: (turn.goes | count.q().le(i as i32)).named(&format!("place{i}_moves")),
            has_next: (i + 1 < self.places.len())
                .then(|| count.q().gt(i as i32 + 1).named(&format!("place{i}_has_next"))),
        });
        let steps: Vec<Move> = steps.collect();
        for (i, (place, step)) in self.places.iter().zip(&steps).enumerate() {
            place.entry.load(step.moves, |f| match step.has_next {
                Some(has_next) => has_next.mux(self.places[i + 1].entry[f], value(f)),
                None => value(f),
            });
        }
        if self.hazard == Hazard::Forward {
            self.forward(value("addr"), &steps);
            self.follow(value("addr"), &steps, turn.goes);
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
    fn forward(&self, enters_addr: Signal<'m>, steps: &[Move<'m>]) {
        self.m.comment("Forward: a word on its way to memory goes to every queued fragment of its pixel.");
        let after_w = |(i, place): (usize, &Place<'m>)| match &place.forwarded {
            Some(own) if self.stages.is_empty() => own.follows.map(|follows| follows.after_w),
            // w is filled from a stage: who is of its pixel is seen only there.
            _ => Some(self.w.of(place.entry["addr"].q()).named(&format!("place{i}_after_w"))),
        };
        let after_w: Vec<Option<Signal>> = self.places.iter().enumerate().map(after_w).collect();
        let enters_after_w = self.w.of(enters_addr).named("enters_after_w");
        for (i, (place, step)) in self.places.iter().zip(steps).enumerate() {
            let Some(own) = &place.forwarded else { continue };
            if let Some(stays) = after_w[i] {
                own.valid.when(stays, 1);
                own.word.load(stays, |f| self.w[f].q());
            }
            let from = self.places.get(i + 1).and_then(|from| from.forwarded.as_ref());
            let Some((from, has_next)) = from.zip(step.has_next) else {
                own.valid.when(step.moves, enters_after_w);
                own.word.load(step.moves, |f| self.w[f].q());
                continue;
            };
            let (valid, keeps) = match after_w[i + 1] {
                Some(after_w) => (from.valid.q() | after_w, has_next & !after_w),
                None => (from.valid.q(), has_next),
            };
            own.valid.when(step.moves, has_next.mux(valid, enters_after_w));
            own.word.load(step.moves, |f| keeps.mux(from.word[f], self.w[f]));
        }
    }

    /// What the head writes is in w a cycle later: who is of its pixel is found while it goes there.
    fn follow(&self, enters_addr: Signal<'m>, steps: &[Move<'m>], goes: Signal<'m>) {
        let flags: Vec<_> = self.places.iter().map_while(|place| place.forwarded.as_ref()?.follows).collect();
        if flags.is_empty() {
            return;
        }
        self.m.comment(
            "The head reaches w one cycle later. Meanwhile each place compares its address with the head's.",
        );
        let head = self.head("addr");
        let enters = enters_addr.eq(head).named("enters_after_head");
        for (i, (Follows { flag, .. }, step)) in flags.into_iter().zip(steps).enumerate() {
            let behind = self.places[i + 1].entry["addr"].q().eq(head);
            let behind = behind.named(&format!("place{}_after_head", i + 1));
            let same = step.has_next.map_or(enters, |has_next| has_next.mux(behind, enters));
            flag.set(goes & same);
        }
    }
}
