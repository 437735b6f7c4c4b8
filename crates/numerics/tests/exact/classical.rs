//! The classical machine of A3 at one line: an edge DDA, a pre-step to the first centre, increments by an approximate reciprocal.

use crate::rational::{exact, ratio, rounded};
use edgewalk_numerics::bounds::Prestep;
use edgewalk_numerics::{Dyadic, Rounding, Steps};
use num_rational::BigRational;

/// A value and an edge as they are, signed; the machine has magnitudes only.
#[derive(Clone, Copy)]
pub struct Place {
    /// Value at the first line, LSB.
    pub start: Dyadic,
    /// The edge's x there, px.
    pub edge_start: Dyadic,
    /// LSB/px.
    pub gradient: Dyadic,
    /// LSB/line.
    pub edge_gradient: Dyadic,
    /// px/line.
    pub slope: Dyadic,
    /// Relative error of what comes through the reciprocal.
    pub eta: Dyadic,
}

impl Place {
    /// The value behind `steps`, as the machine has it, minus what is true there; LSB.
    pub fn error(&self, bits: u32, steps: Steps, machine: &Prestep) -> BigRational {
        let nearest = |value: &BigRational, bits| rounded(value, bits, Rounding::NearestHalfUp);
        let [start, edge_start, gradient] = [self.start, self.edge_start, self.gradient].map(exact);
        let [edge_gradient, slope, eta] = [self.edge_gradient, self.slope, self.eta].map(exact);
        let (lines, columns) = (ratio(steps.lines, 1), ratio(steps.columns, 1));
        let off = |value: &BigRational| value * (ratio(1, 1) + &eta);

        let its_x =
            nearest(&edge_start, machine.edge_bits) + nearest(&off(&slope), machine.edge_bits) * &lines;
        let its_value = nearest(&start, bits) + nearest(&off(&edge_gradient), bits) * &lines;
        let its_gradient = nearest(&off(&gradient), bits);
        let center = its_x.ceil();
        let distance = rounded(&(&center - &its_x), machine.distance_bits, Rounding::Floor);
        let sum = its_value + nearest(&(&its_gradient * distance), bits) + &its_gradient * &columns;

        let edge_x = edge_start + slope * &lines;
        let truth = start + edge_gradient * lines + gradient * (center - edge_x + columns);
        sum - truth
    }
}
