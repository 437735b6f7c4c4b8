//! `edgewalk judge`: the picture of another rasterizer beside golden's, or beside a machine's.

use crate::document::document;
use crate::input::Source;
use crate::machine_args::MachineArgs;
use crate::number::{real, whole};
use crate::verdict::Verdict;
use crate::{Talk, junit};
use anyhow::{Result, ensure};
use edgewalk_files::{Staging, foreign, picture};
use edgewalk_host::draw;
use edgewalk_host::input::counted;
use edgewalk_judge::outside::picture::Floats;
use edgewalk_judge::outside::{self, Asked, Cause, Judgement, Rule, Tolerance};
use edgewalk_machine::{Fill, Plan};
use edgewalk_model::Waits;
use serde::Serialize;
use std::path::PathBuf;

/// Judge the picture of another rasterizer beside golden's, by frame: final depth and colour, whatever the order of writes.
///
/// PICTURE is a folder with those of coverage.npy, id.npy, z.npy, rgb.npy and lit.npy that there are, as `raster` writes them; or such
/// files by name; or a PNG. Depths and colours are floats in 0 to 1 or unsigned integers in LSB, row 0 on top. With the rule
/// textbook the floats may lie outside of 0 to 1.
/// A pixel is right if its depth and colour are within the tolerance: the proved bound of the machine's formats, unless given. Where
/// no bound is proved, the tolerance is 1 LSB, and the report says why.
#[derive(clap::Args)]
#[command(after_help = "Examples:
  edgewalk judge triangles.tri out/mine                        a folder of arrays
  edgewalk judge triangles.tri z.npy rgb.npy --out out/judged
  edgewalk judge sphere mine.png --set screen.width=320 --set screen.height=240
  edgewalk judge triangles.tri mine.png --rule bottom-left --color-lsb 2
  edgewalk judge triangles.tri out/mine --depth-bits 16        a depth buffer of 16 bits: 1 LSB of it is the tolerance
  edgewalk judge triangles.tri out/mine --against machine      every value equal to the machine's

Exit codes: 0 every pixel within the tolerance, 1 not, 2 bad input or nothing compared.")]
pub struct Args {
    /// A built-in scene, a scene file (.toml), a mesh (.obj, .gltf, .glb), a triangle file (.tri), or - for triangles from the
    /// standard input
    #[arg(value_name = "INPUT")]
    input: String,
    /// Folder of arrays, arrays (.npy), or a picture (.png)
    #[arg(value_name = "PICTURE", required = true)]
    pictures: Vec<PathBuf>,
    /// Shading method of a scene: constant, constant-averaged, gouraud, phong, fast-phong; gouraud if left out
    #[arg(long, value_enum, hide_possible_values = true)]
    shading: Option<crate::input::Shading>,
    /// Set the keys of the machine that the input asks for; what --set says stands
    #[arg(long)]
    adapt: bool,
    /// The picture that is right
    #[arg(long, value_enum, default_value_t = Against::Golden)]
    against: Against,
    /// Rule of coverage [default: that of the machine's edge.fill: top-left or textbook]
    #[arg(long, value_enum)]
    rule: Option<RuleName>,
    /// Bits of a depth of the picture [default: formats.z_bits]
    #[arg(long, value_name = "BITS", value_parser = whole::<u32>(1..=48))]
    depth_bits: Option<u32>,
    /// Bits of a colour of the picture [default: formats.color_bits, with DITHER dither.bits]
    #[arg(long, value_name = "BITS", value_parser = whole::<u32>(1..=48))]
    color_bits: Option<u32>,
    /// Largest permitted error of a depth, LSB [default: the proved bound of the machine; 1 where none is proved, or if
    /// --depth-bits is not formats.z_bits]
    #[arg(long, value_name = "LSB", value_parser = real(0.0..=f64::INFINITY, "LSB"))]
    depth_lsb: Option<f64>,
    /// Largest permitted error of a colour, LSB [default: the proved bound of the machine; 1 where none is proved, or if
    /// --color-bits is not formats.color_bits]
    #[arg(long, value_name = "LSB", value_parser = real(0.0..=f64::INFINITY, "LSB"))]
    color_lsb: Option<f64>,
    /// Output directory for judge.json, judge.xml (JUnit) and differences.png
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// What the picture is judged by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Against {
    /// Golden's picture, within the tolerance
    Golden,
    /// The machine's picture: every value equal
    Machine,
}

/// A rule of coverage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum RuleName {
    /// Centres on left and top edges are inside
    TopLeft,
    /// Centres on right and top edges are inside
    TopRight,
    /// Centres on left and bottom edges are inside
    BottomLeft,
    /// Centres on right and bottom edges are inside
    BottomRight,
    /// Lines and columns from the rounded start to the rounded end, both inside
    Textbook,
}

impl RuleName {
    fn rule(self) -> Rule {
        match self {
            RuleName::TopLeft => Rule::TopLeft,
            RuleName::TopRight => Rule::TopRight,
            RuleName::BottomLeft => Rule::BottomLeft,
            RuleName::BottomRight => Rule::BottomRight,
            RuleName::Textbook => Rule::Textbook,
        }
    }
}

