//! What BUMP makes of a pixel's cosines: the products of its slopes, and their sum.

use super::table_read::TableRead;
use edgewalk_machine::Plan;
use serde::Serialize;

/// A cosine, or N·N, whose normal a relief has turned.
#[derive(Debug, Serialize)]
pub struct Turned {
    pub name: &'static str,
    /// The term's output.
    before: i64,
    /// What is added to 2^shift times that: factors of slopes, and the outputs of the terms that they are multiplied with.
    products: Vec<[i64; 2]>,
    /// Bits that the sum loses.
    shift: u32,
    /// What NORMAL or SHADE takes.
    pub after: i64,
    /// Where it is the index of a table.
    #[serde(skip_serializing_if = "Option::is_none")]
    read: Option<TableRead>,
}

/// Of every cosine that the machine has terms for; `output` is that of a term by its name, `read` what an index reads.
pub fn all(
    machine: &Plan,
    [bu, bv]: [i64; 2],
    output: impl Fn(&str) -> Option<i64>,
    read: impl Fn(usize, i64) -> Option<TableRead>,
) -> Vec<Turned> {
    let (one, below) = (machine.shade.slope_bits - 1, machine.shade.cosine_fraction());
    let normalises = machine.shade.normalises();
    let turned = |(place, term): (usize, &edgewalk_machine::Term)| {
        let is_square = term.degree == 2 && normalises;
        let (factors, scale, half) = if is_square {
            (
                vec![(bu * bu, "tuu".to_owned()), (bu * bv, "tuv".to_owned()), (bv * bv, "tvv".to_owned())],
                2 * one,
                0,
            )
        } else {
            let turns = vec![(bu, format!("{}u", term.name)), (bv, format!("{}v", term.name))];
            (turns, one, if normalises { 1 << (one - 1) } else { 0 })
        };
        let before = output(term.name)?;
        let products: Option<Vec<[i64; 2]>> =
            factors.into_iter().map(|(factor, name)| Some([factor, output(&name)?])).collect();
        let products = products?;
        let shift = if is_square { scale } else { scale + below };
        let sum = (before << scale) + half + products.iter().map(|[factor, turn]| factor * turn).sum::<i64>();
        let end = 1i64 << (term.bits - below - 1);
        let after = (sum >> shift).clamp(-end, end - 1);
        let read = if normalises { None } else { read(place, after) };
        Some(Turned { name: term.name, before, products, shift, after, read })
    };
    machine.terms().iter().take(machine.cosine_terms()).enumerate().filter_map(turned).collect()
}

impl Turned {
    /// As a line of text.
    pub fn text(&self) -> String {
        let Turned { name, before, products, shift, after, read } = self;
        let products: String =
            products.iter().map(|[factor, turn]| format!(" + {factor} x {turn}")).collect();
        let read = read.as_ref().map_or_else(String::new, |read| read.text(*after));
        format!("{name} turned: ({before} scaled{products}) / 2^{shift} = {after}{read}\n")
    }
}
