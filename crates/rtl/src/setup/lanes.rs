//! The lanes as instances, and their steps; the numbers they take in are `operands`.

use std::sync::Arc;

use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};
use edgewalk_netlist::{BuildErrors, Instance, Module, Netlist, Reg, Signal};

use super::control::Control;
use super::factors::Factors;
use super::lane::{Shape, lane};
use super::steps::{Length, Op, Step, StepCodes, channel_of, edge_of, round_clocks, rounds};

/// One lane in place.
pub(super) struct Lane<'m> {
    /// Which one.
    pub number: usize,
    pub shape: Shape,
    pub instance: Instance<'m>,
}

/// The lanes, with everything connected but what they take in.
pub(super) fn lanes<'m>(
    m: &'m Module,
    plan: &Plan,
    control: &Control<'m>,
    factors: &Factors<'m>,
    right: Signal<'m>,
) -> Result<Vec<Lane<'m>>, BuildErrors> {
    let shapes: Vec<Shape> =
        (0..plan.lanes as usize).map(|number| Shape::new(plan, &channels(plan, number))).collect();
    let netlists = netlists(&shapes)?;
    let common = Common::new(m, plan, control, factors, right);
    let in_place = |(number, (shape, netlist)): (usize, (Shape, Arc<Netlist>))| {
        m.comment(&format!("Lane {number}: its steps."));
        let instance = m.instance(&format!("lane{number}"), &netlist);
        common.connect(number, instance);
        Lane { number, shape, instance }
    };
    Ok(shapes.into_iter().zip(netlists).enumerate().map(in_place).collect())
}

/// One netlist a lane; lanes of the same shape share it.
fn netlists(shapes: &[Shape]) -> Result<Vec<Arc<Netlist>>, BuildErrors> {
    let mut netlists: Vec<Arc<Netlist>> = Vec::new();
    for (i, shape) in shapes.iter().enumerate() {
        let same = shapes[..i].iter().position(|other| other == shape);
        netlists.push(match same {
            Some(other) => Arc::clone(&netlists[other]),
            None => lane(&format!("edgewalk_setup_lane{i}"), *shape)?,
        });
    }
    Ok(netlists)
}

/// The channels of a lane, in their rounds.
fn channels(plan: &Plan, lane: usize) -> Vec<Channel> {
    (0..rounds(plan)[1]).filter_map(|round| channel_of(plan, lane, round)).collect()
}

/// What all lanes do in a clock.
struct Common<'a, 'm> {
    m: &'m Module,
    plan: &'a Plan,
    control: &'a Control<'m>,
    factors: &'a Factors<'m>,
    codes: StepCodes<'m>,
    /// The step that is named.
    step: Signal<'m>,
    /// In the next clock, in place of what is formed, while numbers do not fit: the sign, then digits.
    of_pause: Signal<'m>,
    read_at: ReadAt<'m>,
    write: Signal<'m>,
    write_at: Signal<'m>,
    take_modulus: Signal<'m>,
    nearest: Signal<'m>,
    upwards: Signal<'m>,
    negated: Signal<'m>,
}

/// The slot of the addend.
struct ReadAt<'m> {
    sums: Signal<'m>,
    signs: Signal<'m>,
    base: Signal<'m>,
    single: Signal<'m>,
}

impl<'a, 'm> Common<'a, 'm> {
    fn new(
        m: &'m Module,
        plan: &'a Plan,
        control: &'a Control<'m>,
        factors: &'a Factors<'m>,
        right: Signal<'m>,
    ) -> Common<'a, 'm> {
        let codes = StepCodes::new(m);
        m.comment("Commands of all lanes.");
        let code = |step: Step| codes.of(step);
        let these = |which: &dyn Fn(Op) -> bool| Op::all(plan).filter(|op| which(*op)).collect::<Vec<_>>();
        let steps = |step: Step| these(&|op| op.doing().step == step);
        let mut step = code(Step::Rest);
        for of in [Step::Take, Step::Double2, Step::Next, Step::Sign, Step::Add] {
            step = control.way.named.one_of(&steps(of)).mux(code(of), step);
        }
        let first = control.sequence.first.mux(code(Step::First), code(Step::Next));
        step = control.way.named.one_of(&steps(Step::First)).mux(first, step);
        let step = step.named("step");

        let of_pause = control.pause.advance.mux(code(Step::Begin), code(Step::Digits));

        let slots = |slot: u32, sum: bool| {
            these(&|op| {
                op.doing().slot == slot
                    && matches!(op.doing().step, Step::First | Step::Next | Step::Sign) == sum
            })
        };
        let single = (1..8).fold(m.lit(3, 0), |chosen, slot| {
            let ops = slots(slot, false);
            if ops.is_empty() { chosen } else { control.way.named.one_of(&ops).mux(slot as i32, chosen) }
        });
        let read_at = ReadAt {
            sums: control
                .way
                .named
                .one_of(&these(&|op| matches!(op.doing().step, Step::First | Step::Next)))
                .named("is_sum"),
            signs: control.way.named.one_of(&steps(Step::Sign)).named("is_sign"),
            base: control.way.named.one_of(&slots(4, true)).named("of_gradients"),
            single: single.named("read_single_at"),
        };
        let writers = these(&|op| op.doing().result.is_some());
        // What did not fit is written again when it does.
        let write = (control.way.stepped.ends & control.way.stepped.one_of(&writers)).named("write");
        let write_at = (2..8).fold(m.lit(3, 1), |chosen, slot| {
            let ops = these(&|op| op.doing().result == Some(slot));
            if ops.is_empty() { chosen } else { control.way.stepped.one_of(&ops).mux(slot as i32, chosen) }
        });
        let with_another = [Op::TakeDx, Op::Take12, Op::TakeA, Op::TakeB];
        let exact = plan.edge_kind == EdgeKind::Exact;
        let only = |in_these: bool, is: Signal<'m>| if in_these { is } else { m.lit(1, 0) };
        let [is_cut, upwards, negated] = [
            control.way.rest.is(Op::SumStart)
                | only(exact, control.way.rest.one_of(&[Op::DoubleDx, Op::Sum])),
            only(exact && plan.fill == Fill::Exact, control.way.rest.is(Op::Sum)),
            only(
                plan.fill == Fill::Exact && !plan.polygon.is_there(),
                control.way.rest.is(Op::DoubleX) & right,
            ),
        ];
        Common {
            m,
            plan,
            control,
            factors,
            codes,
            step,
            of_pause,
            read_at,
            write,
            write_at: write_at.named("write_at"),
            take_modulus: control.way.named.one_of(&with_another).named("take_modulus"),
            nearest: (!is_cut).named("nearest"),
            upwards: upwards.named("upwards"),
            negated: negated.named("negated"),
        }
    }

