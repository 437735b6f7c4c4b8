//! What a relief does to the cosines of a triangle: how they grow with its slopes, and what of that the machine's words hold.
//!
//! ```text
//!  T_u, T_v of the face, N at the vertices ──N x T──> growth of N·L and N·H at the vertices ──planes──> terms
//! ```
//! Slopes are counted in the relief's largest, so each is at most 1.

use super::lights::Lamp;
use super::texels::Relief;
use edgewalk_scene::{PixelMethod, PixelShading, PixelTriangle};
use glam::DVec3;

/// Growth that a word holds.
const MOST_GROWTH: f64 = 1.99;

/// Turn of a normal of length 1 that is let stand in Phong: the turned one is 1.8 long, and made shorter before, so that the one that is
/// not turned stays longer than half.
const MOST_TURN: f64 = 1.5;

/// What is left below 1 for N·N, where NORMAL's table ends.
const BELOW_ONE: f64 = 1.0 / (1 << 14) as f64;

/// The turns of a triangle's normals.
#[derive(Clone, Debug)]
pub struct Turns {
    /// By light and cosine, for the largest slope along u and along v, at the vertices.
    pub growths: Vec<[[f64; 3]; 2]>,
    /// |N x T_u|², 2 (N x T_u)·(N x T_v), |N x T_v|² at the vertices; of Phong.
    pub squares: [[f64; 3]; 3],
    /// What the normals are multiplied with, 1 for fast Phong: it is in `growths` and `squares` already.
    pub scale: f64,
    /// The longest turn, so multiplied.
    pub longest: f64,
    /// How far the planes through the squares may lie above the true ones, all three together.
    pub gap: f64,
    /// How far a stored slope may be from the relief's, of the largest, and the turn from its own for that.
    pub slope_error: f64,
    pub turn_error: f64,
    /// The relief is steeper than the words can say, and lower on the machine.
    pub flattened: bool,
}

impl Turns {
    /// Of a triangle with this relief.
    pub fn of(own: &PixelTriangle, relief: &Relief, shading: &PixelShading, lamps: &[Lamp]) -> Turns {
        let phong = shading.method == PixelMethod::Phong;
        let normals = if phong { own.normals } else { own.normals.map(DVec3::normalize_or_zero) };
        let along = |turns: [DVec3; 2]| turns.map(|turn| normals.map(|normal| normal.cross(turn)));
        let steep = own.turns.map(|turn| turn * relief.one);
        let growths = |along: &[[DVec3; 3]; 2]| {
            let of = |lamp: &Lamp| {
                let directions = own.positions.map(|position| lamp.directions(position, shading));
                [0, 1].map(|cosine| {
                    along.map(|turned| [0, 1, 2].map(|k: usize| turned[k].dot(directions[k][cosine])))
                })
            };
            lamps.iter().flat_map(of).collect::<Vec<[[f64; 3]; 2]>>()
        };
        let most =
            |growths: &[[[f64; 3]; 2]]| growths.iter().flatten().flatten().fold(0f64, |m, g| m.max(g.abs()));
        // |a N x T_u + b N x T_v|² <= (a² + b²) (|N x T_u|² + |N x T_v|²), and the lengths are largest at a vertex.
        let longest = |along: &[[DVec3; 3]; 2]| {
            let [u, v] = along;
            let length = |k: usize| (u[k].length_squared() + v[k].length_squared()).sqrt();
            relief.farthest * (0..3).map(length).fold(0.0, f64::max)
        };
        let full = along(steep);
        let too_steep = most(&growths(&full)) / MOST_GROWTH;
        let too_long = if phong { longest(&full) / MOST_TURN } else { 0.0 };
        let over = too_steep.max(too_long);
        let flattened = over > 1.0;
        let lower = if flattened { 1.0 / over } else { 1.0 };
        let along = along(steep.map(|turn| turn * lower));
        let longest = longest(&along);
        let scale = if phong { ((1.0 - BELOW_ONE) / (1.0 + longest * longest)).sqrt() } else { 1.0 };
        let along = along.map(|turned| turned.map(|turn| turn * scale));
        let [u, v] = &along;
        let at = |square: fn(DVec3, DVec3) -> f64| [0, 1, 2].map(|k: usize| square(u[k], v[k]));
        // A square is a form of N: over the triangle it lies below its plane by sums of the forms of differences of normals.
        let form = |k: usize| {
            let difference = |turned: &[DVec3; 3]| (turned[(k + 1) % 3] - turned[k]).length_squared();
            relief.farthest * relief.farthest * (difference(u) + difference(v))
        };
        let lengths = |k: usize| u[k].length() + v[k].length();
        Turns {
            growths: growths(&along),
            squares: [
                at(|u, _| u.length_squared()),
                at(|u, v| 2.0 * u.dot(v)),
                at(|_, v| v.length_squared()),
            ],
            scale,
            longest: longest * scale,
            gap: (0..3).map(form).fold(0.0, f64::max) / 3.0,
            slope_error: relief.error,
            turn_error: relief.error * (0..3).map(lengths).fold(0.0, f64::max),
            flattened,
        }
    }

