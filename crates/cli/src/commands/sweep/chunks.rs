//! Parts of a sweep for other machines: planned, run apart, put together.
//!
//! ```text
//!  plan ─> sweep.json, slurm.sh, hq.sh ─> run, a part each ─> chunks/I.jsonl ─> merge ─> runs.jsonl and what follows
//! ```
//! No engine of its own: a job array of Slurm or HyperQueue says which part.

use super::{DEFINITION, ROWS, RunArgs, finished, kept, points};
use crate::Talk;
use crate::document::document;
use crate::shell::{quoted, quoted_path};
use crate::verdict::Verdict;
use anyhow::{Context, Result, anyhow};
use edgewalk_explore::sweep::check::check;
use edgewalk_explore::sweep::row::{Status, is_beyond};
use edgewalk_explore::sweep::shared::{geometry_key, pixel_key};
use edgewalk_explore::sweep::{Definition, Point, Store, Sweep, store};
use edgewalk_files::Staging;
use edgewalk_scene::InputKind;
use serde_json::json;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where the number of a part is looked for.
const VARIABLES: [&str; 2] = ["SLURM_ARRAY_TASK_ID", "HQ_TASK_ID"];

const SLURM: &str = include_str!("slurm.sh");
const HYPER_QUEUE: &str = include_str!("hq.sh");

fn file(out: &Path, chunk: u32) -> PathBuf {
    out.join("chunks").join(format!("{chunk}.jsonl"))
}

/// Writes the definition and the job scripts.
pub fn plan(definition: &Definition, out: &Path, talk: Talk) -> Result<Verdict> {
    if definition.inputs.iter().any(|input| input == InputKind::STANDARD_INPUT) {
        return Err(anyhow!(
            "-: the parts of a sweep cannot read standard input; permitted: scenes and files; write it to a file and name that"
        ));
    }
    let sweep = super::opened(definition.clone())?;
    let chunks = definition.chunks.unwrap_or(1);
    let program = std::env::current_exe().context("this program")?;
    let shown = quoted_path(out);
    let fill = |template: &str| {
        template
            .replace("@CHUNKS@", &chunks.to_string())
            .replace("@LAST@", &(chunks - 1).to_string())
            .replace("@PROGRAM@", &quoted(&program.display().to_string()))
            .replace("@OUT@", &shown)
    };
    // A sweep that runs in the folder keeps its definition.
    let rows = out.join(ROWS);
    let _held = rows.exists().then(|| Store::open(&rows)).transpose()?;
    let staging = Staging::new(out)?;
    staging.write(DEFINITION, serde_json::to_string_pretty(definition)? + "\n")?;
    staging.write("slurm.sh", fill(SLURM))?;
    staging.write("hq.sh", fill(HYPER_QUEUE))?;
    staging.publish(&[DEFINITION, "slurm.sh", "hq.sh"])?;
    let sizes: Vec<usize> = (0..chunks).map(|chunk| part(&sweep, chunks, chunk).len()).collect();
    talk.say(
        || document("sweep-chunks", json!({ "points": sweep.points.len(), "chunks": sizes })),
        || {
            format!(
                "{} points in {chunks} parts\n    sbatch {}\n    sh {}\n    edgewalk sweep merge --out {shown}\n",
                sweep.points.len(),
                quoted_path(&out.join("slurm.sh")),
                quoted_path(&out.join("hq.sh"))
            )
        },
    )?;
    Ok(Verdict::Pass)
}

/// The points of a part: neighbours share their pixels, so those of the same pixels stay together as far as may be.
fn part(sweep: &Sweep, chunks: u32, chunk: u32) -> Vec<&Point> {
    let mut points: Vec<&Point> = sweep.points.iter().collect();
    points.sort_by_cached_key(|point| {
        (point.input, point.way, geometry_key(&point.machine), pixel_key(&point.machine))
    });
    let bound = |chunk: u32| points.len() * chunk as usize / chunks as usize;
    points[bound(chunk)..bound(chunk + 1)].to_vec()
}

/// Runs a part into a file of its own.
pub fn run(args: &RunArgs, talk: Talk) -> Result<Verdict> {
    let sweep = kept(&args.out)?;
    let chunks = sweep.definition.chunks.ok_or_else(|| {
        anyhow!("{}: the sweep has no parts; plan it with --chunks N", args.out.join(DEFINITION).display())
    })?;
    let chunk = chunk(args.chunk)?;
    if chunk >= chunks {
        return Err(anyhow!("--chunk {chunk}: permitted: 0 to {}", chunks - 1));
    }
    let path = file(&args.out, chunk);
    let folder = args.out.join("chunks");
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    let (store, rows) = Store::open(&path)?;
    let again: Vec<Status> = args.retry.iter().map(|retry| Status::from(*retry)).collect();
    let of = part(&sweep, chunks, chunk);
    let made = points(&sweep, &of, (&store, store::by_key(rows)), &again, &args.tools, talk)?;
    let rows = store::by_key(store::read(&path)?);
    let faults = of.iter().filter(|point| rows.get(&point.key).is_some_and(is_beyond)).count();
    talk.say(
        || {
            let report = json!({ "chunk": chunk, "points": of.len(), "made": made, "faults": faults });
            document("sweep-chunk", report)
        },
        || format!("part {chunk} of {chunks}: {} points, {} of them were there", of.len(), of.len() - made),
    )?;
    Ok(if faults > 0 { Verdict::Mismatch } else { Verdict::Pass })
}

/// Which part, by the command line or the job that it runs in.
fn chunk(asked: Option<u32>) -> Result<u32> {
    if let Some(chunk) = asked {
        return Ok(chunk);
    }
    let set = VARIABLES.iter().find_map(|name| Some((name, std::env::var(name).ok()?)));
    let (name, text) = set.ok_or_else(|| {
        anyhow!("--chunk: no part is given; add --chunk N, or set {} or {}", VARIABLES[0], VARIABLES[1])
    })?;
    text.parse().map_err(|_| {
        anyhow!("{name}={text}: is no number of a part; set it to a whole number from 0, or unset it")
    })
}

/// Puts the rows of all parts together, in the order of the points; rows of other sweeps in the file follow. Where a part is
/// not there yet, nothing is written.
pub fn merge(out: &Path, talk: Talk) -> Result<Verdict> {
    let sweep = kept(out)?;
    let (_held, _) = Store::open(&out.join(ROWS))?;
    let parts = (0..sweep.definition.chunks.unwrap_or(0)).map(|chunk| file(out, chunk));
    let mut rows: BTreeMap<String, String> = BTreeMap::new();
    for path in [out.join(ROWS)].into_iter().chain(parts) {
        check(&sweep, &store::by_key(store::read(&path)?))
            .map_err(|why| anyhow!("{}: {why}", path.display()))?;
        rows.extend(store::lines(&path)?);
    }
    let own: Vec<String> = sweep.points.iter().filter_map(|point| rows.remove(&point.key)).collect();
    let missing = sweep.points.len() - own.len();
    if missing > 0 {
        return Err(anyhow!(
            "{missing} of {} points have no row yet; run their parts, then merge again",
            sweep.points.len()
        ));
    }
    let staging = Staging::new(out)?;
    staging.write(ROWS, own.iter().chain(rows.values()).map(|row| format!("{row}\n")).collect::<String>())?;
    staging.publish(&[ROWS])?;
    finished(&sweep, out, 0, talk)
}
