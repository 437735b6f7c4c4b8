//! `render SCENE --shadows map` on a machine: each light's part by itself beside golden, and all of them as passes of one picture.

use super::Args;
use crate::Talk;
use crate::document::document;
use crate::engine::{Engine, draw, draw_port, draw_waiting};
use crate::input::{Shading, to_port};
use crate::pictures::FILES;
use crate::shadows::Shadows;
use crate::verdict::Verdict;
use anyhow::{Context as _, Result, anyhow};
use edgewalk_files::{Staging, picture};
use edgewalk_host::lights::{are_added, frames, in_passes, sum};
use edgewalk_host::reach::reach;
use edgewalk_judge::compare::compare_for;
use edgewalk_judge::passes::Passes;
use edgewalk_judge::report::Report;
use edgewalk_judge::setup_report::SetupReport;
use edgewalk_machine::Plan;

/// Draws, compares part by part, and writes the picture of all passes beside golden's.
pub fn run(args: &Args, machine: &Plan, talk: Talk) -> Result<Verdict> {
    let source = &args.source;
    if source.is_triangle_file() {
        return Err(anyhow!("--shadows: a triangle file brings its own, the line `shadow`"));
    }
    if args.shadows == Shadows::Ray || source.shading() != Shading::Gouraud {
        return Err(anyhow!(
            "--shadows: the machine has maps under --shading gouraud; draw others with --engine golden"
        ));
    }
    let (scene, surface) = source.surface(machine)?;
    let frames = frames(&scene, &surface, machine).with_context(|| source.input.clone())?;
    let (mut golden, mut drawn, mut parts) = (Vec::new(), Vec::new(), Vec::new());
    for frame in &frames {
        let exact = draw(Engine::Golden, frame, machine, true)?;
        let part = draw_waiting(args.engine, frame, machine, args.stalls, talk.quiet)?;
        let reach = reach(machine, &to_port(frame, machine)?)?;
        parts.push(compare_for(machine, frame, &exact, &part, reach.as_ref()));
        golden.push(exact);
        drawn.push(part);
    }
    let (together, port) = match sum(&drawn).filter(|_| are_added(&frames)) {
        Some(added) => (added, to_port(&frames[0], machine)?),
        None => {
            let port = in_passes(&frames, machine).with_context(|| source.input.clone())?;
            (draw_port(args.engine, &port, machine, args.stalls, talk.quiet)?, port)
        }
    };
    let by_host = are_added(&frames);
    let passes = Passes { by_host, ..Passes::of(parts, machine, (&golden, &drawn), &together) };
    let verdict = passes.verdict();
    let out = Staging::new(&args.out)?;
    let (w, h) = (together.width, together.height);
    if let Some(golden) = sum(&golden) {
        picture::write_rgb(&out, "golden.png", w, h, &golden.rgb)?;
    }
    picture::write_rgb(&out, "image.png", w, h, &together.rgb)?;
    let setup = SetupReport::new(machine, &port.triangles);
    let triangles = surface.triangles.len() as u64;
    let mut report = Report {
        parts: Some(passes),
        setup: Some(setup),
        ..Report::new(&source.input, triangles, machine, &together, args.stalls)
    };
    match by_host {
        true => args.look.refuse()?,
        false => args.look.at_port(&port, machine, args.stalls, &mut report)?,
    }
    report = args.at_clock(report, machine);
    out.write("report.json", document("report", &report)?)?;
    out.write("report.txt", report.text())?;
    out.publish(&FILES)?;
    talk.say(|| document("report", &report), || report.text())?;
    verdict.or_nothing(&source.input, triangles, (w, h))
}
