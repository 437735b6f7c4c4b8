//! Every declared field of a token has a place of its own in the model's token, and keeps what is written there.

use crate::common::machine;
use edgewalk_machine::units::tokens;
use edgewalk_machine::{Field, Plan};
use edgewalk_model::Lit;
use edgewalk_model::named::Named;
use edgewalk_model::term::WalkedSpan;
use edgewalk_model::tokens::{ColorWrite, Fragment, Line, MAX_CHANNELS, Prim, Span, Write};

const C: usize = MAX_CHANNELS;

/// Writes other bits into each field, and then reads all of them; how many.
fn kept<T: Named>(plan: &Plan, fields: Vec<Field>) -> usize {
    let mut token = T::blank(plan);
    let value = |number: usize, width: u32| {
        (0x9e37_79b9_7f4a_7c15_u128 * (2 * number as u128 + 1)) & (u128::MAX >> (128 - width))
    };
    let places: Vec<_> = fields
        .iter()
        .map(|field| T::find(plan, &field.name).unwrap_or_else(|| panic!("no place for {}", field.name)))
        .collect();
    for (number, (place, field)) in places.iter().zip(&fields).enumerate() {
        token.at(*place).set(value(number, field.width()), field.width(), field.format.is_signed());
    }
    for (number, (place, field)) in places.iter().zip(&fields).enumerate() {
        let bits = token.at(*place).bits();
        let cut = bits & (u128::MAX >> (128 - field.width()));
        assert_eq!(cut, value(number, field.width()), "{}", field.name);
        let negative = field.format.is_signed() && cut >> (field.width() - 1) == 1;
        assert!(bits >> 127 == 0 || negative, "{}: only two's complement is below 0", field.name);
    }
    assert!(T::find(plan, "nothing").is_none());
    places.len()
}

#[test]
fn declared_fields_have_places_of_their_own() {
    let machines: [&[(&str, &str)]; 7] = [
        &[],
        &[("edge.kind", "slope"), ("channels.extra", "4")],
        &[("blend.kind", "interpolated"), ("channels.extra", "1")],
        &[("blend.kind", "constant"), ("shadow.light", "perspective"), ("shadow.transmits", "yes")],
        &[("shade.kind", "phong"), ("shade.light", "positional")],
        &[("shade.kind", "fast-phong"), ("shade.lights", "2"), ("shade.material_bits", "3")],
        &[
            ("shade.kind", "phong"),
            ("shade.colour", "multiply"),
            ("texture.kind", "nearest"),
            ("texture.bump", "yes"),
            ("shade.material_bits", "2"),
        ],
    ];
    let mut checked = 0;
    for keys in machines {
        let plan = machine(keys).tagged();
        checked += kept::<Prim<C>>(&plan, tokens::prim(&plan));
        checked += kept::<Line<C>>(&plan, tokens::line(&plan));
        checked += kept::<Span<C>>(&plan, tokens::span(&plan));
        checked += kept::<WalkedSpan<C>>(&plan, tokens::walked(&plan));
        let on_the_way =
            [tokens::fragment, tokens::textured, tokens::bumped, tokens::cosines, tokens::tinted];
        checked += on_the_way.iter().map(|fields| kept::<Lit<C>>(&plan, fields(&plan))).sum::<usize>();
        checked += kept::<Fragment<C>>(&plan, tokens::projected(&plan));
        checked += kept::<Fragment<C>>(&plan, tokens::shaded(&plan));
        checked += kept::<Write<C>>(&plan, tokens::write(&plan));
        if plan.blend.is_there() {
            checked += kept::<Write<C>>(&plan, tokens::depth_write(&plan));
            checked += kept::<Fragment<C>>(&plan, tokens::passed(&plan));
            checked += kept::<ColorWrite<C>>(&plan, tokens::color_write(&plan));
        }
    }
    println!("{checked} fields");
    assert!(checked > 1000, "{checked}");
}
