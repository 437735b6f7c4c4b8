//! The least and greatest value that every number of the machine holds over a frame, beside its width.

use super::watch::{Sent, run};
use crate::tokens::MAX_CHANNELS;
use crate::view::{Item, Shape, View};
use crate::waits::Waits;
use edgewalk_machine::{ForeignVertex, Plan};

/// A number of the machine, and what it held.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Range {
    /// The unit; of a field of a token the kind of the token.
    pub unit: String,
    /// The register or field.
    pub name: String,
    /// Bits of the number.
    pub bits: u32,
    /// Of these bits, behind the point.
    pub fraction: u32,
    /// Two's complement.
    pub signed: bool,
    /// Modulo the range of its format: what it holds may wrap.
    pub modular: bool,
    /// The least value, in units of the last bit.
    pub least: i64,
    /// The greatest value.
    pub greatest: i64,
}

impl Range {
    fn of(unit: &str, name: &str, shape: Shape, [least, greatest]: [i64; 2]) -> Option<Range> {
        let Shape::Number { bits, fraction, signed, modular } = shape else { return None };
        let (unit, name) = (unit.to_owned(), name.to_owned());
        Some(Range { unit, name, bits, fraction, signed, modular, least, greatest })
    }

    /// Bits that these values need, 1 at the least.
    #[must_use]
    pub fn needed(&self) -> u32 {
        // A negative number needs as many as its complement, and every signed one a sign.
        let of = |value: i64| i64::BITS - (value ^ (value >> 63)).leading_zeros();
        (of(self.least).max(of(self.greatest)) + u32::from(self.signed)).max(1)
    }

    /// Bits at the top that no value needs.
    #[must_use]
    pub fn spare(&self) -> u32 {
        self.bits.saturating_sub(self.needed())
    }
}

/// Draws the frame and looks at every register in every cycle of the picture in which it means something, and at every field of every
/// token. Numbers that never mean something are left out.
///
/// # Errors
/// A triangle whose vertices were made for another machine.
pub fn ranges(plan: &Plan, sent: &Sent, waits: Waits) -> Result<Vec<Range>, ForeignVertex> {
    let (mut view, mut seen) = (View::of_ranges(), Vec::new());
    run::<MAX_CHANNELS>(
        plan,
        sent,
        waits,
        |rig, offered| {
            rig.model.view(plan, &rig.inputs(offered, true), &mut view);
            look(&view, &mut seen);
        },
        |_, _| (),
    )?;
    Ok(collect(&view, &seen))
}

/// Takes down what registers hold in the cycle seen last.
fn look(view: &View, seen: &mut Vec<Option<[i64; 2]>>) {
    let (registers, values) = (&view.structure().registers, view.values());
    seen.resize(registers.len(), None);
    for ((register, value), seen) in registers.iter().zip(values).zip(seen) {
        if register.live.is_some_and(|live| values[live] == 0) {
            continue;
        }
        let value = register.shape.value(*value);
        let [least, greatest] = seen.unwrap_or([value; 2]);
        *seen = Some([least.min(value), greatest.max(value)]);
    }
}

/// By unit in the order of the data, then by kind of token.
fn collect(view: &View, seen: &[Option<[i64; 2]>]) -> Vec<Range> {
    let (structure, mut found) = (view.structure(), Vec::new());
    for unit in &structure.units {
        let ids = unit.items.iter().flat_map(|item| match item {
            Item::Register(id) => vec![*id],
            Item::Table(table) => table.rows.iter().flat_map(|row| row.cells.clone()).collect(),
            _ => Vec::new(),
        });
        for id in ids {
            let register = &structure.registers[id];
            let range = seen.get(id).copied().flatten();
            found
                .extend(range.and_then(|range| Range::of(&unit.name, &register.name, register.shape, range)));
        }
    }
    for kind in view.tokens().kinds() {
        let fields = kind.ranges();
        found.extend(
            fields.filter_map(|(field, range)| Range::of(&kind.name, field.name, field.shape, range)),
        );
    }
    found
}
