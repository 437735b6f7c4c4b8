//! Which combinations can be built, and the reason where one cannot.

use crate::channel::{Channel, MAX_CHANNELS};
use crate::error::MachineError;
use crate::keys::KEYS;
use crate::machine::{EdgeKind, Fill, Machine, SetupKind};
use crate::shade::ShadeColour;
use crate::shadow::LIGHT_SPACE;
use crate::term::{self, WORD_BITS as TERM_BITS};

/// Longest interpolated word.
pub const WORD_BITS: u32 = 56;

/// Longest word of a light's map.
pub const MAP_BITS: u32 = 32;

/// Accepts the machine with these channels, or names the key that stands in the way, the reason, and a value
/// that would do: the first rule that is broken.
pub(crate) fn check(machine: &Machine, channels: &[Channel]) -> Result<(), MachineError> {
    screen(machine)?;
    lines(machine)?;
    polygons(machine)?;
    for channel in channels {
        formats(machine, channel)?;
    }
    if machine.shade.textures() && machine.shade.colour == ShadeColour::Tables {
        return Err(MachineError::rule(
            machine,
            "texture.kind",
            "a texture has no effect while shade.colour = tables; or set shade.colour = multiply".to_owned(),
            "none".to_owned(),
        ));
    }
    if machine.shade.is_positional() {
        positional(machine)?;
    }
    terms(machine)?;
    if machine.shadow.projects() {
        project(machine)?;
    }
    let map_word = machine.shadow.depth_bits + machine.color.bits;
    if machine.shadow.transmits() && map_word > MAP_BITS {
        return Err(MachineError::rule(
            machine,
            "shadow.depth_bits",
            format!(
                "a word of the map would have {map_word} bits, {} of them for the share of light; permitted: at most {MAP_BITS}",
                machine.color.bits
            ),
            (MAP_BITS - machine.color.bits).to_string(),
        ));
    }
    if machine.shadow.draws_map() {
        own_pass(machine)?;
    }
    dither(machine)?;
    if channels.len() > MAX_CHANNELS {
        if machine.extra == 0 {
            return Err(MachineError::rule(
                machine,
                "blend.kind",
                format!(
                    "with the four values of a perspective light and k_t there are {} channels, {MAX_CHANNELS} is the most",
                    channels.len()
                ),
                "constant".to_owned(),
            ));
        }
        let own = machine.extra as usize;
        return Err(MachineError::rule(
            machine,
            "channels.extra",
            format!(
                "with those of the units there are {} channels, {MAX_CHANNELS} is the most",
                channels.len()
            ),
            own.saturating_sub(channels.len() - MAX_CHANNELS).to_string(),
        ));
    }
    if machine.adders as usize > channels.len() {
        return Err(MachineError::rule(
            machine,
            "interpolator.adders",
            format!("there are only {} channels to add", channels.len()),
            channels.len().to_string(),
        ));
    }
    Ok(())
}

/// Every value lies in its key's domain, and the screen in the guard band.
fn screen(machine: &Machine) -> Result<(), MachineError> {
    for key in KEYS {
        let shown = key.show(machine);
        if key.parse(&shown).is_none() {
            return Err(MachineError::value(key, &shown));
        }
    }
    let side = machine.width.max(machine.height);
    in_guard_band(machine, side, "the screen is", "pixels wide or high")?;
    if machine.fill == Fill::Textbook && machine.subpixel_bits != 0 {
        return Err(MachineError::rule(
            machine,
            "screen.subpixel_bits",
            "textbook fill takes integer vertices".to_owned(),
            "0".to_owned(),
        ));
    }
    Ok(())
}

