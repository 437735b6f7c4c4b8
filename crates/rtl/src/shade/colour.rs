//! The sums of the lights: stages L, M and C.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Reg, Signal};

use super::largest;
use super::tables::Light;
use crate::wires::{Registers, moved};

/// The colours, in the order of a word: red, the most significant, first.
pub(super) const COLOURS: [&str; 3] = ["r", "g", "b"];

/// What the lights give in stage B.
pub(super) struct Shone<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub advance: Signal<'m>,
    pub lights: Vec<Light<'m>>,
}

impl<'m> Shone<'_, 'm> {
    /// Stage C where the tables hold colours.
    pub fn told(&self) -> [Reg<'m>; 3] {
        let b = self.plan.color.bits;
        self.m.comment("Stage C: sum over all lights, saturated at the largest colour.");
        let highlights = self.highlights();
        [0, 1, 2].map(|i| {
            let low = (2 - i as u32) * b;
            let own = self.lights.iter().map(|light| light.diffuse.slice(low + b - 1, low));
            let all = total(own.chain(highlights.iter().copied()).collect());
            self.colour(i, all)
        })
    }

    /// Stages L, M and C where they hold the light; the colours of the triangle stand in stage L.
    pub fn multiplied(&self, triangle: &Registers<'m>) -> [Reg<'m>; 3] {
        let (m, b) = (self.m, self.plan.color.bits);
        m.comment("Stage L: sum of diffuse light, at most 1.0; sum of the highlights.");
        let sum = total(self.lights.iter().map(|light| light.diffuse).collect());
        // 1.0 is one bit, so whatever is more has that bit or one above.
        let whole =
            sum.slice(sum.width() - 1, b + 2).any().named_doc("whole", "diffuse light saturates at 1.0");
        let light = m.cat(&[whole, whole.mux(0, sum.trunc(b + 2))]);
        let light = moved(m, self.advance, "l_light", "sum of diffuse light, 2^-(b+2)", light);
        let highlights = self.cut(total(self.highlights()), "highlights");
        let highlight = moved(m, self.advance, "l_highlight", "sum of the highlights", highlights);
        m.comment("Stage M: light times the triangle's colour.");
        let highlight = moved(m, self.advance, "m_highlight", "sum of the highlights", highlight);
        let colours = COLOURS.map(|name| {
            let product = (triangle[name].q() * light).named(&format!("product_{name}"));
            let half = m.lit(product.width(), 1 << (b + 1));
            let nearest = (product + half).slice(2 * b + 1, b + 2);
            moved(m, self.advance, &format!("m_{name}"), "triangle's colour times diffuse light", nearest)
        });
        m.comment("Stage C: product plus highlight, saturated at the largest colour.");
        [0, 1, 2].map(|i| self.colour(i, total(vec![colours[i], highlight])))
    }

    /// Of each light; none below the horizon.
    fn highlights(&self) -> Vec<Signal<'m>> {
        let lights = self.lights.iter().enumerate();
        lights.map(|(i, light)| light.lit.mux(light.highlight, 0).named(&format!("s{i}"))).collect()
    }

    fn colour(&self, i: usize, all: Signal<'m>) -> Reg<'m> {
        let name = COLOURS[i];
        let register = self.m.reg(&format!("c_{name}"), self.plan.color.bits).doc("colour of the pixel");
        register.when(self.advance, self.cut(all, &format!("all_{name}")))
    }

    /// At most the largest colour; the sum gets a name.
    fn cut(&self, sum: Signal<'m>, name: &str) -> Signal<'m> {
        let (bits, sum) = (self.plan.color.bits, sum.named(name));
        if sum.width() == bits {
            return sum;
        }
        sum.slice(sum.width() - 1, bits).any().mux(largest(self.m, bits), sum.trunc(bits))
    }
}

/// The sum of numbers of one width, with the bits that it may have more.
fn total(numbers: Vec<Signal<'_>>) -> Signal<'_> {
    let bits = numbers[0].width() + (numbers.len() as u32).next_power_of_two().ilog2();
    let wide = numbers.into_iter().map(|number| number.zext(bits));
    wide.reduce(|sum, one| sum + one).expect("a light at least")
}
