//! A number by which a vertex shows the machine it was made for.

use crate::channel::Channel;
use crate::polygon::Polygon;

/// The formats of a vertex port, as a number: vertices of another machine carry another one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct PortStamp(u32);

impl PortStamp {
    /// Stands for the numbers of bits that decide how a vertex is read (FNV-1a over them); `kt`: those of a
    /// triangle's own k_t, 0 if it has none; `polygon`: lines and polygons that the port takes.
    pub fn of(
        guard_bits: u32,
        subpixel_bits: u32,
        channels: &[Channel],
        kt: u32,
        polygon: &Polygon,
    ) -> PortStamp {
        let formats = channels.iter().flat_map(|c| [c.kind as u32, c.bits, c.vertex_fraction]);
        let own = (kt > 0).then_some(kt).into_iter();
        let own = own.chain(polygon.has_lines().then_some(u32::MAX));
        let own = own.chain(polygon.is_there().then_some(u32::MAX - 1));
        let numbers = [guard_bits, subpixel_bits].into_iter().chain(formats).chain(own);
        PortStamp(numbers.fold(0x811c_9dc5, |hash, number| (hash ^ number).wrapping_mul(0x0100_0193)))
    }
}
