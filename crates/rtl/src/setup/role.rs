//! A triangle, or a line.

use edgewalk_netlist::Signal;

use super::control::Control;
use super::polygon::Kind;
use crate::wires::{Registers, Token};

/// What the vertices are, in a machine that takes lines.
#[derive(Clone, Copy)]
pub(super) struct Role<'m> {
    /// A line, a pixel wide.
    pub thin: Signal<'m>,
    /// A line with x and y exchanged.
    pub flat: Signal<'m>,
}

impl<'m> Role<'m> {
    /// Takes it with the vertices, for the prim and the lines; none where the port takes triangles only.
    pub fn take(control: &Control<'m>, triangle: &Token<'m>, prim: &Registers<'m>) -> Option<Role<'m>> {
        let (thin, flat) = (prim.get("thin")?, prim.get("flat")?);
        let is_line = triangle.get("thin").unwrap_or_else(|| triangle["kind"].eq(Kind::Line as i32));
        thin.when(control.sequence.take, is_line);
        flat.when(control.sequence.take, is_line & triangle["flat"]);
        Some(Role { thin: thin.q(), flat: flat.q() })
    }
}