    fn connect(&self, number: usize, instance: Instance<'m>) {
        let (m, control) = (self.m, self.control);
        let named = |name: &str| format!("{name}{number}");
        let step = self.step_of(number).named(&named("step"));
        let next = m.reg(&named("step_next"), Step::BITS);
        let waits_for_none = self.plan.fill == Fill::Exact && edge_of(self.plan, number, 0).is_none();
        let formed = if waits_for_none {
            next.set(step).q()
        } else {
            let next = next.when(control.pause.advance, step).q();
            // The step after the numbers: in exact fill the doubling of DX.
            let kept = (self.plan.fill == Fill::Textbook).then(|| m.reg(&named("step_again"), Step::BITS));
            let again = kept.map_or(self.codes.of(self.first_doubling()), Reg::q);
            let of_pause = control.pause.left.eq(2).mux(again, self.of_pause);
            let of_pause = m.reg(&named("step_of_pause"), Step::BITS).set(of_pause).q();
            let formed = control.pause.advance.mux(next, of_pause).named(&named("step_formed"));
            if let Some(kept) = kept {
                kept.when(control.pause.advance, formed);
            }
            formed
        };
        instance
            .connect("read_at", self.read_at(number))
            .connect("step", formed)
            .connect("write", self.write)
            .connect("write_at", self.write_at)
            .connect("take_modulus", self.take_modulus)
            .connect("give", control.way.rest.ends)
            .connect("nearest", self.nearest)
            .connect("upwards", self.upwards)
            .connect("negate", self.negated);
    }

    /// The first step in which DX is doubled.
    fn first_doubling(&self) -> Step {
        match Op::DoubleDx.doing().length {
            Length::Doublings(number) if number(self.plan, &self.plan.channels()[0]) == 1 => Step::Double1,
            _ => Step::Double2,
        }
    }

    /// A lane with fewer doublings than the longest does its last ones with it; of an odd number the last is
    /// single.
    fn step_of(&self, number: usize) -> Signal<'m> {
        let (m, control, rounds) = (self.m, self.control, rounds(self.plan)[1]);
        let code = |step: Step| self.codes.of(step);
        let mut step = self.step;
        for op in Op::all(self.plan) {
            let (doublings, scaled) = match op.doing().length {
                Length::Doublings(doublings) => (doublings, false),
                Length::Scaled(doublings) => (doublings, true),
                _ => continue,
            };
            let of_edge = op.is_of_edge(self.plan);
            let in_round = |round: usize| {
                let channel = channel_of(self.plan, number, round).filter(|_| !of_edge);
                let own = doublings(self.plan, &channel.unwrap_or(self.plan.channels()[0]));
                (own, round_clocks(self.plan, doublings, of_edge, round))
            };
            let all_double_twice = |round: usize| {
                let (own, longest) = in_round(round);
                own == 2 * longest
            };
            if (0..if of_edge { 1 } else { rounds }).all(all_double_twice) {
                continue;
            }
            let of_round = |round: usize| {
                let (own, longest) = in_round(round);
                let one_clock = longest == 1 && !scaled;
                let chosen = match own % 2 {
                    0 => code(Step::Double2),
                    _ if one_clock => code(Step::Double1),
                    _ => control.sequence.left.eq(0).mux(code(Step::Double1), code(Step::Double2)),
                };
                if own.div_ceil(2) == longest {
                    return chosen;
                }
                let mut clocks = m.lit(control.sequence.left.width(), own.div_ceil(2).into());
                if scaled {
                    clocks = clocks + control.feedback.scale.q().zext(control.sequence.left.width());
                }
                control.sequence.left.lt(clocks).mux(chosen, code(Step::Rest))
            };
            let chosen = if of_edge { of_round(0) } else { control.way.named.of_round(rounds, of_round) };
            step = control.way.named.is(op).mux(chosen, step);
        }
        control.rests.mux(code(Step::Rest), step)
    }

    fn read_at(&self, number: usize) -> Signal<'m> {
        let (m, at) = (self.m, &self.read_at);
        let mut digits = self.factors.digits;
        let second_beside_others = edge_of(self.plan, number, 0) == Some(2);
        if second_beside_others {
            let is = self.control.way.named.is(Op::Sum);
            digits = [0, 1].map(|side| is.mux(self.factors.of_second[side], digits[side]));
        }
        let digits = [0, 1].map(|side| at.signs.mux(self.factors.signs[side], digits[side]));
        let some = digits[0] | digits[1];
        let slot = m.cat(&[at.base & some, digits[1], digits[0]]);
        (at.sums | at.signs).mux(slot, at.single)
    }
}
