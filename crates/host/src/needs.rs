//! What a frame asks of a machine: every key that must have another value, all of them at once.

use crate::advice::{OR_GOLDEN, without_engine};
use crate::extra;
use crate::vertices::named;
use anyhow::Result;
use edgewalk_machine::keys::KEYS;
use edgewalk_machine::{Gate, OwnPass, Plan, ShadeColour, ShadeLight};
use edgewalk_scene::{Blending, Frame, Light, PixelMethod, PixelShading, ShadeMode, Shadow, Triangle};
use std::fmt;

/// A key of the machine that must have another value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Need {
    /// The key's name, as in `--set`.
    pub key: &'static str,
    /// The value that the frame asks for.
    pub value: String,
    /// What of the frame asks for it.
    pub why: String,
}

fn need(key: &'static str, value: impl ToString, why: String) -> Need {
    Need { key, value: value.to_string(), why }
}

/// Every key of the machine that the frame asks another value for. What no key can give is not among them.
#[must_use]
pub fn needs(frame: &Frame, machine: &Plan) -> Vec<Need> {
    let mut needs = Vec::from_iter(of_golden(frame, machine));
    if !frame.lines.is_empty() && !machine.polygon.has_lines() {
        let why = "lines: the machine's port takes triangles only (polygon.lines = no)".to_owned();
        needs.push(need("polygon.lines", "yes", why));
    }
    blending(frame, machine, &mut needs);
    if let Some(first) = frame.shadows.first() {
        shadows(first, &frame.shadows, machine, &mut needs);
    }
    match &frame.shading {
        Some(shading) => shaded(frame, shading, machine, &mut needs),
        None if machine.shade.is_there() => {
            let why = "shade.kind: the machine shades by normals and the input has none (a scene has them with \
                       --shading fast-phong or phong, a triangle file with such a mode)";
            needs.push(need("shade.kind", "none", why.to_owned()));
        }
        None => {}
    }
    needs
}

/// What maps of a scene's lights ask of the machine (`--shadows map`): PROJECT, BLEND for the sum of the parts, and shares of the light
/// behind surfaces that are seen through.
#[must_use]
pub fn maps(frame: &Frame, machine: &Plan) -> Vec<Need> {
    let mut needs = Vec::new();
    if !machine.shadow.projects() {
        let why = "a camera looks in perspective, and the machine has no PROJECT".to_owned();
        needs.push(need("shadow.light", "perspective", why));
    }
    if !machine.blend.is_there() {
        let why = "the part of each light is added, and the machine has no BLEND".to_owned();
        needs.push(need("blend.kind", "constant", why));
    }
    let is_seen_through = frame.passes().iter().any(|pass| pass.state.blend != Blending::Off);
    if is_seen_through && !machine.shadow.transmits() {
        let why = "a surface transmits light, and the machine's map says lit or not".to_owned();
        needs.push(need("shadow.transmits", "yes", why));
    }
    needs
}

/// The need of a frame that golden draws: it has the channels of the machine, and draws whatever else the machine lacks.
#[must_use]
pub fn of_golden(frame: &Frame, machine: &Plan) -> Option<Need> {
    let own = extra::channels(machine).len();
    (frame.extra != own).then(|| {
        let why = format!("extra {}: the machine has channels.extra = {own}", frame.extra);
        need("channels.extra", frame.extra, why)
    })
}

/// Accepts a frame whose every need the machine meets.
///
/// # Errors
/// All that it does not meet, with the settings that do.
pub fn check(frame: &Frame, machine: &Plan) -> Result<()> {
    met(&needs(frame, machine))
}

/// Accepts a machine that lacks nothing of this.
///
/// # Errors
/// All that it lacks, with the settings that give it.
pub fn met(needs: &[Need]) -> Result<()> {
    if needs.is_empty() {
        return Ok(());
    }
    let whys: Vec<&str> = needs.iter().map(|need| need.why.as_str()).filter(|why| !why.is_empty()).collect();
    let settings = needs.iter().map(|need| (need.key.to_owned(), need.value.clone())).collect();
    let by_golden = needs.iter().any(|need| need.key != "channels.extra");
    Err(NotMet { why: whys.join("; "), settings, by_golden }.into())
}