    /// How far the growth of a cosine may be from the true one for the stored slopes' sake.
    pub fn growth_error(&self, place: usize) -> f64 {
        let most = |growth: [f64; 3]| growth.into_iter().fold(0f64, |most, g| most.max(g.abs()));
        self.growths[place].into_iter().map(most).sum::<f64>() * self.slope_error
    }

    /// Like `growth_error`, of N·N.
    pub fn square_error(&self) -> f64 {
        self.gap + (2.0 * self.longest + self.turn_error) * self.turn_error
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use edgewalk_machine::{Bump, Machine, Plan, Shade, ShadeColour, ShadeKind, Texture};
    use edgewalk_scene::{Image, Light, Specular, Viewer};
    use glam::DVec2;
    use rand::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    fn machine() -> Plan {
        let shade = Shade {
            kind: ShadeKind::Phong,
            colour: ShadeColour::Multiply,
            texture: Texture::Nearest,
            texture_bits: 3,
            bump: Bump::Yes,
            slope_bits: 6,
            ..Shade::default()
        };
        Machine { shade, ..Machine::default() }.plan().expect("can be built")
    }

    /// Bound 16: planes through the squares lie above the squares by at most the gap, and what a stored slope spoils is within its
    /// error; N·N stays below 1.
    #[test]
    fn the_squares_are_within_their_gap() {
        let mut random = Pcg64Mcg::seed_from_u64(16);
        let heights = (0..64).map(|_| [0; 3].map(|_| random.random())).collect();
        let relief = Image::of(8, 8, heights).expect("64 of them").into();
        let relief = Relief::new(&relief, &machine()).expect("not flat");
        let shading = PixelShading {
            method: PixelMethod::Phong,
            viewer: Viewer::Toward(DVec3::Z),
            ambient: DVec3::ZERO,
            lights: vec![Light::Directional { toward: DVec3::Z, intensity: DVec3::ONE }],
            specular: Specular::Blinn,
            materials: Vec::new(),
            textures: Vec::new(),
            triangles: Vec::new(),
        };
        let lamps = Lamp::all(&shading, &machine()).expect("a directional light");
        let (mut checked, mut of_gap, mut longest) = (0, 0f64, 0f64);
        for _ in 0..400 {
            let cone = random.random::<f64>();
            let mut around = |most: f64| DVec3::from_array([0; 3].map(|_| random.random_range(-most..=most)));
            let normals = [0; 3].map(|_| (DVec3::Z + around(cone)).normalize());
            let turns = [0; 2].map(|_| around(1.0) / relief.one);
            let own = PixelTriangle {
                normals,
                positions: [DVec3::ZERO; 3],
                texture: [DVec2::ZERO; 3],
                turns,
                material: 0,
            };
            let found = Turns::of(&own, &relief, &shading, &lamps);
            if found.flattened {
                continue;
            }
            for _ in 0..200 {
                let mut weights = [0; 3].map(|_| random.random::<f64>());
                let all: f64 = weights.iter().sum();
                weights = weights.map(|weight| weight / all);
                let angle: f64 = random.random_range(0.0..std::f64::consts::TAU);
                let slope = DVec2::from_angle(angle) * relief.farthest;
                if slope.abs().max_element() > 1.0 {
                    continue;
                }
                let normal: DVec3 = (0..3).map(|k| normals[k] * weights[k]).sum::<DVec3>() * found.scale;
                let turned = normal.cross(turns[0] * slope.x + turns[1] * slope.y) * relief.one;
                let plane = |k: usize| (0..3).map(|i| found.squares[k][i] * weights[i]).sum::<f64>();
                let sum = slope.x * slope.x * plane(0)
                    + slope.x * slope.y * plane(1)
                    + slope.y * slope.y * plane(2);
                let above = sum - turned.length_squared();
                assert!(above > -1e-12 && above <= found.gap + 1e-12, "{above} {}", found.gap);
                assert!(turned.length() <= found.longest + 1e-12);
                assert!((normal + turned).length_squared() < 1.0);
                let off = DVec2::from_angle(3.0 * angle) * relief.error;
                let spoilt =
                    normal.cross(turns[0] * (slope.x + off.x) + turns[1] * (slope.y + off.y)) * relief.one;
                let error = (spoilt.length_squared() - turned.length_squared()).abs();
                assert!(error <= found.square_error() - found.gap + 1e-12, "{error}");
                (of_gap, longest) =
                    (of_gap.max(above / found.gap), longest.max(turned.length() / found.longest));
                checked += 1;
            }
        }
        println!("{checked} turns: {of_gap:.3} of a gap, {longest:.3} of the longest turn");
        assert!(checked > 10_000 && of_gap > 0.4 && longest > 0.9, "{checked} {of_gap} {longest}");
    }
}
