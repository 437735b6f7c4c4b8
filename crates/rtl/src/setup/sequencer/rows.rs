//! What the lanes are told: which row, which step, what is written.

use edgewalk_netlist::Signal;

use super::Parts;
use super::code::{FIRST_VALUE, Jump, Mode, PART_BITS, ROW_BITS};
use super::control::Control;
use super::digits::Digits;
use super::shape::{channels, doublings, most_doublings};
use super::words::Input;
use crate::light_pass::LightPass;

/// Connects the inputs of all lanes.
pub(super) fn connect<'m>(
    parts: &Parts<'_, 'm>,
    control: &Control<'m>,
    digits: &Digits<'m>,
    input: &Input<'m>,
    light_pass: LightPass<'m>,
) {
    let Parts { m, word, runs, .. } = parts;
    m.comment("The step, a clock behind its word, and what is written, two clocks behind.");
    let get = |name: &str| word.get(name);
    let only = get("only");
    let allowed = !(only.eq(3) & control.walked[0]) & !(only.eq(4) & !control.right);
    let allowed = match parts.role {
        Some([thin, _]) => allowed & !(only.eq(5) & !thin.q()),
        None => allowed,
    };
    let steps = (get("steps") & *runs & allowed).named("starts_step");
    let later = |name: &str, signal| parts.later(name, signal);
    let minus = get("minus") ^ (get("by_side") & control.right);
    let told = [
        ("base", later("step_base", get("base"))),
        ("minus", later("step_minus", minus)),
        ("by_a", later("step_by_a", get("by_a"))),
        ("of_whole", later("step_of_whole", get("whole"))),
        ("only_negative", later("step_only_negative", only.eq(1))),
        ("only_positive", later("step_only_positive", only.eq(2))),
    ];
    let twice = |name: &str, signal| later(&format!("{name}_now"), later(&format!("{name}_next"), signal));
    let write_row = get("write_row");
    let write_row = control.number.map_or(write_row, |number| {
        let number = number & get("write_numbered").sext(3);
        m.cat(&[write_row.slice(write_row.width() - 1, 3), write_row.trunc(3) | number])
    });
    let write_row = input.fires.mux(input.row, twice("write_row", write_row).zext(ROW_BITS));
    // The rows that are there from the start stay as they are in the clocks before the first reset ends.
    let from_zero = |name: String, signal| m.reg(&name, 1).starts_at_zero().set(signal).q();
    let twice_from_zero =
        |name: &str, signal| from_zero(format!("{name}_now"), from_zero(format!("{name}_next"), signal));
    let write_a = twice_from_zero("write_a", get("write_a") & *runs);
    let write_w = twice_from_zero("write_w", get("write_w") & *runs);
    let raised = later("step_raised", get("raised"));
    let number = control.number.map(|number| later("step_number", number));
    let steps_later = later("does_step", steps);
    let pass = light_pass.number(m, 1, 0, 1);
    let rows: Vec<_> =
        (0..parts.lanes.len().min(3)).map(|lane| row(parts, control, digits, lane, pass)).collect();
    for (lane, instance) in parts.lanes.iter().enumerate() {
        // The fourth lane has no edge.
        instance.connect("read_row", *rows.get(lane).unwrap_or(&rows[0]));
        instance.connect("takes", input.takes[lane]);
        instance.connect("taken", input.taken[lane]);
        instance.connect("write_row", write_row);
        instance.connect("write_a", write_a);
        instance.connect("write_w", write_w);
        for (name, signal) in told {
            instance.connect(name, signal);
        }
        let rests = rests(parts, control, lane);
        let own = rests.map(|rests| later(&format!("does_step{lane}"), steps & !rests));
        instance.connect("steps", own.unwrap_or(steps_later));
        let mut raises: Vec<u32> = Vec::new();
        for (_, channel) in channels(parts.plan, lane) {
            let bits = doublings(parts.plan, channel);
            if raises.contains(&bits) {
                continue;
            }
            raises.push(bits);
            let alike = channels(parts.plan, lane).all(|(_, other)| doublings(parts.plan, other) == bits);
            let of_rounds = channels(parts.plan, lane)
                .filter(|(_, other)| doublings(parts.plan, other) == bits)
                .filter_map(|(round, _)| number.map(|number| number.eq(round as u128)))
                .reduce(|any, one| any | one);
            let raise = of_rounds.filter(|_| !alike).map_or(raised, |rounds| raised & rounds);
            instance.connect(&format!("raise_{bits}"), raise);
        }
    }
}

