//! A pixel that is shaded: the walk of its terms, what the tables hold there, and how far golden is.

use super::additions::Walk;
use super::lamp::Lamp;
use super::normal::Normal;
use super::table_read::TableRead;
use super::texel::TexelRead;
use super::turned::Turned;
use edgewalk_golden::{PixelBrush, Texel, fragments};
use edgewalk_host::shade::{Feed, IndexErrors, Place};
use edgewalk_machine::{Plan, PortVertex, Record};
use edgewalk_numerics::term::TermWords;
use edgewalk_scene::Frame;
use serde::Serialize;
use std::fmt::Write as _;

/// Rows of a walk shown at either end.
const SHOWN: usize = 4;

/// What TERM and SHADE make of a pixel.
#[derive(Debug, Serialize)]
pub struct ShadedPixel {
    /// The number of the triangle's material.
    material: u32,
    /// Of each light N·L, then N·H; with NORMAL then N·N; with BUMP then what they grow by; with LAMP what it takes; with a texture then u and v.
    terms: Vec<TermWalk>,
    /// Where the surface has a texture.
    #[serde(skip_serializing_if = "Option::is_none")]
    texel: Option<TexelRead>,
    /// Where a relief turns the normal: each cosine behind BUMP.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    turned: Vec<Turned>,
    /// What NORMAL makes of these.
    #[serde(skip_serializing_if = "Option::is_none")]
    normal: Option<Normal>,
    /// What LAMP does in its place.
    #[serde(skip_serializing_if = "Option::is_none")]
    lamp: Option<Lamp>,
    /// Proved bound of the stored colour against golden's, LSB, with the step of DITHER; golden with the machine's texel, where its own
    /// is another.
    bound: Option<f64>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_bound: Option<String>,
}

/// The way of a term from where its record begins to the pixel: down, then along the span.
#[derive(Debug, Serialize)]
struct TermWalk {
    name: &'static str,
    bits: u32,
    fraction: u32,
    steps: Vec<TermStep>,
    /// The word's floor: what SHADE takes.
    output: i64,
    /// The word, in units of the output.
    value: f64,
    /// Where it is the index of a table.
    #[serde(skip_serializing_if = "Option::is_none")]
    read: Option<TableRead>,
}

/// Words of a term, signed, in units of their last bit.
#[derive(Debug, Serialize)]
struct TermStep {
    step: &'static str,
    x: i64,
    y: i64,
    v: i64,
    x_step: i64,
    y_step: i64,
}

/// Of pixel (x, y), which shows triangle `id`; `leftward` says which way its spans run, `walk` what PIXEL makes of it.
pub fn shaded(
    machine: &Plan,
    frame: &Frame,
    feed: &Feed,
    id: usize,
    (x, y): (u32, u32),
    (leftward, walk): (bool, Option<&Walk>),
) -> Option<ShadedPixel> {
    let (record, errors) = (feed.words.records.get(id)?, feed.proof.errors.get(id)?);
    let brush = PixelBrush::new(frame.shading.as_ref()?, id)?;
    let (mut cosines, mut beam, mut texel) = (Vec::new(), 1.0, None);
    let colors = walk.and_then(|walk| walk.output.get(1..4)?.try_into().ok());
    let before = colors.map(|colors: [i64; 3]| colors.map(|color| color as u64)); // not negative
    let screen = (frame.width, frame.height);
    fragments(&frame.triangles[id], frame.mode, machine.subpixel_bits, screen, |fragment| {
        if (fragment.x, fragment.y) == (x, y) {
            let own = feed.proof.textured.get(id).and_then(Option::as_ref);
            let named = own.map(|own| own.texture.exact(own.texel([x, y])));
            cosines = brush.cosines(fragment, &named.unwrap_or(Texel::BLANK));
            if machine.shade.is_positional() {
                let there = brush.intensities(fragment).first().map_or(0.0, |i| i.max_element());
                let full = feed.intensities.first().map_or(0.0, |i| i.max_element());
                beam = if full > 0.0 { there / full } else { 0.0 };
            }
            if let Some(own) = own {
                texel = TexelRead::of(machine, &brush, fragment, (own, record, &feed.words.textures), before);
            }
        }
    });
    let glosses = feed.glosses(id);
    // What the index of a cosine reads.
    let read = |place: usize, output: i64| {
        let (light, highlight) = (place / 2, place % 2 == 1);
        let (gloss, bound) = of_term(errors, &glosses, light, highlight);
        let entries = 2f64.powi(machine.shade.table_bits as i32);
        // N·L comes weakened.
        let cosine = cosines.get(light)?[place % 2] * if highlight { 1.0 } else { beam };
        let entry = output.clamp(0, entries as i64 - 1) as u32;
        let at = machine.table_place(record.material, light as u32, entry);
        let golden = entries - (1.0 - cosine) * entries * 2f64.powi(gloss as i32);
        let word = *feed.words.tables.get(at)?;
        let table = table(machine, word, highlight);
        let highlight = (word & u128::from(machine.color.max())) as i64;
        Some(TableRead { golden, bound, entry, table, highlight })
    };
    let terms = machine.terms().iter().zip(&record.terms).enumerate().map(|(place, (term, words))| {
        let words = TermWords::new(term.word(), *words)?;
        let steps = steps(record, &words, (i64::from(x), i64::from(y)), leftward);
        // Those of a texture have no sign.
        let of_texture = place >= machine.bumped_terms();
        let word = steps.last()?.v;
        let word = if of_texture { word.rem_euclid(1 << term.word()) } else { word };
        let output = word >> term.fraction;
        // NORMAL or BUMP may stand between terms and tables.
        let between = machine.shade.normalises() || machine.shade.bumps();
        let read = if between || of_texture { None } else { Some(read(place, output)?) };
        let value = word as f64 / 2f64.powi(term.fraction as i32);
        Some(TermWalk {
            name: term.name,
            bits: term.bits,
            fraction: term.fraction,
            steps,
            output,
            value,
            read,
        })
    });
    // Lights that the frame has not are left out.
    let terms: Vec<TermWalk> = terms.flatten().collect();
    let output = |name: &str| terms.iter().find(|term| term.name == name).map(|term| term.output);
    let slopes = texel.as_ref().and_then(|texel: &TexelRead| texel.slopes);
    let turned = slopes.map_or_else(Vec::new, |slopes| super::turned::all(machine, slopes, output, read));
    let roots = &feed.words.roots;
    let bumped = |name: &str| {
        let of_turned = turned.iter().find(|turned| turned.name == name).map(|turned| turned.after);
        of_turned.or_else(|| output(name))
    };
    let normal = match machine.shade.has_normal() {
        true => Normal::of(machine, roots, record.gloss, bumped, read),
        false => None,
    };
    let lamp = match machine.shade.is_positional() {
        true => Lamp::of(machine, roots, record.gloss, output, (beam, errors.beam), read),
        false => None,
    };
    let (material, bound, no_bound) = (record.material, *feed.proof.bounds.get(id)?, feed.proof.no_bound);
    let bound = no_bound.is_none().then_some(bound + machine.dither_step());
    let no_bound = no_bound.map(|why| why.to_string());
    Some(ShadedPixel { material, terms, texel, turned, normal, lamp, bound, no_bound })
}

