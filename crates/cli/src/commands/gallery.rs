//! `edgewalk gallery`: a page of exhibits, each a system or a fault with pictures, cause and figures.

use crate::Talk;
use crate::document::document;
use crate::progress::bar;
use crate::verdict::Verdict;
use anyhow::{Result, anyhow};
use edgewalk_files::{Staging, picture};
use edgewalk_gallery::{EXHIBITS, Exhibit, Image, Maker, View};
use edgewalk_machine::Unknown;
use edgewalk_replay::lesson::markdown::wrapped;
use rayon::prelude::*;
use serde_json::json;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// Draw the gallery: strengths and faults of each shading system of the sources, with pictures and measured
/// figures.
///
/// Each exhibit has its own machine: --machine and --set are refused.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk gallery
  edgewalk gallery mach-bands perspective --out out/two
  edgewalk gallery --json")]
pub struct Args {
    /// Names of exhibits; all of them if none is given
    names: Vec<String>,
    /// Output directory
    #[arg(long, value_name = "DIR", default_value = "out/gallery")]
    out: PathBuf,
}

/// Pictures side by side on the page, each with its caption under it.
const ABREAST: usize = 3;

/// Runs the command.
pub fn run(args: &Args, talk: Talk) -> Result<Verdict> {
    let chosen = chosen(&args.names)?;
    let bar = bar(chosen.len() as u64, "exhibits", talk.quiet);
    let exhibits = chosen
        .par_iter()
        .map(|make| {
            let exhibit = make();
            bar.inc(1);
            exhibit
        })
        .collect::<Result<Vec<Exhibit>, _>>()?;
    bar.finish_and_clear();
    let out = Staging::new(&args.out)?;
    for exhibit in &exhibits {
        for view in &exhibit.views {
            let name = file_name(exhibit.name, view.name, &view.image);
            match &view.image {
                Image::Colors { width, height, rgb } => {
                    picture::write_rgb(&out, &name, *width, *height, rgb)?
                }
                Image::Drawing(svg) => out.write(&name, svg)?,
                Image::Text(_) => {} // stands on the page
            }
        }
    }
    out.write("README.md", page(&exhibits))?;
    out.publish(&own(&args.out))?;
    report(&exhibits, talk)?;
    Ok(Verdict::Pass)
}

fn chosen(names: &[String]) -> Result<Vec<Maker>> {
    if names.is_empty() {
        return Ok(EXHIBITS.iter().map(|(_, make)| *make).collect());
    }
    let find = |name: &String| match EXHIBITS.iter().find(|(known, _)| known == name) {
        Some((_, make)) => Ok(*make),
        None => Err(anyhow!("gallery: {}", Unknown::new("exhibit", name, EXHIBITS.map(|(name, _)| name)))),
    };
    names.iter().map(find).collect()
}

fn file_name(exhibit: &str, view: &str, image: &Image) -> String {
    let end = if matches!(image, Image::Colors { .. }) { "png" } else { "svg" };
    format!("{exhibit}-{view}.{end}")
}

/// The pictures of the page that is there, if it shows exhibits: they are replaced with it.
fn own(out: &Path) -> Vec<String> {
    let page = std::fs::read_to_string(out.join("README.md")).unwrap_or_default();
    // ![caption](name "caption")
    let shown = page.split("](").skip(1).filter_map(|rest| rest.split([' ', ')']).next());
    let of_exhibit = |name: &&str| {
        let is_picture = name.ends_with(".png") || name.ends_with(".svg");
        is_picture
            && !name.contains('/')
            && EXHIBITS.iter().any(|(exhibit, _)| name.starts_with(&format!("{exhibit}-")))
    };
    shown.filter(of_exhibit).map(str::to_owned).collect()
}

/// The page, in Markdown.
fn page(exhibits: &[Exhibit]) -> String {
    let mut page = "# Gallery\n\nWhat the shading systems of the sources do well and badly, measured.\nWritten by `edgewalk gallery`; scenes \
                    are in [docs/scenes](../scenes).\n"
        .to_owned();
    for exhibit in exhibits {
        // Writing to a string cannot fail.
        _ = write!(
            page,
            "\n## {}\n\n{}\n\n| measured | |\n|---|---|\n",
            exhibit.title,
            wrapped(exhibit.cause)
        );
        for (quantity, value) in &exhibit.figures {
            _ = writeln!(page, "| {quantity} | {value} |");
        }
        let is_text = |view: &&View| matches!(view.image, Image::Text(_));
        let pictures: Vec<&View> = exhibit.views.iter().filter(|view| !is_text(view)).collect();
        for row in pictures.chunks(ABREAST) {
            let cells = |cell: &dyn Fn(&View) -> String| {
                row.iter().map(|view| cell(view)).collect::<Vec<_>>().join(" | ")
            };
            let picture = |view: &View| {
                format!("![{}]({})", view.caption, file_name(exhibit.name, view.name, &view.image))
            };
            _ = writeln!(page, "\n| {} |", cells(&picture));
            _ = writeln!(page, "|{}", "---|".repeat(row.len()));
            _ = writeln!(page, "| {} |", cells(&|view| view.caption.clone()));
        }
        for view in &exhibit.views {
            if let Image::Text(text) = &view.image {
                _ = writeln!(page, "\n{}\n```\n{}\n```", view.caption, text.trim());
            }
        }
    }
    page
}

fn report(exhibits: &[Exhibit], talk: Talk) -> Result<()> {
    let json = || {
        let one = |exhibit: &Exhibit| {
            let figures =
                exhibit.figures.iter().map(|(quantity, value)| (quantity.clone(), value.clone().into()));
            let figures: serde_json::Map<String, serde_json::Value> = figures.collect();
            json!({ "name": exhibit.name, "title": exhibit.title, "figures": figures })
        };
        document("gallery", json!({ "exhibits": exhibits.iter().map(one).collect::<Vec<_>>() }))
    };
    let text = || {
        let mut text = String::new();
        for exhibit in exhibits {
            // Writing to a string cannot fail.
            _ = writeln!(text, "{}", exhibit.title);
            for (quantity, value) in &exhibit.figures {
                _ = writeln!(text, "  {value:>10}  {quantity}");
            }
        }
        text
    };
    talk.say(json, text)
}
