//! An edge from line to line, for the units that walk edges.

use edgewalk_netlist::{Module, Signal};

use crate::wires::Part;

/// What a prim has of each edge: the parts of its first minor one, without that one's name.
pub(crate) fn parts_of_edge(prim: &[Part]) -> Vec<Part> {
    let of_edge = |part: &Part| {
        part.name.strip_prefix("minor1_").map(|name| Part { name: name.to_owned(), ..part.clone() })
    };
    prim.iter().filter_map(of_edge).collect()
}

/// What is kept of an edge in place of R: R - f. Its sign says whether the step carries.
#[derive(Clone, Copy)]
pub(crate) struct Rest<'a, 'm> {
    /// What the wires are called after.
    pub name: &'a str,
    /// R - f, signed.
    pub rest: Signal<'m>,
    /// f.
    pub f: Signal<'m>,
    /// M; `None` where it is 2^F.
    pub modulus: Option<Signal<'m>>,
}

impl<'m> Rest<'_, 'm> {
    /// R - f a line further.
    pub fn next(self, m: &'m Module) -> Signal<'m> {
        let Rest { name, rest, f, modulus } = self;
        let bits = rest.width();
        let f = f.zext(bits);
        match modulus {
            // f first: that sum waits for nothing, and M only for the carry.
            Some(modulus) => {
                let less = (rest - f).named(&format!("{name}_less"));
                let back = rest.msb().mux(modulus.zext(bits), m.lit(bits, 0)).named(&format!("{name}_back"));
                less + back
            }
            // The modulus is 2^F, and R wraps by itself.
            None => rest.trunc(bits - 1).zext(bits) - f,
        }
    }
}

/// R - f of an edge at its first line, signed: a bit more than R.
pub(crate) fn first_rest<'m>(r: Signal<'m>, f: Signal<'m>) -> Signal<'m> {
    let bits = r.width() + 1;
    r.zext(bits) - f.zext(bits)
}