/// Lines want half a pixel, a rule that counts centres, and nobody who walks down only.
fn lines(machine: &Machine) -> Result<(), MachineError> {
    let refusal =
        |reason: &str| Err(MachineError::rule(machine, "polygon.lines", reason.to_owned(), "no".to_owned()));
    if !machine.polygon.has_lines() {
        Ok(())
    } else if machine.fill == Fill::Textbook {
        refusal("a line wants edge.fill = exact, which counts the centres of pixels")
    } else if machine.subpixel_bits == 0 {
        refusal("lines need screen.subpixel_bits of 1 or more, as one begins half a pixel beside its end")
    } else if machine.shade.is_there() {
        refusal("TERM walks down only, and a line may go up; lines need shade.kind = none")
    } else {
        Ok(())
    }
}

/// POLY wants the lines of exact fill, and SETUP side by side.
fn polygons(machine: &Machine) -> Result<(), MachineError> {
    let refusal =
        |reason: &str| Err(MachineError::rule(machine, "polygon.edges", reason.to_owned(), "0".to_owned()));
    if !machine.polygon.is_there() {
        Ok(())
    } else if machine.fill == Fill::Textbook {
        refusal("POLY wants edge.fill = exact: textbook fill draws both ends of a span, and its pixels twice")
    } else if machine.setup_kind == SetupKind::Sequenced {
        refusal("the program of SETUP has no steps for polygons; POLY wants setup.kind = parallel")
    } else {
        bilinear(machine)
    }
}

/// Colours along edges want remainders of one modulus, and no colours of another kind.
fn bilinear(machine: &Machine) -> Result<(), MachineError> {
    if !machine.polygon.is_bilinear() {
        return Ok(());
    }
    if machine.edge_kind != EdgeKind::Slope {
        let reason = "polygon.values = bilinear wants remainders of one modulus, as slope edges have them";
        return Err(MachineError::rule(machine, "edge.kind", reason.to_owned(), "slope".to_owned()));
    }
    if machine.shade.is_there() {
        let reason = "shading makes the colours at each pixel, and none would be seen of those of the edges";
        return Err(MachineError::rule(machine, "polygon.values", reason.to_owned(), "plane".to_owned()));
    }
    Ok(())
}

/// A screen with sides of so many pixels, or a map that the machine draws.
fn in_guard_band(machine: &Machine, side: u32, what: &str, unit: &str) -> Result<(), MachineError> {
    if side <= 1 << machine.guard_bits {
        return Ok(());
    }
    Err(MachineError::rule(
        machine,
        "screen.guard_bits",
        format!("{what} {side} {unit} and must lie in the guard band"),
        side.next_power_of_two().ilog2().to_string(),
    ))
}

/// The machine can draw its map: as a screen, with depths of its own, and the plane of k by BLEND.
fn own_pass(machine: &Machine) -> Result<(), MachineError> {
    in_guard_band(machine, machine.shadow.size, "shadow.own_pass = yes draws a map of", "texels a side")?;
    if machine.shadow.depth_bits > machine.z.bits {
        return Err(MachineError::rule(
            machine,
            "shadow.depth_bits",
            format!(
                "shadow.own_pass = yes draws the map with the depths of pixels, of {} bits",
                machine.z.bits
            ),
            machine.z.bits.to_string(),
        ));
    }
    if machine.shadow.transmits() && !machine.blend.is_there() {
        return Err(MachineError::rule(
            machine,
            "blend.kind",
            "with shadow.own_pass and shadow.transmits = yes BLEND draws what is left of the light"
                .to_owned(),
            "constant".to_owned(),
        ));
    }
    Ok(())
}

/// The section and beginning of the keys of a channel's formats.
fn keys_of(channel: &Channel) -> String {
    match channel.name {
        "r" | "g" | "b" => "formats.color".to_owned(),
        "z" => "formats.z".to_owned(),
        "kt" => "blend.kt".to_owned(),
        name if LIGHT_SPACE.contains(&name) => "shadow.light".to_owned(),
        extra => format!("channels.{extra}"),
    }
}

