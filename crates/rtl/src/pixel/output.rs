//! The output of PIXEL: in each stage a fragment gets the bits of one more segment.

use edgewalk_machine::Plan;
use edgewalk_machine::units::tokens;
use edgewalk_netlist::{Module, Reg, Signal};

use super::adder::Words;
use super::drawing::Drawing;
use super::terms::Terms;
use crate::light_pass::LightPass;
use crate::wires::{Part, Registers, Token, parts};

/// What a fragment is made of.
pub(super) struct Output<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub drawing: &'a Drawing<'m>,
    pub words: &'a Words<'m>,
    pub terms: &'a Terms<'m>,
}

impl<'m> Output<'_, 'm> {
    /// The stages, and whether a fragment is in one of them; the last one is full where `frag_valid` is 1.
    pub fn stages(&self, frag_valid: Reg<'m>) -> (Token<'m>, Signal<'m>) {
        let Output { m, plan, drawing, .. } = *self;
        m.comment(if plan.segments == 1 {
            "Output register: loads a fragment while PIXEL advances."
        } else {
            "Output: each stage completes the bits of one more segment."
        });
        let address = self.address();
        let mut valid = drawing.emit;
        let mut fragment = Token::default();
        let mut occupied = frag_valid.q();
        for stage in 0..plan.segments as usize {
            let is_last = stage + 1 == plan.segments as usize;
            let name = if is_last { "frag".to_owned() } else { format!("out{stage}") };
            let source = |part: Part| {
                let signal = self.bits(&part, stage, &fragment, address)?;
                let is_depth = is_last && part.name == "z";
                Some((part, if is_depth { depth(plan, drawing.light_pass, signal) } else { signal }))
            };
            let source: Token = parts(&tokens::fragment(plan)).into_iter().filter_map(source).collect();
            let registers = Registers::new(m, &name, source.parts());
            registers.load(drawing.advance, |f| source[f]);
            let filled = if is_last { frag_valid } else { m.reg(&format!("{name}_valid"), 1).reset(0) };
            filled.when(drawing.advance, valid);
            occupied = if is_last { occupied } else { occupied | filled };
            valid = filled.q();
            fragment = registers.token();
        }
        (fragment, occupied)
    }

    /// The address of the pixel: its line, and below it its column.
    fn address(&self) -> Signal<'m> {
        let Output { m, plan, drawing, .. } = *self;
        let address = |x_bits: u32| {
            let (address, bits) = (m.cat(&[drawing.y, drawing.x.trunc(x_bits)]), plan.widths().address);
            if address.width() < bits { address.zext(bits) } else { address }
        };
        drawing.light_pass.choose(address(plan.widths().x), || address(plan.shadow.side_bits()))
    }

    /// The bits of a field that a stage has, those of the stage before below them; `None` if it has none.
    fn bits(&self, part: &Part, stage: usize, before: &Token<'m>, address: Signal<'m>) -> Option<Signal<'m>> {
        let Output { m, plan, drawing, .. } = *self;
        let low = before.get(&part.name);
        let high = plan.channel_place(&part.name);
        let high = high.and_then(|channel| self.words.output(plan, channel, stage));
        match (high, low, part.name.as_str()) {
            (Some(high), Some(low), _) => Some(m.cat(&[high, low])),
            (Some(bits), None, _) | (None, Some(bits), _) => Some(bits),
            (None, None, "addr") => Some(address),
            (None, None, "fence") => Some(drawing.fence),
            (None, None, "kt") => drawing.kt,
            (None, None, own) => self.terms.output(own).or(drawing.drawn.get(own).map(Reg::q)),
        }
    }
}

/// Of the map's depths the bits that its words have; the others are 0.
fn depth<'m>(plan: &Plan, light_pass: LightPass<'m>, z: Signal<'m>) -> Signal<'m> {
    let bits = plan.shadow.depth_bits;
    light_pass.choose(z, || if bits < z.width() { z.trunc(bits).zext(z.width()) } else { z })
}
