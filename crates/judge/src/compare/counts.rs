//! Pixels that were compared, and those that are wrong whatever their values.

use edgewalk_host::raster::Cycles;
use edgewalk_machine::{EdgeKind, Plan};
use serde::Serialize;

/// What was counted.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Counts {
    /// Pixels whose coverage was compared.
    pub pixels: u64,
    /// Pixels of the machine's screen.
    pub screen: u64,
    /// Pixels where another number of triangles covers.
    pub coverage_mismatches: u64,
    /// Pixels that golden covers.
    pub covered: u64,
    /// Covered pixels whose triangle, number of writes, depth, colour and values of the user's own were compared.
    pub compared: u64,
    /// Pixels that show another triangle, or were written another number of times, as two depths there are too near for the
    /// bound to tell their order (bound 7).
    pub order_undecided: u64,
    /// Pixels where no such order explains it.
    pub order_wrong: u64,
    /// Pixels that show no triangle, and not the cleared depth, colour and values of the user's own either.
    pub background_wrong: u64,
    /// Pixels of which a value left its range and wrapped.
    pub wrapped: u64,
    /// With DITHER: colours that its pattern makes of none within the bound; of pictures without a light's map and without shading at each
    /// pixel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub off_pattern: Option<u64>,
    /// Cycles of the machine without a cause, or with two.
    pub cycles_unexplained: u64,
    /// Fraction bits of the machine's edges, if these are slopes, which err (bound 5).
    #[serde(skip)]
    pub(super) slope_bits: Option<u32>,
}

impl Counts {
    /// Nothing compared yet of a picture that took the machine so many cycles.
    pub(super) fn new(machine: &Plan, cycles: Option<&Cycles>) -> Self {
        Counts {
            pixels: 0,
            screen: u64::from(machine.width) * u64::from(machine.height),
            coverage_mismatches: 0,
            covered: 0,
            compared: 0,
            order_undecided: 0,
            order_wrong: 0,
            background_wrong: 0,
            wrapped: 0,
            off_pattern: None,
            cycles_unexplained: cycles.map_or(0, |cycles| cycles.unexplained()),
            slope_bits: (machine.edge_kind == EdgeKind::Slope).then_some(machine.edge_fraction),
        }
    }

    /// Compares the coverage of the next pixel.
    pub(super) fn covers(&mut self, golden: u32, drawn: u32) {
        self.pixels += 1;
        self.coverage_mismatches += u64::from(golden != drawn);
    }

    /// Pixels and cycles that are wrong.
    pub(super) fn wrong(&self) -> u64 {
        self.coverage_mismatches
            + self.order_wrong
            + self.background_wrong
            + self.wrapped
            + self.off_pattern.unwrap_or(0)
            + self.cycles_unexplained
    }

    pub(super) fn lines_of_coverage(&self) -> String {
        let Counts { compared, covered, coverage_mismatches, pixels, slope_bits, .. } = self;
        let slopes = slope_bits.filter(|_| *coverage_mismatches > 0).map_or_else(String::new, |bits| {
            format!(
                "slope edges of {bits} fraction bits err by at most 1/{} px a line: a centre within that may mismatch; \
                 edges of edge.kind = exact do not err\n",
                1u64 << (bits + 1)
            )
        });
        format!(
            "compared {compared} / {covered} covered pixels\n\
             coverage mismatches {coverage_mismatches} / {pixels}\n{slopes}"
        )
    }

    pub(super) fn lines_of_order(&self) -> String {
        let Counts { wrapped, order_undecided, order_wrong, background_wrong, .. } = self;
        let pattern = self
            .off_pattern
            .map_or_else(String::new, |off| format!("colours off the pattern of DITHER {off}\n"));
        format!(
            "{pattern}pixels with a value that wrapped {wrapped}\n\
             triangle or writes differ: {order_undecided} within the bound of depth order, {order_wrong} wrong; background wrong {background_wrong}\n"
        )
    }
}
