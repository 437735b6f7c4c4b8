//! Which operation a lane does when, and for how many clocks.

use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};

/// What a lane does for `1 + steps` clocks: one to load, then `k` bits a clock.
///
/// The products and quotients are those of `docs/machine.md`, section 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Op {
    /// DX / DY of an edge: q and f.
    EdgeStep,
    /// E of an edge, or the area.
    EdgeProduct,
    /// E / DY of an edge: C and R.
    EdgeStart,
    /// Nx of a channel.
    Nx,
    /// gx = Nx·K / |area|.
    Gx,
    /// Ny.
    Ny,
    /// Ny + q·Nx.
    LineProduct,
    /// d0 = (Ny + q·Nx)·K / |area|; d1 follows from it and gx.
    Line,
    /// What lies between vertex 0 and the first pixel.
    StartProduct,
    /// start.
    Start,
    /// DC·h of part 1 (textbook fill).
    ProductA,
    /// startA.
    StartA,
    /// dA = DC·P / DY.
    LineA,
    /// DC·h of part 2.
    ProductB,
    /// startB.
    StartB,
    /// dB.
    LineB,
}

/// What kind of work an operation is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// acc := a·x + b·y.
    Product,
    /// Divides what is in acc.
    Quotient,
    /// Divides a difference: what is at the input y.
    QuotientOfY,
}

impl Op {
    pub fn kind(self) -> Kind {
        use Op::*;
        match self {
            EdgeProduct | Nx | Ny | LineProduct | StartProduct | ProductA | ProductB => Kind::Product,
            EdgeStart | Gx | Line | Start | StartA | StartB => Kind::Quotient,
            EdgeStep | LineA | LineB => Kind::QuotientOfY,
        }
    }

    /// Its name as a part of signals' names.
    pub fn word(self) -> &'static str {
        use Op::*;
        match self {
            EdgeStep => "edge_step",
            EdgeProduct => "edge_product",
            EdgeStart => "edge_start",
            Nx => "nx",
            Gx => "gx",
            Ny => "ny",
            LineProduct => "line_product",
            Line => "line",
            StartProduct => "start_product",
            Start => "start",
            ProductA => "product_a",
            StartA => "start_a",
            LineA => "line_a",
            ProductB => "product_b",
            StartB => "start_b",
            LineB => "line_b",
        }
    }

    /// The operations on each edge, in their order.
    pub fn of_edges() -> &'static [Op] {
        &[Op::EdgeStep, Op::EdgeProduct, Op::EdgeStart]
    }

    /// The operations on each channel, in their order.
    pub fn of_channels(plan: &Plan) -> &'static [Op] {
        use Op::*;
        match plan.fill {
            Fill::Exact => &[Nx, Gx, Ny, LineProduct, Line, StartProduct, Start],
            Fill::Textbook => &[Nx, Gx, ProductA, StartA, LineA, ProductB, StartB, LineB],
        }
    }

    /// Bits of the magnitude of the quotient's numerator, for a channel of `word` bits; `None` for a product.
    fn numerator_bits(self, plan: &Plan, word: u32) -> Option<u32> {
        use Op::*;
        let w = plan.widths();
        let (dw, t) = (w.difference, w.center_fraction);
        match self {
            EdgeStep => Some(dw - 1 + slope_bits(plan)),
            EdgeStart if plan.edge_kind == EdgeKind::Exact => Some(2 * dw - 1 - t),
            EdgeStart => Some(2 * dw - 1 + slope_bits(plan)),
            Gx | StartA | LineA | StartB | LineB => Some(dw + word + t),
            Line => Some(dw + word + plan.guard_bits + 2 + t),
            Start => Some(2 * dw + word),
            EdgeProduct | Nx | Ny | LineProduct | StartProduct | ProductA | ProductB => None,
        }
    }

    /// Binary places that the numerator has below what stands in acc; negative: acc has more, and they are left out.
    fn shift(self, plan: &Plan, channel: Channel) -> i32 {
        use Op::*;
        let t = plan.widths().center_fraction as i32;
        let finer = (channel.fraction - channel.vertex_fraction) as i32;
        match self {
            EdgeStart if plan.edge_kind == EdgeKind::Exact => -t,
            EdgeStep | EdgeStart => slope_bits(plan) as i32,
            Gx | Line | LineA | LineB => t + finer,
            _ => finer,
        }
    }

    /// Clocks after the one that loads: the bits of a factor, or of the longest numerator, k a clock.
    pub fn steps(self, plan: &Plan) -> u32 {
        let bits = self.numerator_bits(plan, longest_word(plan)).unwrap_or(plan.widths().difference);
        bits.div_ceil(plan.bits_per_clock())
    }

    /// The bit of acc that is the first digit of the quotient's numerator.
    pub fn first_digit(self, plan: &Plan, channel: Channel) -> u32 {
        let steps = if self.is_of_edge() { self.steps(plan) } else { self.steps(plan) - late(plan, channel) };
        (steps * plan.bits_per_clock()).saturating_add_signed(-self.shift(plan, channel)) - 1
    }

    /// It is one of the operations on edges.
    pub fn is_of_edge(self) -> bool {
        Op::of_edges().contains(&self)
    }
}

/// Clocks by which the quotients of a channel begin later than those of the longest word.
pub(super) fn late(plan: &Plan, channel: Channel) -> u32 {
    (longest_word(plan) - channel.word()) / plan.bits_per_clock()
}

fn longest_word(plan: &Plan) -> u32 {
    plan.channels().iter().map(|channel| channel.word()).max().unwrap_or(1)
}

/// The jobs of a lane in the operations on edges, one a round: job 0 is the area, jobs 1 to 3 are the edges.
pub(super) fn edge_jobs(plan: &Plan, lane: usize) -> Vec<usize> {
    (lane..EDGE_JOBS).step_by(plan.lanes as usize).collect()
}

/// The jobs of a lane in the operations on channels, one a round: job i is channel i. The last round may have none for it.
pub(super) fn channel_jobs(plan: &Plan, lane: usize) -> Vec<Channel> {
    plan.channels().iter().skip(lane).step_by(plan.lanes as usize).copied().collect()
}

/// Rounds in which the lanes do all jobs on edges, and all on channels.
pub(super) fn rounds(plan: &Plan) -> [usize; 2] {
    [EDGE_JOBS, plan.channels().len()].map(|jobs| jobs.div_ceil(plan.lanes as usize))
}

/// The area and three edges.
const EDGE_JOBS: usize = 4;

/// Fraction bits F of a slope edge; 0 for an exact one.
fn slope_bits(plan: &Plan) -> u32 {
    if plan.edge_kind == EdgeKind::Slope { plan.edge_fraction } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// S1 and S2 as the specification has them, for the default machine: DW = 23, VW = 38, t = 8, G = 13, k = 2.
    #[test]
    fn clocks_of_the_default_machine() {
        let plan = Plan::default();
        let clocks = |ops: &[Op]| ops.iter().map(|op| 1 + op.steps(&plan)).sum::<u32>();
        let (product, step, start) = (1 + 12, 1 + 11, 1 + 19);
        assert_eq!(clocks(Op::of_edges()), step + product + start);
        let (gx, line, start) = (1 + 35, 1 + 42, 1 + 42);
        assert_eq!(clocks(Op::of_channels(&plan)), 4 * product + gx + line + start);
    }
}
