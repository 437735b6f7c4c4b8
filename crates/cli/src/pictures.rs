//! A frame by an engine beside golden's picture: the files of both, the report and the verdict.

use crate::engine::{Engine, Raster, draw_port};
use crate::input::to_port;
use crate::lamps::{Added, added};
use crate::verdict::Verdict;
use anyhow::{Context as _, Result};
use edgewalk_files::{Png, Staging};
use edgewalk_host::draw;
use edgewalk_host::reach::reach;
use edgewalk_host::shade::apart;
use edgewalk_judge::beside::{Beside, Golden, Proved, Subject};
use edgewalk_judge::compare::Comparison;
use edgewalk_judge::report::Report;
use edgewalk_judge::setup_report::SetupReport;
use edgewalk_machine::Plan;
use edgewalk_model::Waits;
use edgewalk_scene::Frame;

/// What a run may write.
pub const FILES: [&str; 10] = [
    "image.png",
    "golden.png",
    "z_error.png",
    "color_error.png",
    "truth.png",
    "shading_error.png",
    "phong.png",
    "phong_error.png",
    "report.json",
    "report.txt",
];

/// Draws, compares, and writes golden.png, the engine's picture and the two heat maps; gives the report on what was found, and the
/// verdict. `see` is shown the engine's picture, from the top and some lines at a time.
pub fn pictures(
    name: &str,
    frame: &Frame,
    machine: &Plan,
    (engine, waits): (Engine, Waits),
    out: &Staging,
    quiet: bool,
    mut see: impl FnMut(&Raster),
) -> Result<(Report, Verdict)> {
    let (w, h) = (machine.width, machine.height);
    let png = |name| Png::create(out, name, w, h);
    let (mut golden, mut image) = (png("golden.png")?, png("image.png")?);
    let (mut z_error, mut color_error) = (png("z_error.png")?, png("color_error.png")?);
    let show = |beside: &Beside| -> Result<()> {
        golden.extend_rgb(&beside.golden.rgb)?;
        image.extend_rgb(&beside.drawn.rgb)?;
        z_error.extend_heat(beside.z_error, 1.0)?;
        color_error.extend_heat(beside.color_error, 1.0)?;
        see(beside.drawn);
        Ok(())
    };
    let apart = apart(frame, machine).with_context(|| name.to_owned())?;
    let summed = apart.map(|parts| added(&parts, machine, (engine, waits), quiet)).transpose()?;
    let (port, mut drawn, proof, lights) = match summed {
        Some(Added { drawn, port, proof, lights }) => (port, Some(drawn), proof, lights),
        None => {
            let port = to_port(frame, machine).with_context(|| name.to_owned())?;
            let proof = port.shade.as_ref().map(|feed| feed.proof.clone());
            (port, None, proof, Vec::new())
        }
    };
    let reach = reach(machine, &port)?;
    let proved = Proved { reach: reach.as_ref(), shading: proof.as_ref() };
    let pass = |lines: u32, take: &mut dyn FnMut(Raster) -> Result<()>| match (drawn.take(), engine) {
        (Some(drawn), _) => take(drawn),
        (None, Engine::Fast) => draw::in_bands(machine, &port, waits, lines, take),
        (None, Engine::Golden) => take(draw::golden(frame, machine)),
        (None, Engine::Scanline) => take(draw::scan_lines(frame, machine)?),
        (None, engine) => take(draw_port(engine, &port, machine, waits, quiet)?),
    };
    let of_golden = Golden::of(frame, machine);
    let report = Subject { name, machine, frame, golden: &of_golden, proved, waits }.report(pass, show)?;
    for picture in [golden, image, z_error, color_error] {
        picture.finish()?;
    }
    let verdicts = report.comparison.iter().chain(&lights).map(Comparison::verdict);
    let verdict = verdicts.fold(Verdict::Pass, Verdict::and);
    let setup = SetupReport::new(machine, &port.triangles);
    let report = Report { lights, setup: Some(setup), ..report };
    Ok((report, verdict))
}
