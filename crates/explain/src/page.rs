//! The page of text.

use super::additions::{Addition, Walk};
use super::{Explanation, Stored};
use edgewalk_host::extra::{BEFORE, Label};
use std::fmt::Write as _;

/// Rows of additions shown at either end.
const SHOWN: usize = 8;

// Writing to a string cannot fail.
pub(super) fn text(of: &Explanation, color_bits: u32) -> String {
    let mut page =
        format!("pixel ({}, {}): z {:.9}, rgb {}{}\n", of.x, of.y, of.z, three(of.rgb), own(&of.extra));
    if let Some(Stored { id, z, rgb: [r, g, b] }) = &of.stored {
        let by = if *id < 0 { "no triangle".to_owned() } else { format!("triangle {id}") };
        _ = writeln!(page, "the machine stores: z {z}, rgb {r} {g} {b}, by {by}");
    }
    if let Some(why) = &of.not_stored {
        _ = writeln!(page, "the machine does not draw it: {why}");
    }
    _ = writeln!(page, "triangles over it: {}", of.fragments.len());
    for over in &of.fragments {
        let seen = if over.id as i64 == i64::from(of.id) { "  seen" } else { "" };
        let own = own(&over.extra);
        _ = writeln!(page, "  {:>6}  z {:.9}  rgb {}{own}{seen}", over.id, over.z, three(over.rgb));
    }
    page += &super::layers::text(&of.layers, color_bits);
    if let Some(light) = &of.light {
        _ = writeln!(page, "\nlight at {}, normal {}", three(light.position), three(light.normal));
        _ = writeln!(page, "  emission            {}", three(light.emission));
        _ = writeln!(page, "  ambient             {}", three(light.ambient));
        for part in &light.lights {
            _ = writeln!(page, "  {:<11} diffuse  {}", part.kind, three(part.diffuse));
            _ = writeln!(page, "              specular {}", three(part.specular));
            _ = writeln!(
                page,
                "              r_l      {:.3} by the map, {:.3} by a ray",
                part.r_map, part.r_ray
            );
        }
        _ = writeln!(page, "  sum, none hidden    {}", three(light.total));
    }
    for (place, pixel) in of.shaded.iter().enumerate() {
        if of.shaded.len() > 1 {
            _ = write!(page, "\nlight {}:", place + 1);
        }
        page += &super::shaded::text(pixel);
    }
    of.shadows.iter().for_each(|pixel| page += &super::shadowed::text(pixel));
    if let Some(reason) = &of.no_shadows {
        _ = writeln!(page, "\nno map on the machine: {reason}");
    }
    of.polygons.iter().for_each(|polygon| page += &super::edges::text(polygon, (of.x, of.y)));
    of.poly.iter().for_each(|polygon| page += &super::active::text(polygon, (of.x, of.y)));
    page += &of.dithered.as_ref().map(super::dithered::text).unwrap_or_default();
    if let Some(walk) = &of.machine {
        machine(&mut page, walk);
    }
    if let Some(reason) = of.no_additions {
        _ = writeln!(page, "\nno additions: {reason}");
    }
    page
}

/// The machine's way: depth beside red, then a table for each channel of the user's own.
fn machine(page: &mut String, walk: &Walk) {
    _ = writeln!(page, "\nadditions to here: {} (Z, R, G, B in LSB)", walk.additions.len() - 1);
    _ = writeln!(
        page,
        "  step    pixel            value Z       added Z     error Z     bound     error R     bound"
    );
    rows(page, walk, |of| format!("{}  {:>10.6}  {:>8.6}", row(of, 0), of.error[1], of.bound[1]));
    for (i, label) in walk.channels.iter().enumerate().skip(BEFORE) {
        let Label { name, kind, bits, unit } = label;
        _ = writeln!(page, "\n{name}: {kind}, {unit} of {bits} bits; output {}", walk.output[i]);
        _ = writeln!(page, "  step    pixel             value         added       error     bound");
        rows(page, walk, |of| row(of, i));
    }
}

/// The additions of one table: all, or those at either end.
fn rows(page: &mut String, walk: &Walk, row: impl Fn(&Addition) -> String) {
    let additions = &walk.additions;
    for (place, of) in additions.iter().enumerate() {
        if place == SHOWN && additions.len() > 2 * SHOWN {
            _ = writeln!(page, "  ... {} more; all of them with --json", additions.len() - 2 * SHOWN);
        }
        if place < SHOWN || place + SHOWN >= additions.len() {
            let pixel = format!("({}, {})", of.x, of.y);
            _ = writeln!(page, "  {:<6}  {pixel:<13} {}", of.step, row(of));
        }
    }
}

/// Value, what was added, error and bound of channel `i`.
fn row(of: &Addition, i: usize) -> String {
    let (value, added, error, bound) = (of.value[i], of.added[i], of.error[i], of.bound[i]);
    format!("{value:>12.3}  {added:>12.4}  {error:>10.6}  {bound:>8.6}")
}

/// Channels of the user's own, LSB.
fn own(values: &[f64]) -> String {
    let named = values.iter().enumerate().map(|(place, value)| format!(", e{place} {value:.6}"));
    named.collect()
}

fn three(values: [f64; 3]) -> String {
    values.map(|value| format!("{value:8.5}")).join(" ")
}
