//! The walk with its words in a memory, through one adder.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use super::place::Place;
use super::record::{Record, V, X, XX, XY, Y, YY, places};
use super::{Words, lowest, sum};

pub(super) const DOC: &str =
    "Walk: in a memory of two reads and a write, through one adder; V, X and XX stand in registers too.
  down     V += Y of all terms, then X += XY, then Y += YY
  forward  V += X of all terms, then X += XX, then Y += XY
  back     X -= XX of all terms, then Y -= XY, then V -= X
An operation reads two words in one clock and writes one in the next, while the following one reads.";

/// An operation on words of the memory: the first takes the sum of both, or the difference.
type Operation = (u32, u32);

/// The operations of the steps down, forward and back.
fn operations(plan: &Plan) -> [Vec<Operation>; 3] {
    let places = places(plan);
    let of = |to: u32, from: u32, degree: u32| {
        let terms = places.iter().filter(move |(term, _)| term.degree >= degree);
        terms.map(move |(_, at)| (at + to, at + from)).collect()
    };
    [
        [of(V, Y, 1), of(X, XY, 2), of(Y, YY, 2)],
        [of(V, X, 1), of(X, XX, 2), of(Y, XY, 2)],
        [of(X, XX, 2), of(Y, XY, 2), of(V, X, 1)],
    ]
    .map(|kinds: [Vec<Operation>; 3]| kinds.concat())
}

/// The words, stepped where the walk `works`.
pub(super) fn words<'m>(
    m: &'m Module,
    plan: &Plan,
    works: Signal<'m>,
    place: &Place<'m>,
    record: &Record<'m>,
) -> Words<'m> {
    m.comment("The operations of a step, one a clock.");
    let [down, forward, back] = operations(plan);
    let (count, place_bits) = (down.len() as i32, plan.record_place_bits());
    let op = m.reg("op", (count as u32).next_power_of_two().ilog2()).doc("operation of the step").reset(0);
    let last = op.q().eq(count - 1).named("last_op");
    op.when(works, last.mux(0, op.q() + 1));
    let stepped = (works & last).named_doc("stepped", "the step is complete");
    let chosen = |name: &str, operations: &[Operation], operand: fn(&Operation) -> u32| {
        let word = |operation: &Operation| m.lit(place_bits, operand(operation).into());
        let (after, before) = operations.split_last().expect("a step has operations");
        let choices = before.iter().enumerate().rev();
        let chosen =
            choices.fold(word(after), |rest, (i, operation)| op.q().eq(i as i32).mux(word(operation), rest));
        chosen.named(name)
    };
    let [to, from]: [fn(&Operation) -> u32; 2] = [|operation| operation.0, |operation| operation.1];
    let is_back = (!place.down & !place.forward).named("back");
    // Down and forward change the same words in the same order.
    let target = is_back.mux(chosen("target_of_back", &back, to), chosen("target_of_others", &down, to));
    let along =
        place.forward.mux(chosen("source_of_forward", &forward, from), chosen("source_of_back", &back, from));
    let source = place.down.mux(chosen("source_of_down", &down, from), along);

    m.comment("The result is written one clock later.");
    let under_way = m.reg("under_way", 1).doc("a result is written in this clock").reset(0).set(works).q();
    let result_at = m.reg("result_at", place_bits).doc("word of the result").set(target.named("target")).q();
    let subtract = m.reg("subtract", 1).doc("the result is a difference").set(is_back).q();
    let write = (under_way | record.comes).named("write");
    let write_at = under_way.mux(result_at, record.place).named("write_at");
    let written = m.wire("written", record.word.width()).doc("result, or a word of the record");
    let words = m.memory("words", place_bits, 1 << place_bits, record.word.width());
    let words = words.doc("words in the order of the record").write(write, write_at, written);
    let (target, source) = (words.read(works, target), words.read(works, source.named("source")));
    let result = sum(target, source, subtract, "added").named("result");
    written.drive(under_way.mux(result, record.word));

    m.comment("Copies of V, X and XX for walked.");
    let mut shown = Vec::new();
    for (term, at) in places(plan) {
        let register = |part: &str, doc: &str| m.reg(&format!("{}_{part}", term.name), term.word()).doc(doc);
        let v = register("v", "term at (x, y), modular");
        let x = register("x", "step to the next pixel, modular");
        for (register, place) in [(v, at + V), (x, at + X)] {
            // Not from `written`: the choice goes into the cell of the register.
            let of_step = under_way & result_at.eq(place as i32);
            register.when(of_step, lowest(result, term.word()));
            record.load(register, place);
        }
        shown.extend([(format!("{}_v", term.name), v.q()), (format!("{}_g", term.name), x.q())]);
        if term.degree == 2 {
            let xx = register("xx", "change of x a pixel, modular");
            record.load(xx, at + XX);
            shown.push((format!("{}_gg", term.name), xx.q()));
        }
    }
    Words { shown, stepped, settled: Some((!under_way).named("settled")) }
}
