//! The model's tokens as port values: every field is found by its declared name, once, when a device is made.

use crate::interface::{Link, Port};
use edgewalk_machine::Plan;
use edgewalk_model::named::Place;
use edgewalk_model::tokens::Sourced;

/// The fields of one link.
#[derive(Clone, Debug)]
pub struct Table<T> {
    blank: T,
    /// Where each field stands in the token, the width of its port, and whether it is two's complement.
    fields: Vec<(Place, u32, bool)>,
}

impl<T: Sourced> Table<T> {
    /// Finds the token's own fields of a link.
    ///
    /// # Errors
    /// The first port that the token has no field for.
    pub fn of(plan: &Plan, link: &Link) -> Result<Table<T>, Box<Port>> {
        let found = link.fields[..link.own].iter().map(|port| {
            let place = T::find(plan, &port.field.name).ok_or_else(|| Box::new(port.clone()))?;
            Ok((place, port.width(), port.is_signed()))
        });
        Ok(Table { blank: T::blank(plan), fields: found.collect::<Result<_, Box<Port>>>()? })
    }

    /// The token with these fields, of this triangle.
    pub fn unpack(&self, values: &[u128], triangle: u32) -> T {
        let mut token = self.blank;
        for ((place, width, signed), value) in self.fields.iter().zip(values) {
            token.at(*place).set(*value, *width, *signed);
        }
        token.source().id = triangle;
        token
    }
}