/// A lane whose channel has fewer doublings than another of its round does not do the last of them.
fn rests<'m>(parts: &Parts<'_, 'm>, control: &Control<'m>, lane: usize) -> Option<Signal<'m>> {
    let most = most_doublings(parts.plan);
    let spare = channels(parts.plan, lane)
        .map(|(round, channel)| (round, most[round] - doublings(parts.plan, channel)));
    let over = |(round, spare): (usize, u32)| {
        let few = control.count.le(u128::from(spare));
        match control.number {
            Some(number) if most.len() > 1 => few & number.eq(round as u128),
            _ => few,
        }
    };
    let over = spare.filter(|(_, spare)| *spare > 0).map(over).reduce(|any, one| any | one)?;
    Some(over & control.of_channels & parts.word.jumps(Jump::Again))
}

/// The place of the row that a lane reads.
fn row<'m>(
    parts: &Parts<'_, 'm>,
    control: &Control<'m>,
    digits: &Digits<'m>,
    lane: usize,
    pass: Signal<'m>,
) -> Signal<'m> {
    let Parts { m, word, .. } = parts;
    let row = word.get("row");
    let edge = control.edge(parts, lane);
    let digit = match control.beside {
        Some(beside) if lane > 0 && parts.has_own_edge(lane) => {
            beside.mux(digits.of(parts, lane), digits.of(parts, 0))
        }
        _ => digits.of(parts, 0),
    };
    let table = row.slice(ROW_BITS - 1, 2);
    let low = |low: Signal<'m>| m.cat(&[table, low]);
    // The place of the vertex: an edge leads from 0 to 2, from 0 to 1, or from 1 to 2.
    let place = row.slice(PART_BITS + 1, PART_BITS);
    let upper = m.cat(&[m.lit(1, 0), edge.eq(2)]);
    let lower = edge.eq(1).mux(m.lit(2, 1), 2);
    let place = word.is_mode(Mode::Upper).mux(upper, word.is_mode(Mode::Lower).mux(lower, place));
    let [first, second, third] = control.order;
    let of_order = place.eq(0).mux(first, place.eq(1).mux(second, place.eq(2).mux(third, 3)));
    let part = row.trunc(PART_BITS);
    let value = match control.number {
        Some(number) => (number.zext(PART_BITS) + FIRST_VALUE).named(&format!("value{lane}")),
        None => m.lit(PART_BITS, FIRST_VALUE),
    };
    let part = part.all().mux(value, part);
    let of_vertex = m.cat(&[m.lit(2, 2), of_order, part]);
    let is = |mode: Mode| word.is_mode(mode);
    let of_vertices = is(Mode::Vertex) | is(Mode::Upper) | is(Mode::Lower);
    let side = row.slice(1, 1);
    let side = parts.role.map_or(side, |[_, flat]| side ^ flat.q());
    let with_pass = m.cat(&[row.slice(ROW_BITS - 1, 2), side, pass]);
    let named =
        is(Mode::Digits).mux(low(digit), is(Mode::Edge).mux(low(edge), is(Mode::Pass).mux(with_pass, row)));
    let named = control.number.map_or(named, |number| {
        let numbered = m.cat(&[row.slice(ROW_BITS - 1, 3), row.trunc(3) | number]);
        is(Mode::Number).mux(numbered, named)
    });
    of_vertices.mux(of_vertex, named).named(&format!("row{lane}"))
}
