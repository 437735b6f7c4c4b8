//! Numbers out of the buffers of a glTF file, with every range checked.

use glam::DVec3;
use gltf::Accessor;
use gltf::accessor::{DataType, Dimensions};
use gltf::buffer::Data;

/// What an accessor is instead of what it should be.
pub(super) struct Refusal {
    pub value: String,
    pub permitted: &'static str,
}

/// Three f32 for each vertex.
pub(super) fn positions(accessor: &Accessor, buffers: &[Data]) -> Result<Vec<DVec3>, Refusal> {
    let kind = (accessor.dimensions(), accessor.data_type());
    if kind != (Dimensions::Vec3, DataType::F32) {
        return Err(Refusal { value: format!("{kind:?}"), permitted: "permitted: POSITION as three f32" });
    }
    let axis = |item: &[u8], k: usize| {
        f64::from(f32::from_le_bytes([item[k], item[k + 1], item[k + 2], item[k + 3]]))
    };
    Ok(items(accessor, buffers)?
        .map(|item| DVec3::new(axis(item, 0), axis(item, 4), axis(item, 8)))
        .collect())
}

/// One unsigned integer for each corner.
pub(super) fn indices(accessor: &Accessor, buffers: &[Data]) -> Result<Vec<u32>, Refusal> {
    let kind = (accessor.dimensions(), accessor.data_type());
    let unsigned = matches!(kind.1, DataType::U8 | DataType::U16 | DataType::U32);
    if kind.0 != Dimensions::Scalar || !unsigned {
        return Err(Refusal { value: format!("{kind:?}"), permitted: "permitted: unsigned integers" });
    }
    let little_endian = |item: &[u8]| item.iter().rev().fold(0, |high, byte| high << 8 | u32::from(*byte));
    Ok(items(accessor, buffers)?.map(little_endian).collect())
}

/// The bytes of each element.
fn items<'a>(accessor: &Accessor, buffers: &'a [Data]) -> Result<impl Iterator<Item = &'a [u8]>, Refusal> {
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
