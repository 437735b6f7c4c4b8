//! Fast Phong shading on the command line: its options, its picture, and how far it is from Phong shading.

use crate::number::whole;
use anyhow::{Result, anyhow};
use edgewalk_golden::ShadingError;
use edgewalk_golden::fast_phong::{Directional, FastShaded, Fit, PowerTable, Settings, shade};
use edgewalk_machine::{Fill, Plan};
use edgewalk_numerics::normal_cone::{normal_spread, six_point_error, taylor_error};
use edgewalk_scene::{Scene, Surface};
use serde::Serialize;
use std::fmt::Write as _;

/// Options of --shading fast-phong.
#[derive(clap::Args, Clone, Debug)]
pub struct FastPhongArgs {
    /// Fit of the quadratics of fast-phong [default: taylor]
    #[arg(long, value_enum)]
    fit: Option<FitName>,
    /// Entries of the table of powers of fast-phong, 2 to 1048576 [default: 4096]
    #[arg(long, value_name = "ENTRIES", value_parser = whole::<u32>(2..=1 << 20))]
    table: Option<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
enum FitName {
    /// The Taylor series about the centroid
    Taylor,
    /// Through the values at vertices and edge midpoints
    SixPoint,
}

impl FitName {
    fn name(self) -> &'static str {
        match self {
            Self::Taylor => "taylor",
            Self::SixPoint => "six-point",
        }
    }
}

impl FastPhongArgs {
    /// Checks that no option is given where another shading has no use for it.
    ///
    /// # Errors
    /// One is.
    pub fn unused(&self) -> Result<()> {
        match (self.fit, self.table) {
            (None, None) => Ok(()),
            (Some(_), _) => Err(anyhow!(
                "--fit: permitted with --shading fast-phong only; leave it out, or add --shading fast-phong"
            )),
            (None, Some(_)) => Err(anyhow!(
                "--table: permitted with --shading fast-phong only; leave it out, or add --shading fast-phong"
            )),
        }
    }

    /// Draws the scene.
    ///
    /// # Errors
    /// The machine's fill is not the exact one, or a light is not directional.
    pub fn draw(&self, scene: &Scene, surface: &Surface, machine: &Plan) -> Result<FastShaded> {
        if machine.fill != Fill::Exact {
            return Err(anyhow!(
                "--shading fast-phong: edge.fill = textbook starts spans between pixels; use exact"
            ));
        }
        let lights = Directional::all(&scene.lights).map_err(|place| {
            anyhow!(
                "--shading fast-phong: light {} of the scene is not directional, and only directional light comes from \
                 the same side at every pixel; use --shading phong",
                place + 1
            )
        })?;
        let fit = match self.fit() {
            FitName::Taylor => Fit::Taylor,
            FitName::SixPoint => Fit::SixPoint,
        };
        let settings =
            Settings { fit, table_size: self.table() as usize, subpixel_bits: machine.subpixel_bits };
        Ok(shade(scene, surface, &lights, settings))
    }

    fn fit(&self) -> FitName {
        self.fit.unwrap_or(FitName::Taylor)
    }

    fn table(&self) -> u32 {
        self.table.unwrap_or(4096)
    }
}

/// What fast Phong costs in accuracy.
#[derive(Debug, Serialize)]
pub struct FastPhongReport {
    fit: FitName,
    table_entries: u32,
    /// Form of the highlights in the table; Phong shading beside it has the same.
    table_form: &'static str,
    /// From Phong shading, LSB of 8 bits.
    largest_error_from_phong: f64,
    /// LSB of 8 bits.
    mean_error_from_phong: f64,
    /// Largest rho of a triangle that is seen.
    largest_rho: f64,
    /// The bound of a cosine there (bound 10), LSB of 8 bits; none from rho = 1 on.
    cosine_bound_lsb: Option<f64>,
}

impl FastPhongReport {
    /// Of a picture of `surface`, so far from Phong shading.
    pub fn new(
        args: &FastPhongArgs,
        scene: &Scene,
        surface: &Surface,
        drawn: &FastShaded,
        from_phong: &ShadingError,
    ) -> Self {
        let seen = drawn.shaded.picture.id.iter().filter_map(|id| usize::try_from(*id).ok());
        let spread =
            |id: usize| normal_spread(&surface.triangles[id].vertices.map(|vertex| vertex.normal.to_array()));
        let largest_rho = seen.map(spread).fold(0.0, f64::max);
        let bound = match args.fit() {
            FitName::Taylor => taylor_error(largest_rho),
            FitName::SixPoint => six_point_error(largest_rho),
        };
        Self {
            fit: args.fit(),
            table_entries: args.table(),
            table_form: PowerTable::tabulated(scene.specular).name(),
            largest_error_from_phong: from_phong.max,
            mean_error_from_phong: from_phong.mean,
            largest_rho,
            cosine_bound_lsb: bound.is_finite().then_some(255.0 * bound),
        }
    }

    /// As lines of text.
    pub fn text(&self) -> String {
        let mut t = String::new();
        let _ = writeln!(
            t,
            "fit {}, table of {} entries, highlights {}",
            self.fit.name(),
            self.table_entries,
            self.table_form
        );
        let _ = writeln!(
            t,
            "from Phong shading: largest {:.4}, mean {:.4} LSB of 8 bits",
            self.largest_error_from_phong, self.mean_error_from_phong
        );
        let bound =
            self.cosine_bound_lsb.map_or_else(|| "none".to_owned(), |bound| format!("{bound:.4} LSB"));
        let _ = writeln!(t, "largest rho {:.4}: bound 10 of a cosine {bound}", self.largest_rho);
        t
    }
}
