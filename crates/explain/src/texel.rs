//! The texel of a pixel: which one the terms u and v name, what stands there, and what TEXEL makes of the colour with it.

use edgewalk_golden::{Fragment, PixelBrush};
use edgewalk_host::shade::Textured;
use edgewalk_machine::{Plan, Record};
use serde::Serialize;
use std::fmt::Write as _;

/// Why the texel of the machine is another than golden's.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Other {
    /// The terms name a neighbour of the one that golden's place lies in.
    Neighbour,
    /// The sides of the picture do not divide those of the machine's texture.
    Sides,
}

impl Other {
    /// The reason as a clause of a sentence.
    fn why(self, machine_side: f64) -> String {
        match self {
            Other::Neighbour => "the terms name a neighbour of the one at its place".to_owned(),
            Other::Sides => format!("the sides of its picture do not divide {machine_side}"),
        }
    }
}

/// What TEXEL does at a pixel.
#[derive(Debug, Serialize)]
pub struct TexelRead {
    /// Column and line where golden's place lies, texels of the machine.
    golden: [f64; 2],
    /// How far the terms may be from it, texels.
    bound: f64,
    /// Texels of the machine along a side.
    #[serde(skip)]
    side: f64,
    /// Column and line that the terms name.
    texel: [u32; 2],
    /// Why golden's picture has another texel there, if it has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub other_texel: Option<Other>,
    /// In the memory of the textures.
    address: usize,
    /// What stands there, LSB.
    word: [u64; 3],
    /// The slopes beside it along u and v, with BUMP, of 2^(bits - 1) for the relief's largest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slopes: Option<[i64; 2]>,
    /// The relief's own, in the same unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    exact_slopes: Option<[f64; 2]>,
    /// The colour before, as PIXEL hands it on, LSB.
    #[serde(skip_serializing_if = "Option::is_none")]
    before: Option<[u64; 3]>,
    /// The colour behind, LSB.
    #[serde(skip_serializing_if = "Option::is_none")]
    product: Option<[u64; 3]>,
    /// The exact one by the same texel, LSB.
    exact: [f64; 3],
    /// How far the product may be from it, LSB; none where nothing is proved of the colour before.
    product_bound: Option<f64>,
}

impl TexelRead {
    /// Of a fragment; `before` is the colour of PIXEL where it is known.
    pub fn of(
        machine: &Plan,
        brush: &PixelBrush,
        fragment: &Fragment,
        (of, record, words): (&Textured, &Record, &[u128]),
        before: Option<[u64; 3]>,
    ) -> Option<TexelRead> {
        let (b, max) = (machine.color.bits, machine.color.max() as f64);
        let texel = of.texel([fragment.x, fragment.y]);
        let address = machine.texel_place(record.material, texel[0], texel[1]);
        let word = *words.get(address)?;
        let bits = machine.shade.slope_bits;
        let signed = |word: u128| ((word as i64) << (64 - bits)) >> (64 - bits);
        let slopes = machine.shade.bumps().then(|| [signed(word >> bits), signed(word)]);
        let word = word >> (machine.texel_word_bits() - 3 * b);
        // At most 16 bits.
        let word = [2, 1, 0].map(|place| (word >> (place * b)) as u64 & machine.color.max());
        let exact = of.texture.exact(texel);
        let own = exact.color.to_array();
        let place = brush.place(fragment)?;
        let other_texel = match brush.texel(fragment) {
            _ if texel != of.nearest(place) => Some(Other::Neighbour),
            golden if golden != exact => Some(Other::Sides),
            _ => None,
        };
        let whole = 2f64.powi(bits as i32 - 1);
        let relief = of.texture.relief.as_ref();
        let colors = fragment.rgb();
        let product = |before: [u64; 3]| {
            [0, 1, 2].map(|k| {
                let product = before[k] * word[k] + (1 << (b - 1));
                (product + (product >> b)) >> b
            })
        };
        let surface = machine.proved_budget(&machine.channels()[1]);
        Some(TexelRead {
            golden: of.texture.texels_of(place),
            bound: of.error,
            texel,
            other_texel,
            side: of.texture.side(),
            address,
            word,
            slopes,
            exact_slopes: relief.map(|relief| (exact.slopes / relief.one * whole).to_array()),
            before,
            product: before.map(product),
            exact: [0, 1, 2].map(|k| colors[k] * own[k] * max),
            product_bound: surface.ok().map(|budget| {
                let error = budget.after_rounding().to_f64();
                of.product_error(colors.into_iter().fold(0.0, f64::max) * max, error)
            }),
        })
    }

    /// As lines of text; writing to a string cannot fail.
    pub fn text(&self) -> String {
        let TexelRead { golden: [u, v], bound, texel: [column, line], address, word, exact, .. } = self;
        let mut page = format!(
            "texel column {column}, line {line}: golden's place {u:.4} {v:.4}, within {bound:.6}; address {address}: red {} green {} blue {}\n",
            word[0], word[1], word[2]
        );
        if let Some(other) = self.other_texel {
            _ = writeln!(page, "  golden's picture has another texel there: {}", other.why(self.side));
        }
        if let (Some(before), Some(product)) = (self.before, self.product) {
            let bound =
                self.product_bound.map_or_else(|| "no bound".to_owned(), |bound| format!("bound {bound:.4}"));
            for (k, name) in ["red", "green", "blue"].into_iter().enumerate() {
                let error = product[k] as f64 - exact[k];
                _ = writeln!(
                    page,
                    "  {name:<5}  {} x {} / max = {}, exact {:.4}, error {error:.4}, {bound}",
                    before[k], word[k], product[k], exact[k]
                );
            }
        }
        if let (Some([u, v]), Some([exact_u, exact_v])) = (self.slopes, self.exact_slopes) {
            _ = writeln!(page, "  relief: B_u {u}, exact {exact_u:.4}; B_v {v}, exact {exact_v:.4}");
        }
        page
    }
}
