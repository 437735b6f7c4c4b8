//! The turned normal: its cosines, and the square of its length.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use super::{SQUARE, SQUARES};
use crate::cut::cut;
use crate::wires::{Part, Token, moved};

/// What all stages share.
pub(super) struct Turn<'a, 'm> {
    pub m: &'m Module,
    pub plan: &'a Plan,
    pub advance: Signal<'m>,
    pub cosines: &'a [Part],
}

/// What K1 multiplies.
pub(super) struct Products<'m> {
    /// Of each cosine its growth along u and along v, times the slope.
    of_cosines: Vec<[Signal<'m>; 2]>,
    /// The slopes by each other, with NORMAL behind: u u, u v, v v.
    pub of_slopes: Option<[Signal<'m>; 3]>,
}

impl<'m> Turn<'_, 'm> {
    /// A register of a stage.
    fn moved(&self, name: &str, doc: &str, value: Signal<'m>) -> Signal<'m> {
        moved(self.m, self.advance, name, doc, value)
    }

    /// Fraction bits of a slope.
    fn one(&self) -> u32 {
        self.plan.shade.slope_bits - 1
    }

    /// K1: products with the slopes.
    pub fn products(&self, frag: &Token<'m>) -> Products<'m> {
        self.m.comment("K1: products with the slopes.");
        let slopes = [("u", frag["bu"]), ("v", frag["bv"])];
        let of_cosine = |part: &Part| {
            slopes.map(|(way, slope)| {
                let name = format!("{}{way}", part.name);
                self.moved(
                    &format!("k1_{name}"),
                    "slope times growth of the cosine",
                    frag[name.as_str()].smul(slope),
                )
            })
        };
        let of_cosines = self.cosines.iter().map(of_cosine).collect();
        let pairs =
            [("uu", 0, 0), ("uv", 0, 1), ("vv", 1, 1)].map(|(name, i, j)| (name, slopes[i].1, slopes[j].1));
        let of_slopes = self.plan.shade.normalises().then(|| {
            pairs.map(|(name, a, b)| self.moved(&format!("k1_{name}"), "product of two slopes", a.smul(b)))
        });
        Products { of_cosines, of_slopes }
    }

    /// K2: the cosines of the turned normal.
    pub fn sums(&self, k1: &Token<'m>, products: &Products<'m>) -> Vec<Signal<'m>> {
        self.m.comment("K2: the cosines of the turned normal.");
        let products = self.cosines.iter().zip(&products.of_cosines);
        products.map(|(part, along)| self.sum(part, k1[part.name.as_str()], *along)).collect()
    }

    /// A cosine and what it grows by along u and along v, cut to the bits of the cosine.
    fn sum(&self, part: &Part, cosine: Signal<'m>, [along_u, along_v]: [Signal<'m>; 2]) -> Signal<'m> {
        let (m, one, normalises) = (self.m, self.one(), self.plan.shade.normalises());
        // Three numbers below 2^(b + bits - 2) in magnitude.
        let width = cosine.width() + one + 2;
        let half = if normalises { 1 << (one - 1) } else { 0 };
        let scaled = m.cat(&[cosine.sext(width - one), m.lit(one, half)]);
        let sum = scaled + along_u.sext(width) + along_v.sext(width);
        let doc = if normalises { "exact sum plus the rounding half" } else { "exact" };
        let sum = sum.named_doc(&format!("sum_{}", part.name), doc);
        let turned = sum.slice(width - 1, one + self.plan.shade.cosine_fraction());
        let turned = turned.named(&format!("turned_{}", part.name));
        let turned = cut(m, &part.name, turned, part.width);
        self.moved(&format!("k2_{}", part.name), &part.doc, turned)
    }

    /// K2, with NORMAL behind: what the square of the length grows by.
    pub fn growths(&self, k1: &Token<'m>, of_slopes: [Signal<'m>; 3]) -> Vec<Signal<'m>> {
        let growth = |(name, slopes): (&str, Signal<'m>)| {
            self.moved(&format!("k2_{name}"), "growth of nn", k1[name].smul(slopes))
        };
        SQUARES.into_iter().zip(of_slopes).map(growth).collect()
    }

    /// K3: N.N of the turned normal; the cosines wait for it.
    pub fn square(&self, sums: &mut [Signal<'m>], nn: Signal<'m>, growths: Vec<Signal<'m>>) -> Signal<'m> {
        let (m, one) = (self.m, self.one());
        m.comment("K3: N.N of the turned normal.");
        for (part, sum) in self.cosines.iter().zip(sums) {
            *sum = self.moved(&format!("k3_{}", part.name), &part.doc, *sum);
        }
        // Four numbers of at most 2^(2 * bits + 15) in magnitude.
        let width = nn.width() + 2 * one + 3;
        let scaled = m.cat(&[nn.sext(width - 2 * one), m.lit(2 * one, 0)]);
        let sum = growths.into_iter().fold(scaled, |sum, growth| sum + growth.sext(width));
        let turned = sum.named_doc("sum_nn", "exact").slice(width - 1, 2 * one).named("turned_nn");
        self.moved("k3_nn", "N.N, 2^16 for 1.0", cut(m, SQUARE, turned, nn.width()))
    }
}
