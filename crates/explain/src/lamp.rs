//! What LAMP makes of a pixel's terms: three roots, what is divided by them, and what is left of the light (`docs/machine.md`, section 17).

use super::normal::Index;
use super::table_read::TableRead;
use edgewalk_machine::Plan;
use serde::Serialize;
use std::fmt::Write as _;

/// 1.0 in LAMP.
const ONE: i64 = 1 << 16;

/// The steps of a fragment.
#[derive(Debug, Serialize)]
pub struct Lamp {
    /// Of l·l, of N·N, of 1 + L·V.
    roots: Vec<Root>,
    /// What is divided by them.
    products: Vec<Product>,
    /// What the distance leaves of the light.
    attenuation: Look,
    /// 1 - the cosine to the axis, 2^-16, and where the cone ends.
    beside: i64,
    edge: i64,
    /// What the cone lets through; none beside it.
    #[serde(skip_serializing_if = "Option::is_none")]
    cone: Option<Look>,
    /// What is left of the light, 2^-16, golden's, and how far it may be from that.
    beam: i64,
    golden_beam: f64,
    beam_bound: f64,
    /// N·L, weakened, and N·H in entries of SHADE's tables.
    indices: Vec<Index>,
    /// The highlight, weakened, LSB.
    #[serde(skip_serializing_if = "Option::is_none")]
    highlight: Option<i64>,
}

/// 1/√x of a number x in 2^-30: x·4^k = m·2^14, y is that of m, 2^-16.
#[derive(Debug, Serialize)]
struct Root {
    of: &'static str,
    x: i64,
    k: u32,
    m: i64,
    entry: i64,
    y: i64,
}

/// A number in 2^-23 over a root, 2^-16.
#[derive(Debug, Serialize)]
struct Product {
    name: &'static str,
    number: i64,
    over: &'static str,
    value: i64,
}

/// A look between two words of the memory of the roots.
#[derive(Debug, Serialize)]
struct Look {
    entry: i64,
    low: i64,
    value: i64,
}

impl Lamp {
    /// Of a pixel: `output` is that of a term by its name, `words` those of the memory of the roots, `beam` golden's and how far the machine's
    /// may be from it, `read` what an index reads.
    pub fn of(
        machine: &Plan,
        words: &[u128],
        gloss: u32,
        output: impl Fn(&str) -> Option<i64>,
        beam: (f64, f64),
        read: impl Fn(usize, i64) -> Option<TableRead>,
    ) -> Option<Lamp> {
        let word = |entry: i64| words.get(entry as usize).map(|word| [word >> 16, word & 0xffff]);
        let look = |entry: i64, low: i64| {
            let [v, slope] = word(entry)?.map(|part| part as i64);
            Some(Look { entry, low, value: (v - ((slope * low + (1 << 9)) >> 10)) & 0x1_ffff })
        };
        let root = |of: &'static str, x: i64| {
            let x = x.clamp(0, (1 << 30) - 1);
            let k = (1..=7).take_while(|k| x << (2 * k) < 1 << 30).last().unwrap_or(0);
            let m = (x << (2 * k) >> 14).max(1 << 14);
            let entry = m >> 8;
            Some(Root { of, x, k, m, entry, y: look(entry, (m & 0xff) << 2)?.value })
        };
        let divided = |name: &'static str, number: i64, by: &Root| {
            let near = cut(((number << by.k) + (1 << 6)) >> 7);
            Product { name, number, over: by.of, value: times(near, by.y) }
        };
        let way = root("l.l", output("dd")?)?;
        let attenuation = look(512 + 64 * i64::from(way.k) + (way.m >> 10), way.m & 0x3ff)?;
        let toward = divided("N.L, of N as it is", output("pl")?, &way);
        let along = divided("L.V", output("dv")?, &way);
        let axis = divided("cosine to the axis", output("da")?, &way);
        let normal = root("N.N", output("nn")? << 14)?;
        let diffuse = divided("N.L", toward.value << 7, &normal);
        let viewed = divided("N.V", output("pv")?, &normal);
        let (beside, edge) = (ONE - axis.value, word(0)?[0] as i64);
        let place = beside.clamp(0, ONE - 1);
        let cone = if beside > edge { None } else { Some(look(256 + (place >> 8), (place & 0xff) << 2)?) };
        let left = times(attenuation.value, cone.as_ref().map_or(0, |cone| cone.value));
        let both = root("(1 + L.V)/2", (ONE + along.value) << 13)?;
        let halfway = divided("N.H", (diffuse.value + viewed.value) << 6, &both);

        let (t, m) = (machine.shade.table_bits, machine.shade.gloss_bits);
        let scaled = ((halfway.value - ONE) << gloss) + ONE;
        let indices = [("nl0", diffuse.value * left, 32 - t, t + 2), ("nh0", scaled, 16 - t, t + m + 2)];
        let indices = indices.into_iter().enumerate();
        let indices: Vec<Index> =
            indices.map(|(place, number)| Index::of(number, |index| read(place, index))).collect();
        let highlight = indices[1].read.as_ref().map(|read| {
            let most = machine.color.max() as i64; // 16 bits at most
            ((read.highlight * left + (1 << 15)) >> 16).min(most)
        });
        Some(Lamp {
            roots: vec![way, normal, both],
            products: vec![toward, along, axis, diffuse, viewed, halfway],
            attenuation,
            beside,
            edge,
            cone,
            beam: left,
            golden_beam: beam.0,
            beam_bound: beam.1,
            indices,
            highlight,
        })
    }

    /// As lines of text; writing to a string cannot fail.
    pub fn text(&self) -> String {
        let mut page = String::new();
        for Root { of, x, k, m, entry, y } in &self.roots {
            _ = writeln!(
                page,
                "root of {of}: {x} / 2^30 = {m} / 4^{k} / 2^16; entry {entry}: 1/root {y} / 2^16"
            );
        }
        for Product { name, number, over, value } in &self.products {
            _ = writeln!(page, "{name}: {number} / 2^23 over the root of {over} = {value} / 2^16");
        }
        let Look { entry, value, .. } = self.attenuation;
        _ = writeln!(page, "attenuation: entry {entry}: {value} / 2^16");
        let (beside, edge) = (self.beside, self.edge);
        match &self.cone {
            Some(Look { entry, value, .. }) => {
                _ = writeln!(
                    page,
                    "cone: {beside} beside the axis, edge {edge}; entry {entry}: {value} / 2^16"
                );
            }
            None => _ = writeln!(page, "cone: {beside} beside the axis, beyond the edge {edge}: dark"),
        }
        let (golden, bound) = (self.golden_beam, self.beam_bound);
        let error = self.beam as f64 / ONE as f64 - golden;
        _ = writeln!(
            page,
            "beam: {} / 2^16, golden's {golden:.6}, error {error:.6}, bound {bound:.6}",
            self.beam
        );
        self.indices.iter().for_each(|index| page += &index.text());
        if let Some(highlight) = self.highlight {
            _ = writeln!(page, "highlight, weakened: {highlight}");
        }
        page
    }
}

fn times(a: i64, b: i64) -> i64 {
    cut((a * b + (1 << 15)) >> 16)
}

/// Cut to 18 bits.
fn cut(number: i64) -> i64 {
    number.clamp(-2 * ONE, 2 * ONE - 1)
}
