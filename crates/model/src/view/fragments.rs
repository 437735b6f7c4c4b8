//! A fragment as a token: its pixel and what every channel has there. The same token goes through the queues to the write;
//! SHADOW makes another of it.

use super::{Field, Shape, output};
use edgewalk_machine::{Channel, Plan};

/// Fields of a fragment.
pub(crate) fn fields(plan: &Plan) -> Vec<Field> {
    std::iter::once(pixel(plan)).chain(plan.channels().iter().enumerate().map(channel)).collect()
}

/// The values of one.
pub(crate) fn values<const C: usize>(plan: &Plan, addr: u32, outputs: &[u32; C]) -> Vec<u64> {
    let outputs = outputs[..plan.channels().len()].iter().map(|value| u64::from(*value));
    std::iter::once(u64::from(addr)).chain(outputs).collect()
}

/// Names of the kind of token that SHADOW takes, and of a table of them.
pub(crate) fn looked_up(plan: &Plan) -> (&'static str, &'static str) {
    if plan.shadow.projects() {
        ("projected", "fragments with their texel and depth")
    } else {
        ("fragment", "fragments")
    }
}

/// Fields of a fragment behind PROJECT: without the weight, and quotients in the place of what is divided.
pub(crate) fn looked_up_fields(plan: &Plan) -> Vec<Field> {
    let (texel, distance) = (plan.shadow.texel_bits(), plan.shadow.distance_bits());
    let field = |(place, own): (usize, &Channel)| match own.name {
        "lx" | "ly" if plan.shadow.projects() => {
            Field { name: own.name, shape: Shape::signed(texel), brief: false }
        }
        "lz" if plan.shadow.projects() => {
            Field { name: own.name, shape: Shape::signed(distance), brief: false }
        }
        _ => channel((place, own)),
    };
    std::iter::once(pixel(plan)).chain(but_weight(plan).map(field)).collect()
}

/// The values of one.
pub(crate) fn looked_up_values<const C: usize>(plan: &Plan, addr: u32, outputs: &[u32; C]) -> Vec<u64> {
    let values = but_weight(plan).map(|(place, _)| u64::from(outputs[place]));
    std::iter::once(u64::from(addr)).chain(values).collect()
}

/// The channels that SHADOW takes.
fn but_weight(plan: &Plan) -> impl Iterator<Item = (usize, &Channel)> {
    plan.channels().iter().enumerate().filter(|(_, channel)| channel.name != "lw")
}

/// Names of the kind of token from DEPTH on, and of a table of them.
pub(crate) fn seen(plan: &Plan) -> (&'static str, &'static str) {
    if plan.dither.rounds() {
        ("dithered", "fragments with the colours that are stored")
    } else if plan.shadow.is_there() {
        ("shaded", "fragments, lit or not")
    } else {
        ("fragment", "fragments")
    }
}

/// Fields of a fragment at DEPTH: with SHADOW without the channels that end there, and with its answer; with DITHER with the colours that are stored.
pub(crate) fn seen_fields(plan: &Plan) -> Vec<Field> {
    let stored = |(place, own): (usize, &Channel)| match own.name {
        "r" | "g" | "b" => channel((place, &Channel { precision: plan.stored_color(), ..*own })),
        _ => channel((place, own)),
    };
    let channels = plan.seen_channels().map(stored);
    let lit = plan.shadow.is_there().then_some(Field { name: "lit", shape: Shape::Flag, brief: true });
    std::iter::once(pixel(plan)).chain(channels).chain(lit).collect()
}

/// The values of one.
pub(crate) fn seen_values<const C: usize>(plan: &Plan, addr: u32, outputs: &[u32; C], lit: bool) -> Vec<u64> {
    let channels = plan.seen_channels().map(|(place, _)| u64::from(outputs[place]));
    let lit = plan.shadow.is_there().then_some(lit.into());
    std::iter::once(u64::from(addr)).chain(channels).chain(lit).collect()
}

fn pixel(plan: &Plan) -> Field {
    let w = plan.widths();
    Field {
        name: "addr",
        shape: Shape::Pixel {
            x_bits: w.x,
            bits: w.address,
            of_map: plan.shadow.draws_map().then(|| plan.shadow.side_bits()),
        },
        brief: true,
    }
}

fn channel((place, channel): (usize, &Channel)) -> Field {
    Field { name: channel.name, shape: output(channel), brief: place == 0 }
}
