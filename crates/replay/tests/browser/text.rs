//! What ought to stand on the page for a value: written from `docs/replay.md`, in integers.

use edgewalk_model::View;
use edgewalk_model::view::{Item, Shape, UnitView};

/// The text of a register or field.
pub fn text(shape: Shape, raw: u64, hex: bool) -> String {
    let digits = |bits: u32| format!("{raw:0>width$X}", width = bits.div_ceil(4) as usize);
    match shape {
        Shape::Flag => {
            if hex {
                raw.to_string()
            } else {
                ["no", "yes"][raw as usize].to_owned()
            }
        }
        Shape::Code(words) => {
            if hex {
                digits(shape.bits())
            } else {
                words[raw as usize].to_owned()
            }
        }
        Shape::Triangle if raw == 0 => "–".to_owned(),
        Shape::Triangle => format!("T{}", raw - 1),
        Shape::Token(_) if raw == 0 => "–".to_owned(),
        Shape::Token(_) => format!("#{raw}"),
        Shape::Pixel { .. } if hex => digits(shape.bits()),
        Shape::Pixel { x_bits, bits, of_map } => {
            let (word, low) =
                if raw >> bits == 0 { ("", x_bits) } else { ("map ", of_map.expect("it has a map")) };
            let address = raw & ((1 << bits) - 1);
            format!("{word}({}, {})", address & ((1 << low) - 1), address >> low)
        }
        Shape::Number { bits, .. } if hex => digits(bits),
        Shape::Number { bits, fraction, signed, .. } => decimal(bits, fraction, signed, raw),
    }
}

/// Rounded half away from zero: three digits, of numbers with more than 16 bits before the point one.
fn decimal(bits: u32, fraction: u32, signed: bool, raw: u64) -> String {
    let negative = signed && raw >> (bits - 1) & 1 == 1;
    let value = if negative { i128::from(raw) - (1 << bits) } else { raw.into() };
    let digits = (if bits - fraction > 16 { 1 } else { 3 }).min(fraction);
    let scaled = (value.unsigned_abs() * 10u128.pow(digits) * 2 + (1 << fraction)) >> (fraction + 1);
    let (whole, rest) = (scaled / 10u128.pow(digits), scaled % 10u128.pow(digits));
    let text = if digits == 0 {
        whole.to_string()
    } else {
        format!("{whole}.{rest:0>width$}", width = digits as usize)
    };
    if negative && scaled > 0 { format!("−{text}") } else { text }
}

/// Registers of a unit that sentences may name.
fn named(unit: &UnitView) -> Vec<usize> {
    let of_item = |item: &Item| match item {
        Item::Register(id) => vec![*id],
        Item::Table(table) => table.rows.iter().flat_map(|row| row.cells.clone()).collect(),
        Item::Schedule { .. } => Vec::new(),
    };
    unit.aside.iter().copied().chain(unit.items.iter().flat_map(of_item)).collect()
}

/// The sentences that hold of the cycle that the view shows.
pub fn sentences(view: &View, hex: bool) -> Vec<String> {
    let structure = view.structure();
    let mut list = Vec::new();
    for unit in &structure.units {
        for says in unit.says.iter().filter(|says| view.values()[says.when] == 1) {
            let mut words = String::new();
            for (place, part) in says.text.split(['{', '}']).enumerate() {
                words += &if place % 2 == 0 { part.to_owned() } else { word(view, unit, part, hex) };
            }
            list.push(words);
        }
    }
    list
}

fn word(view: &View, unit: &UnitView, path: &str, hex: bool) -> String {
    let (structure, ids) = (view.structure(), named(unit));
    let of = |id: &&usize| structure.registers[**id].name == path;
    if let Some(id) = ids.iter().rev().find(of) {
        return text(structure.registers[*id].shape, view.values()[*id], hex);
    }
    let (owner, field) = path.rsplit_once('.').expect("owner.field");
    let id = ids.iter().find(|id| {
        let name = &structure.registers[**id].name;
        name == owner || name.starts_with(&format!("{owner}."))
    });
    let id = *id.expect("a token");
    let Shape::Token(table) = structure.registers[id].shape else { panic!("{path} is no token") };
    let kind = &view.tokens().kinds()[table];
    let place = kind.fields.iter().position(|own| own.name == field).expect("a field");
    match view.values()[id].checked_sub(1) {
        None => "–".to_owned(),
        Some(number) => text(kind.fields[place].shape, kind.met[number as usize][place + 1], hex),
    }
}
