//! The interpolator of `docs/machine.md` section 2 (exact fill), in big integers and rationals: every pixel that the
//! half-planes cover, what the machine's additions give there, and what is exact.

use crate::rational::{ratio, round_to_integer};
use edgewalk_numerics::Rounding;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

/// Sub-pixel positions in a pixel, s = 8.
const P: i64 = 256;

/// One channel of an interpolator.
#[derive(Clone, Copy)]
pub struct Interpolator {
    pub fraction_bits: u32,
    pub vertex_bits: u32,
    pub rounding: Rounding,
    pub height: i64,
}

/// x, y in 2^-8 px as at the port, and the value in 2^-e LSB.
pub type Vertex = (i64, i64, i64);

/// The covered columns of a line, and the DDA's state there.
pub struct Line {
    pub line: i64,
    /// Covered columns, first and last.
    pub columns: (i64, i64),
    /// Additions of d0, d1 so far.
    pub down: [i64; 2],
    /// Column of the value on the major edge.
    origin: i64,
    value: BigInt,
}

pub struct Triangle {
    machine: Interpolator,
    vertices: [Vertex; 3],
    area: BigInt,
    plane: [BigInt; 2],
    along_span: BigInt,
    pub lines: Vec<Line>,
}

/// First column or line whose centre lies at or after n/d, d > 0 (in 1/256 px).
fn first_center(n: i128, d: i128) -> i64 {
    let center = -(-n).div_euclid(d * i128::from(P));
    center.try_into().expect("on a screen")
}

/// First column whose centre lies on or right of an edge, on a line that the edge crosses.
fn first_column(a: Vertex, b: Vertex, line: i64) -> i64 {
    let [du, dv, down] = [b.0 - a.0, b.1 - a.1, line * P - a.1].map(i128::from);
    first_center(i128::from(a.0) * dv + du * down, dv)
}

impl Triangle {
    /// Sets up and walks a triangle; `None` if it has no area.
    pub fn new(machine: Interpolator, mut vertices: [Vertex; 3]) -> Option<Triangle> {
        for vertex in &mut vertices {
            *vertex = (vertex.0 - P / 2, vertex.1 - P / 2, vertex.2);
        }
        vertices.sort_by_key(|vertex| vertex.1); // stable
        let [p0, p1, p2] = vertices;
        let big = |n: i64| BigInt::from(n);
        let (du1, dv1, dc1) = (p1.0 - p0.0, p1.1 - p0.1, p1.2 - p0.2);
        let (du2, dv2, dc2) = (p2.0 - p0.0, p2.1 - p0.1, p2.2 - p0.2);
        let signed_area = big(du1) * dv2 - big(du2) * dv1;
        if signed_area.is_zero() {
            return None;
        }
        let left = signed_area.is_negative();
        let sign = if left { -1 } else { 1 };
        let area = signed_area.abs();
        let plane = [(big(dc1) * dv2 - big(dc2) * dv1) * sign, (big(du1) * dc2 - big(du2) * dc1) * sign];
        let scale = big(1) << (machine.fraction_bits - machine.vertex_bits);
        let rounded = |numerator: BigInt| {
            round_to_integer(&BigRational::new(numerator * &scale, area.clone()), machine.rounding)
        };
        let line_of = |v: i64| first_center(v.into(), 1).clamp(0, machine.height);
        let (j0, j1, j2) = (line_of(p0.1), line_of(p1.1), line_of(p2.1));
        let quotient = if dv2 == 0 { BigInt::zero() } else { ratio(du2, dv2).floor().to_integer() };
        let step = |q: BigInt| rounded((&plane[1] + q * &plane[0]) * P);
        let down = [step(quotient.clone()), step(&quotient + 1)];
        let along_span = rounded(&plane[0] * P) * sign;

        let mut triangle = Triangle {
            machine,
            vertices,
            area: area.clone(),
            plane: plane.clone(),
            along_span,
            lines: vec![],
        };
        let mut taken = [0, 0];
        let mut value = BigInt::zero();
        let mut last_column = 0;
        for line in j0..j2 {
            let major = first_column(p0, p2, line);
            let minor = if line < j1 { first_column(p0, p1, line) } else { first_column(p1, p2, line) };
            let origin = if left { major - 1 } else { major };
            if line == j0 {
                let start = (big(origin) * P - p0.0) * &plane[0] + (big(line) * P - p0.1) * &plane[1];
                value = rounded(start) + big(p0.2) * &scale;
            } else {
                let carry = big(major - last_column) - &quotient;
                let carry = usize::try_from(carry).expect("an edge moves by q or q + 1 columns");
                value += &down[carry];
                taken[carry] += 1;
            }
            last_column = major;
            let columns = if left { (minor, origin) } else { (origin, minor - 1) };
            if columns.0 <= columns.1 {
                triangle.lines.push(Line { line, columns, down: taken, origin, value: value.clone() });
            }
        }
        Some(triangle)
    }

    /// n_x of a pixel of `line`.
    pub fn columns_to(&self, line: &Line, column: i64) -> i64 {
        (column - line.origin).abs()
    }

    /// The machine's sum at a pixel, LSB.
    pub fn sum(&self, line: &Line, column: i64) -> BigRational {
        let sum = &line.value + &self.along_span * self.columns_to(line, column);
        BigRational::new(sum, BigInt::from(1) << self.machine.fraction_bits)
    }

    /// The exact value of the plane at a pixel, LSB.
    pub fn exact(&self, line: &Line, column: i64) -> BigRational {
        let (u0, v0, c0) = self.vertices[0];
        let rise = (BigInt::from(column) * P - u0) * &self.plane[0]
            + (BigInt::from(line.line) * P - v0) * &self.plane[1];
        (BigRational::new(rise, self.area.clone()) + ratio(c0, 1))
            / ratio(BigInt::from(1) << self.machine.vertex_bits, 1)
    }
}
