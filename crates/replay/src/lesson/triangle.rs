//! The triangle of the lesson.

use edgewalk_machine::{Plan, PortVertex, VertexError};

/// Screen of the lesson, pixels.
pub const SCREEN: (u32, u32) = (16, 12);

/// Corners in pixels, depth, red, green and blue from 0 to 1.
const CORNERS: [([f64; 2], [f64; 4]); 3] = [
    ([3.0, 1.5], [0.25, 0.875, 0.625, 0.25]),
    ([13.25, 4.75], [0.625, 0.25, 0.75, 0.5]),
    ([5.5, 10.0], [0.5, 0.375, 0.25, 0.875]),
];

/// The triangle on this machine; channels of the user's own are 0.
///
/// # Errors
/// A machine whose vertices cannot be there.
pub fn triangle(plan: &Plan) -> Result<[PortVertex; 3], VertexError> {
    let mut port = [PortVertex::default(); 3];
    for (slot, ([x, y], values)) in port.iter_mut().zip(CORNERS) {
        let mut values = values.to_vec();
        values.resize(plan.channels().len() + usize::from(plan.has_triangle_kt()), 0.0);
        *slot = plan.port_vertex(x, y, &values)?;
    }
    Ok(port)
}
