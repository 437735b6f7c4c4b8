//! Numbers out of the buffers of a glTF file, with every range checked.

use glam::{DVec2, DVec3};
use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};

/// What an accessor is instead of what it should be.
pub(super) struct Refusal {
    pub value: String,
    pub permitted: &'static str,
}

/// Three f32 for each vertex: positions and normals.
pub(super) fn vectors(accessor: &Accessor, buffers: &[Vec<u8>]) -> Result<Vec<DVec3>, Refusal> {
    let kind = (accessor.dimensions(), accessor.data_type());
    if kind != (Dimensions::Vec3, DataType::F32) {
        return Err(Refusal { value: format!("{kind:?}"), permitted: "permitted: three f32" });
    }
    let vector = |item: &[u8]| DVec3::new(float(item, 0), float(item, 1), float(item, 2));
    Ok(items(accessor, buffers)?.map(vector).collect())
}

/// Two f32, u8 or u16 for each vertex, the integers in units of their greatest: texture coordinates as the format has
/// them, v down.
pub(super) fn places(accessor: &Accessor, buffers: &[Vec<u8>]) -> Result<Vec<DVec2>, Refusal> {
    let kind = (accessor.dimensions(), accessor.data_type());
    let pair: fn(&[u8]) -> DVec2 = match kind {
        (Dimensions::Vec2, DataType::F32) => |item| DVec2::new(float(item, 0), float(item, 1)),
        (Dimensions::Vec2, DataType::U8) => |item| DVec2::new(item[0].into(), item[1].into()) / 255.0,
        (Dimensions::Vec2, DataType::U16) => |item| {
            let part = |k: usize| f64::from(u16::from_le_bytes([item[2 * k], item[2 * k + 1]]));
            DVec2::new(part(0), part(1)) / 65535.0
        },
        _ => return Err(Refusal { value: format!("{kind:?}"), permitted: "permitted: two f32, u8 or u16" }),
    };
    Ok(items(accessor, buffers)?.map(pair).collect())
}

/// The k-th f32 of an element.
fn float(item: &[u8], k: usize) -> f64 {
    f64::from(f32::from_le_bytes([item[4 * k], item[4 * k + 1], item[4 * k + 2], item[4 * k + 3]]))
}

/// One unsigned integer for each corner.
pub(super) fn indices(accessor: &Accessor, buffers: &[Vec<u8>]) -> Result<Vec<u32>, Refusal> {
    let kind = (accessor.dimensions(), accessor.data_type());
    let unsigned = matches!(kind.1, DataType::U8 | DataType::U16 | DataType::U32);
    if kind.0 != Dimensions::Scalar || !unsigned {
        return Err(Refusal { value: format!("{kind:?}"), permitted: "permitted: unsigned integers" });
    }
    let little_endian = |item: &[u8]| item.iter().rev().fold(0, |high, byte| high << 8 | u32::from(*byte));
    Ok(items(accessor, buffers)?.map(little_endian).collect())
}

/// The bytes of each element.
fn items<'a>(accessor: &Accessor, buffers: &'a [Vec<u8>]) -> Result<impl Iterator<Item = &'a [u8]>, Refusal> {
    let refusal = |value: String, permitted| Refusal { value, permitted };
    let (Some(view), None) = (accessor.view(), accessor.sparse()) else {
        return Err(refusal("sparse".into(), "permitted: an accessor with a buffer view and nothing sparse"));
    };
    let (size, count) = (accessor.size(), accessor.count());
    let stride = view.stride().unwrap_or(size);
    let bytes = view.offset().checked_add(view.length()).and_then(|end| {
        let view_bytes = buffers.get(view.buffer().index())?.get(view.offset()..end)?;
        let last = count.checked_sub(1)?.checked_mul(stride)?;
        view_bytes.get(accessor.offset()..accessor.offset().checked_add(last)?.checked_add(size)?)
    });
    match bytes {
        Some(bytes) => Ok((0..count).map(move |k| &bytes[k * stride..k * stride + size])),
        None => Err(refusal(
            format!("accessor {}: {count} of {size} bytes, {stride} apart", accessor.index()),
            "permitted: at least one element, and all within the buffer view and its buffer",
        )),
    }
}
