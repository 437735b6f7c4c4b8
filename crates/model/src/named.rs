//! The fields of tokens by the names that crate `machine` declares, for whoever meets tokens as values of ports.
//!
//! ```text
//!  declared name ─find─> Place ─at─> number inside the token
//! ```
//! The names stand beside the fields, in the text that declares the token.

use edgewalk_machine::{Channel, Plan, Term};

/// A number inside a token.
pub trait Number {
    /// The number as bits, a negative one in two's complement; whoever reads it cuts it to the width of its port.
    fn bits(&self) -> u128;

    /// Sets the number from the bits of a port of this width, two's complement if `signed`. No port is wider than the
    /// number behind it.
    fn set(&mut self, bits: u128, width: u32, signed: bool);
}

impl Number for u16 {
    fn bits(&self) -> u128 {
        (*self).into()
    }

    fn set(&mut self, bits: u128, _: u32, _: bool) {
        *self = bits as u16;
    }
}

impl Number for u32 {
    fn bits(&self) -> u128 {
        (*self).into()
    }

    fn set(&mut self, bits: u128, _: u32, _: bool) {
        *self = bits as u32;
    }
}

impl Number for u64 {
    fn bits(&self) -> u128 {
        (*self).into()
    }

    fn set(&mut self, bits: u128, _: u32, _: bool) {
        *self = bits as u64;
    }
}

impl Number for i32 {
    fn bits(&self) -> u128 {
        i128::from(*self) as u128
    }

    fn set(&mut self, bits: u128, width: u32, signed: bool) {
        let unused = if signed { 32 - width } else { 0 };
        *self = ((bits as u32) << unused) as i32 >> unused;
    }
}

impl Number for bool {
    fn bits(&self) -> u128 {
        (*self).into()
    }

    fn set(&mut self, bits: u128, _: u32, _: bool) {
        *self = bits == 1;
    }
}

/// Where a field stands in a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Which of the token's names, in the order of its text.
    pub(crate) name: u16,
    /// Which channel or term, where the token has the field once for each.
    pub(crate) number: u16,
}

impl Place {
    /// The place behind so many names of another token.
    pub(crate) fn behind(self, names: u16) -> Place {
        Place { name: self.name + names, ..self }
    }

    /// The place without so many names before it; none of one that is among those.
    pub(crate) fn in_front(self, names: u16) -> Option<Place> {
        Some(Place { name: self.name.checked_sub(names)?, ..self })
    }
}

/// A token whose fields have names.
pub trait Named: Copy {
    /// Names in its text.
    const NAMES: u16;

    /// The token before its fields are set.
    fn blank(plan: &Plan) -> Self;

    /// The field of that name.
    fn find(plan: &Plan, name: &str) -> Option<Place>;

    /// The number at a place that `find` has given.
    fn at(&mut self, place: Place) -> &mut dyn Number;
}

/// The channel or term that a name is for, with this text behind its own name.
pub(crate) fn of<T: Owned>(list: &[T], name: &str, behind: &str) -> Option<u16> {
    let own = name.strip_suffix(behind)?;
    list.iter().position(|entry| entry.name() == own).map(|place| place as u16)
}

/// A channel or a term.
pub(crate) trait Owned {
    fn name(&self) -> &'static str;
}

impl Owned for Channel {
    fn name(&self) -> &'static str {
        self.name
    }
}

impl Owned for Term {
    fn name(&self) -> &'static str {
        self.name
    }
}

/// Gives the fields of a token their declared names. Behind each field stand its names, each with the way from the field to
/// the number: `major [major_c(.c), major_dist(.r)]`. Of an array with an entry a channel or a term the text behind the name of
/// that is told: `start channels ["_start"([0])]`. Names of channels and terms come before all others.
macro_rules! named {
    (
        [$($generic:tt)*] $token:ty, $blank:expr,
        { $($field:ident
            [$($own:ident($($way:tt)*)),*]
            $(channels [$($channel:literal($($channel_way:tt)*)),*])?
            $(terms [$($term:literal($($term_way:tt)*)),*])?;
        )* }
    ) => {
        impl $($generic)* $crate::named::Named for $token {
            const NAMES: u16 = 0
                $($(+ { let _ = stringify!($own); 1 })* $($(+ { let _ = $channel; 1 })*)? $($(+ { let _ = $term; 1 })*)?)*;

            fn blank(plan: &edgewalk_machine::Plan) -> Self {
                let blank: fn(&edgewalk_machine::Plan) -> Self = $blank;
                blank(plan)
            }

            #[allow(unused_assignments)]
            fn find(plan: &edgewalk_machine::Plan, name: &str) -> Option<$crate::named::Place> {
                use $crate::named::{Place, of};
                let mut place = Place { name: 0, number: 0 };
                $(
                    $($(
                        if let Some(number) = of(plan.channels(), name, $channel) {
                            return Some(Place { number, ..place });
                        }
                        place.name += 1;
                    )*)?
                    $($(
                        if let Some(number) = of(plan.terms(), name, $term) {
                            return Some(Place { number, ..place });
                        }
                        place.name += 1;
                    )*)?
                )*
                $($(
                    if name == stringify!($own) {
                        return Some(place);
                    }
                    place.name += 1;
                )*)*
                None
            }

            #[allow(unused_assignments)]
            fn at(&mut self, place: $crate::named::Place) -> &mut dyn $crate::named::Number {
                let (mut name, number) = (0, usize::from(place.number));
                $(
                    $($(
                        if place.name == name {
                            return &mut self.$field $($channel_way)* [number];
                        }
                        name += 1;
                    )*)?
                    $($(
                        if place.name == name {
                            return &mut (self.$field [number]) $($term_way)*;
                        }
                        name += 1;
                    )*)?
                )*
                $($(
                    if place.name == name {
                        return &mut self.$field $($way)*;
                    }
                    name += 1;
                )*)*
                let _ = number;
                unreachable!("a place is one of the token's own")
            }
        }
    };
}
pub(crate) use named;