/// What a frame needs and the machine does not have; the words are those of the command line.
#[derive(Clone, Debug, PartialEq)]
pub struct NotMet {
    /// What was found.
    pub why: String,
    /// Keys and the values that meet it.
    pub settings: Vec<(String, String)>,
    /// Golden draws the frame as it is.
    pub by_golden: bool,
}

impl std::error::Error for NotMet {}

impl NotMet {
    /// What was found, and the settings that meet it.
    fn met_by_settings(&self) -> String {
        let settings: Vec<String> =
            self.settings.iter().map(|(key, value)| format!("--set {key}={value}")).collect();
        format!("{}; give {}", self.why, settings.join(" "))
    }
}

impl fmt::Display for NotMet {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let golden = if self.by_golden { OR_GOLDEN } else { "" };
        let settings = self.met_by_settings();
        write!(f, "{settings}, or --adapt, which sets the keys that are not given{golden}")
    }
}

/// The reason why a machine of many does not draw an input: commands that run many have --set, but neither --adapt nor --engine.
#[must_use]
pub fn reason(error: &anyhow::Error) -> String {
    error.downcast_ref().map_or_else(|| without_engine(&format!("{error:#}")), NotMet::met_by_settings)
}

/// BLEND, and one k_t for a triangle or more; a machine with a screen door mixes by that.
fn blending(frame: &Frame, machine: &Plan, needs: &mut Vec<Need>) {
    let passes = frame.passes();
    let why = passes.iter().find_map(|pass| match pass.state.blend {
        Blending::Off if pass.state.color_write => None,
        Blending::Mix if machine.dither.drops() && pass.state.color_write => None,
        Blending::Off => Some(
            "colour_write 0: a machine without BLEND writes the colour of every fragment that passes"
                .to_owned(),
        ),
        blend => Some(format!("blend {} (transparent surfaces): the machine has no BLEND", blend.name())),
    });
    let Some(why) = why else { return };
    let in_mix = |place: usize| {
        passes.iter().any(|pass| pass.state.blend == Blending::Mix && pass.primitives.contains(&place))
    };
    // Beside polygons and lines a triangle's place among the primitives is another one.
    let mixed = |place: usize| frame.drawn() > frame.triangles.len() || in_mix(place);
    let uneven = |(place, Triangle(v)): (usize, &Triangle)| {
        let corner = (1..3).find(|corner| v[*corner].kt != v[0].kt).filter(|_| mixed(place))?;
        let corner_of = named("triangle", place, Some(("vertex", corner)));
        Some(format!("{corner_of}: kt = {} after {}", v[corner].kt, v[0].kt))
    };
    let of_polygons = || {
        let mut kts = frame.polygons.iter().map(|polygon| polygon.contours.iter().flatten().map(|v| v.kt));
        kts.any(|mut kts| kts.next().is_some_and(|first| kts.any(|kt| kt != first)))
            .then(|| "kt within a polygon".to_owned())
    };
    let of_lines = || {
        let uneven = frame.lines.iter().any(|line| line.ends[0].kt != line.ends[1].kt);
        uneven.then(|| "kt along a line".to_owned())
    };
    let uneven = match frame.mode {
        ShadeMode::Gouraud => {
            frame.triangles.iter().enumerate().find_map(uneven).or_else(of_polygons).or_else(of_lines)
        }
        ShadeMode::Flat => None,
    };
    if !machine.blend.is_there() {
        needs.push(need("blend.kind", if uneven.is_some() { "interpolated" } else { "constant" }, why));
    } else if let Some(what) = uneven.filter(|_| machine.has_triangle_kt()) {
        let why = format!("{what}: blend.kind = constant has one for a triangle");
        needs.push(need("blend.kind", "interpolated", why));
    }
}

