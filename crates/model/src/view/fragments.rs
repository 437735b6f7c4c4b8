//! A fragment as a token: its pixel and what every channel has there. The same token goes through the queues to the write.

use super::{Field, Shape, output};
use edgewalk_machine::Plan;

/// Its fields.
pub(crate) fn fields(plan: &Plan) -> Vec<Field> {
    let w = plan.widths();
    let pixel = Field { name: "addr", shape: Shape::Pixel { x_bits: w.x, bits: w.address }, brief: true };
    let channels = plan.channels().iter().enumerate().map(|(place, channel)| Field {
        name: channel.name,
        shape: output(channel),
        brief: place == 0,
    });
    std::iter::once(pixel).chain(channels).collect()
}

/// The values of one.
pub(crate) fn values<const C: usize>(plan: &Plan, addr: u32, outputs: &[u32; C]) -> Vec<u64> {
    let outputs = outputs[..plan.channels().len()].iter().map(|value| u64::from(*value));
    std::iter::once(u64::from(addr)).chain(outputs).collect()
}