fn formats(machine: &Machine, channel: &Channel) -> Result<(), MachineError> {
    let keys = keys_of(channel);
    if channel.vertex_fraction > channel.fraction {
        return Err(MachineError::rule(
            machine,
            &format!("{keys}_vertex"),
            format!("a vertex cannot have more fraction bits than the interpolator ({})", channel.fraction),
            channel.fraction.to_string(),
        ));
    }
    if channel.word() > WORD_BITS {
        return Err(MachineError::rule(
            machine,
            &format!("{keys}_fraction"),
            format!("the word would have {} bits, {WORD_BITS} is the most", channel.word()),
            (WORD_BITS - channel.bits).to_string(),
        ));
    }
    if channel.word() < 2 * machine.segments {
        return Err(MachineError::rule(
            machine,
            "interpolator.segments",
            format!("a word of {} bits has no {} segments of two bits", channel.word(), machine.segments),
            "1".to_owned(),
        ));
    }
    Ok(())
}

/// DITHER leaves fewer bits than there are, and what it leaves is not blended; a fragment is dropped in pictures only.
fn dither(machine: &Machine) -> Result<(), MachineError> {
    let (bits, color) = (machine.dither.bits, machine.color.bits);
    if machine.dither.is_there() && machine.blend.is_there() {
        let reason = "with DITHER colours are not read back: they would be rounded once more for each layer"
            .to_owned();
        return Err(MachineError::rule(machine, "blend.kind", reason, "none".to_owned()));
    }
    if machine.dither.rounds() && bits >= color {
        let reason = format!("colours have {color} bits (formats.color_bits), and DITHER leaves fewer");
        let fewer = (4..color.min(8)).next_back().unwrap_or(0);
        return Err(MachineError::rule(machine, "dither.bits", reason, fewer.to_string()));
    }
    if machine.dither.drops() && machine.shadow.draws_map() {
        let reason = "with shadow.own_pass = yes DITHER would drop fragments of the light's pass by the pattern of the picture";
        return Err(MachineError::rule(machine, "dither.screen_door", reason.to_owned(), "no".to_owned()));
    }
    Ok(())
}

/// LAMP has one light, and no relief before it.
fn positional(machine: &Machine) -> Result<(), MachineError> {
    if machine.shade.lights > 1 {
        let reason = "with shade.light = positional there is one light at a time".to_owned();
        return Err(MachineError::rule(machine, "shade.lights", reason, "1".to_owned()));
    }
    if machine.shade.bumps() {
        let reason = "a relief wants shade.light = directional".to_owned();
        return Err(MachineError::rule(machine, "texture.bump", reason, "no".to_owned()));
    }
    Ok(())
}

/// No word of a term is longer than a word of the model.
fn terms(machine: &Machine) -> Result<(), MachineError> {
    for (degree, key) in [(2, "term.fraction"), (1, "term.linear_fraction")] {
        let terms = term::terms(machine).into_iter().filter(|term| term.degree == degree);
        let Some(longest) = terms.max_by_key(|term| term.word()) else { continue };
        if longest.word() > TERM_BITS {
            return Err(MachineError::rule(
                machine,
                key,
                format!(
                    "the word of {} would have {} bits, {TERM_BITS} is the most",
                    longest.name,
                    longest.word()
                ),
                (TERM_BITS - longest.bits).to_string(),
            ));
        }
    }
    Ok(())
}

/// What is divided has the bits of its quotients at least.
fn project(machine: &Machine) -> Result<(), MachineError> {
    let (p, bz, side) = (machine.shadow.light_bits, machine.shadow.depth_bits, machine.shadow.side_bits());
    if p >= bz.max(side) {
        return Ok(());
    }
    let (what, bits) =
        if bz >= side { ("a depth in the map has", bz) } else { ("a column of the map has", side) };
    Err(MachineError::rule(
        machine,
        "shadow.light_bits",
        format!("{what} {bits} bits, and a value that is divided may not have fewer"),
        bits.to_string(),
    ))
}
