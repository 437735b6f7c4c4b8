//! The stages between the queue and w: one that weighs, and where there are two one that adds what was weighed.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Reg, Signal};

use super::prepare::{COLORS, Prepared};
use super::step::{Part as Weighed, product, sum, two_bits};
use crate::rmw::InFlight;
use crate::wires::{Part, Registers};

/// The registers.
pub(super) struct Stages<'m> {
    m: &'m Module,
    valid: Vec<Reg<'m>>,
    /// Of each stage what goes with the fragment as it is.
    carried: Vec<Registers<'m>>,
    own: [Reg<'m>; 3],
    base: [Reg<'m>; 3],
    weight: Reg<'m>,
    way: Way<'m>,
    /// What the second stage adds to.
    second: Option<Second<'m>>,
}

/// How it is weighed.
enum Way<'m> {
    /// All colours at once.
    SideBySide,
    /// One colour a clock; with two stages the product of the colour before waits to be added.
    OneByOne { turn: Reg<'m>, product: Option<Product<'m>> },
    /// Two bits of the weight a clock; what has been made of them.
    BitByBit { clock: Reg<'m>, last: u32, made: [Reg<'m>; 3] },
}

/// What is to be added to a base a clock later.
struct Product<'m> {
    whole: Reg<'m>,
    half: Reg<'m>,
}

/// The second stage: colours, and what is to be added to each; nothing to those that are done.
struct Second<'m> {
    base: [Reg<'m>; 3],
    products: [Option<Product<'m>>; 3],
}

/// What moves in this cycle.
pub(super) struct Flow<'m> {
    /// The first stage is empty, or its fragment moves on.
    pub room: Signal<'m>,
    /// The last stage's fragment goes to w.
    pub leaves: Signal<'m>,
    /// The first stage's fragment moves on.
    moves: Signal<'m>,
    /// The first stage is done.
    done: Signal<'m>,
}

impl<'m> Stages<'m> {
    /// Without updates yet.
    pub fn new(m: &'m Module, plan: &Plan, carried: Vec<Part>) -> Stages<'m> {
        let (bits, kt_bits, stages) = (plan.color.bits, plan.blend.kt_bits, plan.blend.stages);
        let colors =
            |name: &str, doc: &str| COLORS.map(|color| m.reg(&format!("{name}_{color}"), bits).doc(doc));
        let product = |name: &str| Product {
            whole: m.reg(&format!("{name}_product"), bits).doc("product to add, modular"),
            half: m.reg(&format!("{name}_half"), 1).doc("bit below the product"),
        };
        let valid = |i| m.reg(&format!("stage{i}_valid"), 1).doc("the stage holds a fragment").reset(0);
        let stage = |i| (valid(i), Registers::new(m, &format!("stage{i}"), carried.clone()));
        let (mut valid, mut carried) = (Vec::new(), Vec::new());
        let mut add_stage = |i| {
            let (flag, registers) = stage(i);
            valid.push(flag);
            carried.push(registers);
        };
        add_stage(0);
        let own = colors("stage0_own", "the fragment's colour");
        let base = colors("stage0_base", "base of the blend");
        let clocks = kt_bits.div_ceil(2);
        let weight_bits = if plan.blend.multipliers == 0 { 2 * clocks } else { kt_bits };
        let weight = m.reg("stage0_weight", weight_bits).doc("weight of the fragment's colour");
        let way = match plan.blend.multipliers {
            3 => Way::SideBySide,
            1 => Way::OneByOne {
                turn: m.reg("stage0_turn", 2).doc("0 red, 1 green, 2 blue"),
                product: (stages == 2).then(|| product("stage0")),
            },
            _ => Way::BitByBit {
                clock: m
                    .reg("stage0_clock", clocks.next_power_of_two().ilog2())
                    .doc("pairs of weight bits already used"),
                last: clocks - 1,
                made: colors("stage0_made", "partial result"),
            },
        };
        let second = (stages == 2).then(|| {
            add_stage(1);
            let added: [bool; 3] = match way {
                Way::SideBySide => [true; 3],
                Way::OneByOne { .. } => [false, false, true],
                Way::BitByBit { .. } => [false; 3],
            };
            let base = colors("stage1", "base, or the finished colour");
            let products = [0, 1, 2].map(|i| added[i].then(|| product(&format!("stage1_{}", COLORS[i]))));
            Second { base, products }
        });
        Stages { m, valid, carried, own, base, weight, way, second }
    }

    /// The fragments in them.
    pub fn in_flight(&self) -> Vec<InFlight<'m>> {
        let stage = |(valid, carried): (&Reg<'m>, &Registers<'m>)| InFlight {
            valid: valid.q(),
            addr: carried["addr"].q(),
        };
        self.valid.iter().zip(&self.carried).map(stage).collect()
    }

    /// What moves, `w_free` being room behind the last.
    pub fn flow(&self, w_free: Signal<'m>) -> Flow<'m> {
        let done = match &self.way {
            Way::SideBySide => self.m.lit(1, 1),
            Way::OneByOne { turn, .. } => turn.q().eq(2).named("done"),
            Way::BitByBit { clock, last, .. } => clock.q().eq(*last as i32).named("done"),
        };
        let first = self.valid[0].q();
        let at_end = match &self.way {
            Way::SideBySide => first,
            _ => first & done,
        };
        let (moves, leaves) = match self.valid.get(1) {
            None => {
                let leaves = (at_end & w_free).named("leaves");
                (leaves, leaves)
            }
            Some(second) => {
                let leaves = (second.q() & w_free).named("leaves");
                ((at_end & (!second.q() | leaves)).named("moves"), leaves)
            }
        };
        Flow { room: (!first | moves).named("room"), leaves, moves, done }
    }

    /// A field of what leaves, but for its colours.
    pub fn leaving(&self, field: &str) -> Signal<'m> {
        self.carried[self.carried.len() - 1][field].q()
    }

