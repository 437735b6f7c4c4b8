//! A signed number cut to fewer bits.

use edgewalk_netlist::{Module, Signal};

/// `number`, signed, in so many bits; what is beyond them is the last that they say.
pub(crate) fn cut<'m>(m: &'m Module, name: &str, number: Signal<'m>, width: u32) -> Signal<'m> {
    if number.width() <= width {
        return number.sext(width);
    }
    let above = number.slice(number.width() - 1, width - 1);
    let fits = (above.all() | !above.any()).named(&format!("{name}_fits"));
    let end = m.cat(&[number.msb(), (!number.msb()).sext(width - 1)]);
    fits.mux(number.trunc(width), end)
}
