//! The model's tokens as port values: every field is found by its declared name, once, when a device is made.

use crate::interface::{Link, Port};
use edgewalk_machine::{EdgeKind, Plan};
use edgewalk_model::tokens::{ColorWrite, EdgeWalk, Fragment, Line, Prim, Source, Span, Write};

/// A number inside a token of the model.
pub enum Slot<'a> {
    /// Not negative.
    U32(&'a mut u32),
    /// Not negative.
    U64(&'a mut u64),
    /// Of either sign; the port says whether its bits are two's complement.
    I32(&'a mut i32),
    /// 0 or 1.
    Bool(&'a mut bool),
}

impl Slot<'_> {
    fn get(&self) -> u128 {
        match self {
            Slot::U32(value) => (**value).into(),
            Slot::U64(value) => (**value).into(),
            Slot::I32(value) => i128::from(**value) as u128, // the caller cuts it
            Slot::Bool(value) => (**value).into(),
        }
    }

    /// `width` is that of the port; no port is wider than the model's number for it.
    fn set(self, bits: u128, width: u32, signed: bool) {
        match self {
            Slot::U32(value) => *value = bits as u32,
            Slot::U64(value) => *value = bits as u64,
            Slot::I32(value) if signed => *value = ((bits as u32) << (32 - width)) as i32 >> (32 - width),
            Slot::I32(value) => *value = bits as i32,
            Slot::Bool(value) => *value = bits == 1,
        }
    }
}

/// Where a field stands in the token; the number is that of an edge, a part or a channel.
pub type Find<T> = (fn(&mut T, usize) -> Slot<'_>, usize);

/// A token of the model whose fields have names.
pub trait Named: Copy {
    /// The token before its fields are set.
    fn blank(plan: &Plan) -> Self;

    /// The field of that name.
    fn find(plan: &Plan, name: &str) -> Option<Find<Self>>;

    /// The triangle it comes from.
    fn source(&mut self) -> &mut Source;
}

/// The fields of one link.
#[derive(Clone, Debug)]
pub struct Table<T> {
    blank: T,
    fields: Vec<Place<T>>,
}

/// A field of a link and its place in the token.
#[derive(Clone, Copy, Debug)]
struct Place<T> {
    slot: fn(&mut T, usize) -> Slot<'_>,
    number: usize,
    width: u32,
    signed: bool,
}

impl<T: Named> Table<T> {
    /// Finds the token's own fields of a link.
    ///
    /// # Errors
    /// The first port that the token has no field for.
    pub fn of(plan: &Plan, link: &Link) -> Result<Table<T>, Box<Port>> {
        let found = link.fields[..link.own].iter().map(|port| {
            let (slot, number) = T::find(plan, &port.field.name).ok_or_else(|| Box::new(port.clone()))?;
            Ok(Place { slot, number, width: port.width(), signed: port.is_signed() })
        });
        Ok(Table { blank: T::blank(plan), fields: found.collect::<Result<_, Box<Port>>>()? })
    }

    /// The fields of a token.
    pub fn pack(&self, token: &T, values: &mut [u128]) {
        let mut token = *token;
        for (field, value) in self.fields.iter().zip(values) {
            *value = (field.slot)(&mut token, field.number).get() & (u128::MAX >> (128 - field.width));
        }
    }

    /// The token with these fields, of this triangle.
    pub fn unpack(&self, values: &[u128], triangle: u32) -> T {
        let mut token = self.blank;
        for (field, value) in self.fields.iter().zip(values) {
            (field.slot)(&mut token, field.number).set(*value, field.width, field.signed);
        }
        token.source().id = triangle;
        token
    }
}

/// A number at a place of the token, of the kind of [`Slot`]; `$i` stands for the edge, the part or the channel.
macro_rules! slot {
    ($kind:ident, $i:ident => $($place:tt)+) => { |t, $i| Slot::$kind(&mut t.$($place)+) };
}

fn channel(plan: &Plan, name: &str) -> Option<usize> {
    plan.channels().iter().position(|channel| channel.name == name)
}

impl<const C: usize> Named for Prim<C> {
    fn blank(plan: &Plan) -> Self {
        // The modulus of a slope edge is the constant 2^F, no port.
        let m = if plan.edge_kind == EdgeKind::Slope { 1 << plan.edge_fraction } else { 0 };
        let edge = EdgeWalk { m, ..EdgeWalk::default() };
        Prim { major: edge, minor: [edge; 2], ..Prim::default() }
    }

    fn find(plan: &Plan, name: &str) -> Option<Find<Self>> {
        Some(match name {
            "jm" => (slot!(U32, _i => line), 0),
            "n1" => (slot!(U32, i => lines[i]), 0),
            "n2" => (slot!(U32, i => lines[i]), 1),
            "major_right" => (slot!(Bool, _i => major_right), 0),
            "major_c" => (slot!(I32, _i => major.c), 0),
            "major_r" => (slot!(I32, _i => major.r), 0),
            "major_q" => (slot!(I32, _i => major.q), 0),
            "major_f" => (slot!(I32, _i => major.f), 0),
            "major_m" => (slot!(I32, _i => major.m), 0),
            "kt" => (slot!(U32, _i => kt), 0),
            "record" => (slot!(U32, _i => record), 0),
            "tag" => (slot!(U32, _i => source.tag), 0),
            _ => return minor(name).or_else(|| result(plan, name)),
        })
    }

    fn source(&mut self) -> &mut Source {
        &mut self.source
    }
}

/// `minor1_c` to `minor2_m`.
fn minor<const C: usize>(name: &str) -> Option<Find<Prim<C>>> {
    let (edge, part) = name.strip_prefix("minor")?.split_once('_')?;
    let edge = ["1", "2"].iter().position(|number| *number == edge)?;
    let slot: fn(&mut Prim<C>, usize) -> Slot<'_> = match part {
        "c" => slot!(I32, i => minor[i].c),
        "r" => slot!(I32, i => minor[i].r),
        "q" => slot!(I32, i => minor[i].q),
        "f" => slot!(I32, i => minor[i].f),
        "m" => slot!(I32, i => minor[i].m),
        _ => return None,
    };
    Some((slot, edge))
}

/// `z_start` to `e3_g`; in textbook fill `z_start_a` and so on.
fn result<const C: usize>(plan: &Plan, name: &str) -> Option<Find<Prim<C>>> {
    let (of, result) = name.split_once('_')?;
    let slot: fn(&mut Prim<C>, usize) -> Slot<'_> = match result {
        "start" | "start_a" => slot!(U64, i => start[0][i]),
        "start_b" => slot!(U64, i => start[1][i]),
        "d0" | "d_a" => slot!(U64, i => delta[0][i]),
        "d1" | "d_b" => slot!(U64, i => delta[1][i]),
        "g" => slot!(U64, i => gradient[i]),
        _ => return None,
    };
    Some((slot, channel(plan, of)?))
}

impl<const C: usize> Named for Line<C> {
    fn blank(_: &Plan) -> Self {
        Line::default()
    }

    fn find(plan: &Plan, name: &str) -> Option<Find<Self>> {
        Some(match name {
            "y" => (slot!(U32, _i => y), 0),
            "cmaj" => (slot!(I32, _i => major), 0),
            "cmin" => (slot!(I32, _i => minor), 0),
            "major_right" => (slot!(Bool, _i => major_right), 0),
            "fresh" => (slot!(Bool, _i => fresh), 0),
            "fence" => (slot!(Bool, _i => fence), 0),
            "tag" => (slot!(U32, _i => source.tag), 0),
            _ => (slot!(U64, i => values[i]), channel(plan, name)?),
        })
    }

    fn source(&mut self) -> &mut Source {
        &mut self.source
    }
}

impl<const C: usize> Named for Span<C> {
    fn blank(_: &Plan) -> Self {
        Span::default()
    }

    fn find(plan: &Plan, name: &str) -> Option<Find<Self>> {
        Some(match name {
            "x" => (slot!(I32, _i => x), 0),
            "y" => (slot!(U32, _i => y), 0),
            "count" => (slot!(U32, _i => count), 0),
            "leftward" => (slot!(Bool, _i => leftward), 0),
            "fresh" => (slot!(Bool, _i => fresh), 0),
            "fence" => (slot!(Bool, _i => fence), 0),
            "tag" => (slot!(U32, _i => source.tag), 0),
            _ => (slot!(U64, i => values[i]), channel(plan, name)?),
        })
    }

    fn source(&mut self) -> &mut Source {
        &mut self.source
    }
}

impl<const C: usize> Named for Fragment<C> {
    fn blank(_: &Plan) -> Self {
        Fragment::default()
    }

    fn find(plan: &Plan, name: &str) -> Option<Find<Self>> {
        Some(match name {
            "addr" => (slot!(U32, _i => addr), 0),
            "fence" => (slot!(Bool, _i => fence), 0),
            "lit" => (slot!(Bool, _i => lit), 0),
            "tag" => (slot!(U32, _i => source.tag), 0),
            "kt" if channel(plan, name).is_none() => (slot!(U32, _i => kt), 0),
            _ => (slot!(U32, i => values[i]), channel(plan, name)?),
        })
    }

    fn source(&mut self) -> &mut Source {
        &mut self.source
    }
}

impl<const C: usize> Named for Write<C> {
    fn blank(_: &Plan) -> Self {
        Write::default()
    }

    fn find(plan: &Plan, name: &str) -> Option<Find<Self>> {
        Some(match name {
            "addr" => (slot!(U32, _i => addr), 0),
            "z_en" => (slot!(Bool, _i => z_en), 0),
            "lit" => (slot!(Bool, _i => lit), 0),
            "tag" => (slot!(U32, _i => source.tag), 0),
            _ => (slot!(U32, i => values[i]), channel(plan, name)?),
        })
    }

    fn source(&mut self) -> &mut Source {
        &mut self.source
    }
}

impl<const C: usize> Named for ColorWrite<C> {
    fn blank(_: &Plan) -> Self {
        ColorWrite::default()
    }

    fn find(plan: &Plan, name: &str) -> Option<Find<Self>> {
        Some(match name {
            "addr" => (slot!(U32, _i => addr), 0),
            "rgb" => (slot!(U64, _i => rgb), 0),
            "lit" => (slot!(Bool, _i => lit), 0),
            "tag" => (slot!(U32, _i => source.tag), 0),
            _ => (slot!(U32, i => values[i]), channel(plan, name)?),
        })
    }

    fn source(&mut self) -> &mut Source {
        &mut self.source
    }
}
