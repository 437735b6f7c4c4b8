//! What EDGE holds for PIXEL and TERM: words of the channels, k_t and the record.

use crate::channel::Channel;
use crate::field::Field;
use crate::plan::Plan;

/// k_t, one bit more than below 1.
pub(super) fn kt(plan: &Plan) -> Field {
    Field::count("kt", plan.blend.kt_bits + 1, format!("kt, 2^{} for 1.0", plan.blend.kt_bits))
}

/// The k_t of the triangle, if it has one.
pub(super) fn triangle_kt(plan: &Plan) -> Option<Field> {
    plan.has_triangle_kt().then(|| kt(plan))
}

/// The number of the triangle's record, if the machine has TERM.
#[must_use]
pub fn record(plan: &Plan) -> Option<Field> {
    let bits = plan.shade.record_bits;
    plan.shade.is_there().then(|| Field::count("record", bits, "record with the triangle's terms"))
}

/// The interpolated words, a field a channel; `doc` says of what it is called what this word is.
pub(super) fn words(plan: &Plan, doc: impl Fn(&str) -> String) -> Vec<Field> {
    let word = |channel: &Channel| Field::word(channel.name, channel, doc(&channel.what()));
    plan.channels().iter().map(word).collect()
}

/// What EDGE holds for PIXEL: the increments, and k_t of the triangle.
fn increments(plan: &Plan) -> impl Iterator<Item = Field> {
    let words = words(plan, |what| format!("increment of {what} a pixel along the span"));
    words.into_iter().chain(triangle_kt(plan))
}

/// The same at PIXEL.
#[must_use]
pub fn held(plan: &Plan) -> Vec<Field> {
    increments(plan).map(|field| adding(field, "counts with span_fresh")).collect()
}

/// The record at TERM.
#[must_use]
pub fn held_record(plan: &Plan) -> Vec<Field> {
    record(plan).map(|field| adding(field, "counts with span_fresh")).into_iter().collect()
}

/// What EDGE holds: that, and the triangle's record for TERM.
#[must_use]
pub fn held_by_edge(plan: &Plan) -> Vec<Field> {
    let stays = match (plan.polygon.is_there(), plan.polygon.is_bilinear()) {
        (false, _) => "stays until the next prim fires",
        (true, false) => "stays until the next prim with prim_ends fires",
        (true, true) => "counts with line_valid",
    };
    increments(plan).chain(record(plan)).map(|field| adding(field, stays)).collect()
}

fn adding(field: Field, more: &str) -> Field {
    Field { doc: format!("{}; {more}", field.doc), ..field }
}