/// SHADOW, and PROJECT before it.
fn shadows(first: &Shadow, all: &[Shadow], machine: &Plan, needs: &mut Vec<Need>) {
    let parallel = |shadow: &&Shadow| shadow.matrix[3][..3] == [0.0; 3] && shadow.matrix[3][3] > 0.0;
    let perspective = all.iter().find(|shadow| !parallel(shadow));
    let own = &machine.shadow;
    let light = if perspective.is_some() { "perspective" } else { "parallel" };
    match perspective {
        _ if !own.is_there() => {
            needs.push(need("shadow.light", light, "shadow: the machine has no SHADOW".to_owned()))
        }
        Some(Shadow { matrix: [.., [q0, q1, q2, q3]], .. }) if !own.projects() => {
            let why = format!(
                "shadow: m30 m31 m32 m33 = {q0} {q1} {q2} {q3}: the machine's light is parallel, which has 0 0 0 and more than 0"
            );
            needs.push(need("shadow.light", light, why));
        }
        _ => {}
    }
    let size = first.size;
    if size != own.size
        && KEYS.iter().any(|key| key.name == "shadow.size" && key.parse(&size.to_string()).is_some())
    {
        let why = format!("shadow {size}: the machine's map has {0} x {0} texels", own.size);
        needs.push(need("shadow.size", size, why));
    }
    if let Some(pane) = all.iter().flat_map(|shadow| &shadow.panes).next().filter(|_| !own.transmits()) {
        let why = format!("L with kt = {}: the machine's map says lit or not", pane.kt);
        needs.push(need("shadow.transmits", "yes", why));
        if own.own_pass == OwnPass::Yes
            && !machine.blend.is_there()
            && needs.iter().all(|need| need.key != "blend.kind")
        {
            let why = format!("L with kt = {}: BLEND draws such a map, and the machine has none", pane.kt);
            needs.push(need("blend.kind", "constant", why));
        }
    }
    if let Some(shadow) = all.iter().find(|shadow| shadow.ambient > 0.0 && own.gate == Gate::And) {
        let why = format!("shadow AMBIENT = {}: shadow.gate = and leaves nothing in shadow", shadow.ambient);
        needs.push(need("shadow.gate", "scale", why));
    }
}

/// TERM, SHADE and what stands between them.
fn shaded(frame: &Frame, shading: &PixelShading, machine: &Plan, needs: &mut Vec<Need>) {
    let (own, name) = (&machine.shade, shading.method.name());
    let kind = if own.normalises() { PixelMethod::Phong } else { PixelMethod::FastPhong };
    if !own.is_there() {
        let why = format!("mode {name} (--shading {name}): the machine has no TERM and SHADE");
        needs.push(need("shade.kind", name, why));
    } else if shading.method != kind {
        let why = format!("mode {name} (--shading {name}): the machine's shade.kind is {}", kind.name());
        needs.push(need("shade.kind", name, why));
    }
    let far = |light: &Light| matches!(light, Light::Directional { .. });
    let (sun, point) = (shading.lights.iter().any(far), !shading.lights.iter().all(far));
    // By Phong a machine takes lights far away, or one at a time of those at a point: no key gives both.
    let phong = shading.method == PixelMethod::Phong;
    if phong && own.light == ShadeLight::Positional && sun && !point {
        let why = "a directional light: with shade.light = positional lights stand at a point";
        needs.push(need("shade.light", "directional", why.to_owned()));
    }
    let (given, most) = (shading.lights.len(), own.lights as usize);
    let permitted =
        KEYS.iter().any(|key| key.name == "shade.lights" && key.parse(&given.to_string()).is_some());
    if given > most && permitted && !(phong && point) {
        let why = format!("{given} lights: the machine has terms for {most}");
        needs.push(need("shade.lights", given, why));
    }
    let textured = !shading.textures.is_empty();
    if textured && !own.textures() {
        needs.push(need("texture.kind", "nearest", "texture: the machine has no TEXEL".to_owned()));
    }
    let color = |v: &edgewalk_scene::Vertex| [v.r, v.g, v.b];
    let uneven = frame
        .triangles
        .iter()
        .position(|Triangle(v)| color(&v[1]) != color(&v[0]) || color(&v[2]) != color(&v[0]));
    let uneven = uneven.filter(|_| frame.mode == ShadeMode::Gouraud);
    if own.colour == ShadeColour::Tables
        && let Some(why) = match uneven {
            Some(triangle) => Some(format!(
                "{}: its colour is not the same at all vertices, and the machine's tables hold one",
                named("triangle", triangle, None)
            )),
            None if textured => {
                Some("texture: the machine's tables hold the colour that a texel multiplies".to_owned())
            }
            None => None,
        }
    {
        needs.push(need("shade.colour", "multiply", why));
    }
    if shading.materials.iter().any(|material| material.bump.is_some()) && !own.bumps() {
        needs.push(need("texture.bump", "yes", "relief: the machine has no BUMP".to_owned()));
    }
}
