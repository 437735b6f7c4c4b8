//! The addresses and words of the memories.

use crate::field::{Field, Scale};
use crate::plan::Plan;

/// A word of the memory of the terms.
#[must_use]
pub fn term_address(plan: &Plan) -> Field {
    let place = plan.record_place_bits();
    Field::count("addr", plan.shade.record_bits + place, format!("record * 2^{place} + word"))
}

/// A word of the memory of the tables.
#[must_use]
pub fn table_address(plan: &Plan) -> Field {
    let entry = plan.shade.entry_bits();
    Field::count("addr", plan.shade.material_bits + entry, format!("material * 2^{entry} + entry"))
}

/// The address of a pixel, `y·2^xb + x`.
#[must_use]
pub fn address(plan: &Plan) -> Field {
    let w = plan.widths();
    Field::count("addr", w.address, format!("line * 2^{} + column", w.x))
}

/// The address of a texel, `ty·2^SB + tx`.
#[must_use]
pub fn texel_address(plan: &Plan) -> Field {
    let side = plan.shadow.side_bits();
    Field::count("addr", 2 * side, format!("line * 2^{side} + column of the map"))
}

/// A word of the light's map: a depth, and with `shadow.transmits` a share below it.
#[must_use]
pub fn map_word(plan: &Plan) -> Field {
    if plan.shadow.transmits() {
        let doc = "{depth of the surface nearest to the light, share of the light in front of it}";
        return Field::count("texel", plan.map_word_bits(), doc);
    }
    Field::count("depth", plan.shadow.depth_bits, "depth of the surface nearest to the light")
}

/// A word of the memory of the textures.
#[must_use]
pub fn texture_word(plan: &Plan) -> Field {
    if plan.shade.bumps() {
        let doc = "{red, green, blue, slope along u, slope along v}, red in the top bits";
        return Field::count("texel", plan.texel_word_bits(), doc);
    }
    Field::count("rgb", plan.texel_word_bits(), "{red, green, blue}, red in the top bits")
}

/// The word that comes back from the depth memory.
#[must_use]
pub fn depth_word(plan: &Plan) -> Field {
    let z = Field::output(&plan.channels()[0]);
    Field { scale: Scale::Unorm, doc: "old depth of the address read".to_owned(), ..z }
}

/// A word of the colour memory: red, green and blue, red the most significant.
#[must_use]
pub fn color_word(plan: &Plan) -> Field {
    Field::count("rgb", 3 * plan.color.bits, "{red, green, blue}, red in the top bits")
}