/// What a run may write.
const FILES: [&str; 3] = ["judge.json", "judge.xml", "differences.png"];

/// The report.
#[derive(Serialize)]
struct Report {
    input: String,
    against: String,
    rule: String,
    /// Hash of the machine whose formats and sub-pixels hold.
    machine: String,
    pass: bool,
    wrong: u64,
    #[serde(flatten)]
    judgement: Judgement,
}

/// Runs the command.
pub fn run(args: &Args, machine: &MachineArgs, talk: Talk) -> Result<Verdict> {
    let out = args.out.as_deref().map(Staging::new).transpose()?;
    let mut source = Source::new(&args.input, args.adapt);
    source.shading = args.shading;
    let machine = source.machine(machine)?;
    let frame = source.whole(&machine)?;
    let size = (machine.width, machine.height);
    let bits =
        [args.depth_bits.unwrap_or(machine.z.bits), args.color_bits.unwrap_or(machine.stored_color().bits)];
    let rule = rule(args, &machine)?;
    let range = if rule == Rule::Textbook { Floats::Finite } else { Floats::InUnit };
    let picture = foreign::read(&args.pictures, size, bits, range)?;
    let shaded = frame.shading.is_some() && args.color_lsb.is_none() && picture.rgb.is_some();
    ensure!(
        !shaded || args.against == Against::Machine,
        "{}: the frame is shaded at each pixel, and its colours have no bound that holds for all pixels; give --color-lsb, or \
         --against machine",
        args.input
    );
    let tolerance = Tolerance::of(
        &machine,
        &frame,
        Asked { bits: args.depth_bits, lsb: args.depth_lsb },
        Asked { bits: args.color_bits, lsb: args.color_lsb },
    );
    let judgement = match args.against {
        Against::Golden => outside::beside_golden(&machine, &frame, &picture, &tolerance, rule)?,
        Against::Machine => {
            let drawn = draw::fast(&frame, &machine, Waits::Never)?;
            outside::beside_machine(&machine, &frame, &drawn, &picture, &tolerance)?
        }
    };
    let verdict = judgement.verdict().or_nothing(&args.input, counted(&frame).total() as u64, size)?;
    let report = Report {
        input: args.input.clone(),
        against: format!("{:?}", args.against).to_lowercase(),
        rule: rule.to_string(),
        machine: machine.hash(),
        pass: verdict == Verdict::Pass,
        wrong: judgement.wrong(),
        judgement,
    };
    if let Some(out) = out {
        out.write("judge.json", document("judge", &report)?)?;
        out.write("judge.xml", report.junit())?;
        picture::write(&out, "differences.png", size.0, size.1, &|pixel| color(report.judgement.map[pixel]))?;
        out.publish(&FILES)?;
    }
    talk.say(|| document("judge", &report), || report.text())?;
    Ok(verdict)
}

/// The rule asked for, else the machine's.
fn rule(args: &Args, machine: &Plan) -> Result<Rule> {
    let own = match machine.fill {
        Fill::Exact => Rule::TopLeft,
        Fill::Textbook => Rule::Textbook,
    };
    let rule = args.rule.map_or(own, RuleName::rule);
    ensure!(
        args.against == Against::Golden || rule == own,
        "--rule {rule}: the machine draws by {own}; permitted with --against machine: {own}; or set edge.fill"
    );
    Ok(rule)
}

/// The colour of a pixel in the picture of differences.
fn color(cause: u8) -> [u8; 3] {
    match Cause::ALL.get(usize::from(cause)) {
        None => [0, 0, 0],
        Some(Cause::Missing) => [255, 0, 0],
        Some(Cause::Extra) => [255, 128, 0],
        Some(Cause::Tie | Cause::Piece | Cause::Open) => [0, 0, 160],
        Some(Cause::WrongWinner) => [255, 0, 255],
        Some(Cause::Depth) => [255, 255, 0],
        Some(Cause::Color) => [0, 255, 255],
        Some(Cause::Twice | Cause::LayerMissing) => [0, 200, 0],
        Some(Cause::Light) => [255, 255, 255],
    }
}

impl Report {
    /// A test case for each cause that is wrong.
    fn junit(&self) -> String {
        let cases = self.judgement.causes.iter().filter(|count| count.wrong).map(|count| junit::Case {
            name: count.cause.text().to_owned(),
            failure: (count.pixels > 0)
                .then(|| (format!("{} pixels", count.pixels), self.judgement.lines_of(count.cause))),
        });
        let cases: Vec<junit::Case> = cases.collect();
        junit::document(&format!("edgewalk judge {}", self.input), "edgewalk.judge", &cases)
    }

    fn text(&self) -> String {
        let Report { input, against, rule, machine, pass, .. } = self;
        let verdict = if *pass { "pass" } else { "fail" };
        format!(
            "{input} beside {against}, rule {rule}, machine {machine}: {verdict}\n{}",
            self.judgement.lines()
        )
    }
}