    /// Weighs what is in the first stage, moves it on, and takes the head: the word that leaves.
    pub fn step(
        &self,
        flow: &Flow<'m>,
        take: Signal<'m>,
        prepared: &Prepared<'m>,
        head: impl Fn(&str) -> Signal<'m>,
    ) -> Signal<'m> {
        let m = self.m;
        m.comment("First stage.");
        self.valid[0].when(flow.moves, 0).when(take, 1);
        self.carried[0].load(take, head);
        let (base, products) = self.weigh(flow, take, prepared);
        for i in 0..3 {
            self.own[i].when(take, prepared.own[i]);
            self.base[i].when(take, prepared.base[i]);
        }

        let result = |base: Signal<'m>, product: Option<Weighed<'m>>| {
            product.map_or(base, |product| sum(base, product))
        };
        let Some(second) = &self.second else {
            return m.cat(&[0, 1, 2].map(|i| result(base[i], products[i])));
        };
        m.comment("Second stage.");
        self.valid[1].when(flow.leaves, 0).when(flow.moves, 1);
        self.carried[1].load(flow.moves, |f| self.carried[0][f].q());
        let done = [0, 1, 2].map(|i| {
            second.base[i].when(flow.moves, base[i]);
            let product = second.products[i].as_ref().zip(products[i]).map(|(register, product)| {
                register.whole.when(flow.moves, product.whole);
                register.half.when(flow.moves, product.half);
                Weighed { whole: register.whole.q(), half: register.half.q() }
            });
            result(second.base[i].q(), product)
        });
        m.cat(&done)
    }

    /// The bases in the last clock of the first stage, and what is to be added to them.
    fn weigh(
        &self,
        flow: &Flow<'m>,
        take: Signal<'m>,
        prepared: &Prepared<'m>,
    ) -> ([Signal<'m>; 3], [Option<Weighed<'m>>; 3]) {
        let (own, base) = (self.own.map(Reg::q), self.base.map(Reg::q));
        match &self.way {
            Way::SideBySide => {
                self.weight.when(take, prepared.weight);
                let each =
                    |i: usize| product(self.m, own[i], base[i], self.weight.q(), &format!("_{}", COLORS[i]));
                (base, [0, 1, 2].map(|i| Some(each(i))))
            }
            Way::OneByOne { turn, product: kept } => {
                self.weight.when(take, prepared.weight);
                turn.when(!flow.done, turn.q() + 1).when(take, first_clock(prepared, 2, turn));
                let of = |colors: [Signal<'m>; 3]| {
                    turn.q().bit(1).mux(colors[2], turn.q().bit(0).mux(colors[1], colors[0]))
                };
                let product = product(self.m, of(own), of(base), self.weight.q(), "");
                match kept {
                    None => {
                        let mixed = sum(of(base), product).named("mixed");
                        self.base[0].when(turn.q().eq(0), mixed);
                        self.base[1].when(turn.q().eq(1), mixed);
                        ([base[0], base[1], mixed], [None; 3])
                    }
                    Some(kept) => {
                        kept.whole.when(!flow.done, product.whole).when(take, 0);
                        kept.half.when(!flow.done, product.half).when(take, 0);
                        let before = turn.q().eq(1).mux(base[0], base[1]);
                        let added = Weighed { whole: kept.whole.q(), half: kept.half.q() };
                        let mixed = sum(before, added).named_doc("mixed", "the colour of the clock before");
                        self.base[0].when(turn.q().eq(1), mixed);
                        ([base[0], mixed, base[2]], [None, None, Some(product)])
                    }
                }
            }
            Way::BitByBit { clock, last, made } => {
                let weight = self.weight.q();
                // An odd number of bits has a 0 below them, which changes nothing: made is base then.
                let padded = weight.width() - prepared.weight.width();
                let first = if padded == 0 {
                    prepared.weight
                } else {
                    self.m.cat(&[prepared.weight, self.m.lit(padded, 0)])
                };
                self.weight.when(!flow.done, weight.shr(2)).when(take, first);
                clock.when(!flow.done, clock.q() + 1).when(take, first_clock(prepared, *last, clock));
                let bits = [weight.bit(0), weight.bit(1)];
                let mixed = [0, 1, 2].map(|i| {
                    let mixed = two_bits(made[i].q(), [own[i], base[i]], bits, flow.done);
                    let mixed = mixed.named(&format!("mixed_{}", COLORS[i]));
                    made[i].when(!flow.done, mixed).when(take, prepared.base[i]);
                    mixed
                });
                (mixed, [None; 3])
            }
        }
    }
}

/// The number of the first clock: the last one if there is nothing to weigh.
fn first_clock<'m>(prepared: &Prepared<'m>, last: u32, clock: &Reg<'m>) -> Signal<'m> {
    prepared.weighs.mux(clock.q().module().lit(clock.q().width(), 0), last as i32)
}