/// m' and the bound of the index; N·L is scaled by the table alone.
fn of_term(errors: &IndexErrors, glosses: &[u32], light: usize, highlight: bool) -> (u32, f64) {
    match highlight {
        true => (glosses[light], errors.highlight[light]),
        false => (0, errors.diffuse),
    }
}

fn steps(record: &Record, words: &TermWords, (x, y): (i64, i64), leftward: bool) -> Vec<TermStep> {
    let (from_x, from_y) = (i64::from(record.x), i64::from(record.y));
    let columns = if leftward { from_x - x } else { x - from_x };
    let step = |name, i: i64, n: i64| {
        let there = words.moved(i, n);
        let signed = |word: u64| {
            let unused = 64 - words.width();
            ((word << unused) as i64) >> unused
        };
        let [v, x_step, y_step, ..] = there.words().map(signed);
        let x = if leftward { from_x - i } else { from_x + i };
        TermStep { step: name, x, y: from_y + n, v, x_step, y_step }
    };
    let lines = y - from_y;
    let mut steps = vec![step("record", 0, 0)];
    steps.extend((1..=lines).map(|n| step("down", 0, n)));
    let name = if columns < 0 { "back" } else { "forward" };
    steps.extend((1..=columns.abs()).map(|i| step(name, i * columns.signum(), lines)));
    steps
}

/// What a word of the tables says.
fn table(machine: &Plan, word: u128, highlight: bool) -> String {
    let (bits, max) = (machine.color.bits, u128::from(machine.color.max()));
    let part = |place: u32| (word >> (place * bits)) & max;
    if highlight {
        return format!("highlight {}", part(0));
    }
    if machine.shade.diffuse_bits(bits) == 3 * bits {
        return format!("red {} green {} blue {}", part(3), part(2), part(1));
    }
    format!("light {} / {}", word >> bits, 1u64 << (bits + 2))
}

/// As lines of text; writing to a string cannot fail.
pub fn text(of: &ShadedPixel) -> String {
    let other = of.texel.as_ref().and_then(|texel| texel.other_texel);
    let texel = if other.is_some() { " with the machine's texel" } else { "" };
    let within = match (of.bound, &of.no_bound) {
        (Some(bound), _) => format!("colour within {bound:.4} LSB of golden's{texel}"),
        (None, why) => format!("no bound of the colour: {}", why.as_deref().unwrap_or_default()),
    };
    let mut page = format!("\nmaterial {}: {within}\n", of.material);
    for term in &of.terms {
        let TermWalk { name, bits, fraction, steps, output, value, read } = term;
        _ = write!(page, "{name}, Q{bits}.{fraction}: {value:.4}, output {output}");
        if let Some(TableRead { golden, bound, entry, table, .. }) = read {
            let error = value - golden;
            _ = write!(
                page,
                "; golden's {golden:.4}, error {error:.6}, bound {bound:.6}; entry {entry}: {table}"
            );
        }
        page += "\n";
        for (place, step) in steps.iter().enumerate() {
            if place == SHOWN && steps.len() > 2 * SHOWN {
                _ = writeln!(page, "  ... {} more; all of them with --json", steps.len() - 2 * SHOWN);
            }
            if place < SHOWN || place + SHOWN >= steps.len() {
                let TermStep { step, x, y, v, x_step, y_step } = step;
                _ = writeln!(page, "  {step:<7}  ({x}, {y})  V {v:>14}  X {x_step:>12}  Y {y_step:>12}");
            }
        }
    }
    page += &of.texel.as_ref().map(TexelRead::text).unwrap_or_default();
    of.turned.iter().for_each(|turned| page += &turned.text());
    page += &of.normal.as_ref().map(Normal::text).unwrap_or_default();
    page += &of.lamp.as_ref().map(Lamp::text).unwrap_or_default();
    page
}

/// Spans of a triangle run to the left if its major edge is the right one.
pub fn leftward(machine: &Plan, triangle: &[PortVertex; 3]) -> bool {
    Place::of(machine, triangle).is_some_and(|place| place.leftward)
}
