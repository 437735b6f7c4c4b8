//! Constants: decimal while short, else hexadecimal, always with their width.

use edgewalk_netlist::ops::Bits;

/// Up to here a number is read more easily in decimal.
const LARGEST_DECIMAL: u128 = 9999;

/// An unsigned constant, `22'd5`.
pub(crate) fn unsigned(bits: Bits) -> String {
    let Bits { value, width } = bits;
    match width {
        1 => format!("1'b{value}"),
        _ if value <= LARGEST_DECIMAL => format!("{width}'d{value}"),
        _ => format!("{width}'h{value:x}"),
    }
}

/// A signed constant, `-22'sd5`.
pub(crate) fn signed(bits: Bits) -> String {
    let (width, value) = (bits.width, bits.signed());
    let size = value.unsigned_abs();
    // The most negative number has no positive counterpart to put a minus before.
    if size > LARGEST_DECIMAL || width == 1 || bits.value == 1 << (width - 1) {
        return format!("{width}'sh{:x}", bits.value);
    }
    format!("{}{width}'sd{size}", if value < 0 { "-" } else { "" })
}

/// The range of a declaration with a space after it, `[21:0] `; nothing for one bit.
pub(crate) fn range(width: u32) -> String {
    if width == 1 { String::new() } else { format!("[{}:0] ", width - 1) }
}
