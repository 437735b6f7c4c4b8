//! The classical machine of bound 3 at one line: an edge DDA, a pre-step to the first centre, increments by
//! an approximate reciprocal.

use crate::rational::{exact, power_of_two, ratio, rounded};
use edgewalk_numerics::{Dyadic, Rounding, Steps};
use num_rational::BigRational;
use num_traits::Signed;

/// Word lengths of the machine.
#[derive(Clone, Copy, Debug)]
pub struct Prestep {
    /// f: the distance from edge to pixel centre is truncated to f fraction bits (0: no pre-step at all).
    pub distance_bits: u32,
    /// The edge's x is a slope DDA with this many fraction bits, u_x = 2^-bits px (bound 5).
    pub edge_bits: u32,
}

/// A value and an edge.
#[derive(Clone, Copy, Debug)]
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
    /// Bound 3, the magnitude of that error:
    /// `(3+n_y+n_x)·u/2 + |g_x|·(2^-f + (n_y+1)·u_x/2) + η·(n_y·|d_e| + (n_x+1)·|g_x| + n_y·|m|·|g_x|)`.
    pub fn bound(&self, bits: u32, steps: Steps, machine: &Prestep) -> BigRational {
        let [gradient, edge_gradient, slope, eta] =
            [self.gradient, self.edge_gradient, self.slope, self.eta].map(|value| exact(value).abs());
        let [lines, columns] = [steps.lines, steps.columns].map(|n| ratio(n, 1));
        let unit = |bits: u32| ratio(1, 1) / power_of_two(bits);
        let roundings = ratio(steps.total() + 3, 2) * unit(bits);
        let edge = (&lines + ratio(1, 1)) * unit(machine.edge_bits) / ratio(2, 1);
        let distance = &gradient * (unit(machine.distance_bits) + edge);
        let reciprocal =
            &lines * edge_gradient + (columns + ratio(1, 1)) * &gradient + &lines * slope * &gradient;
        roundings + distance + eta * reciprocal
    }
}
