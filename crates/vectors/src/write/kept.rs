//! Values that a unit holds beside a channel: what the bench and the rules look at.

use super::device::places;
use crate::dut::{Wire, Wiring};
use edgewalk_lockstep::{Direction, Interface, Link, Port};
use edgewalk_machine::Until;

/// A channel with values held beside it, and the channel whose tokens end them.
pub struct Kept<'a> {
    /// The channel.
    pub link: &'a Link,
    /// The channel in, whose next token ends the values.
    pub taken: &'a Link,
    /// The flag of the channel with the first token of a triangle.
    pub fresh: &'a Port,
    /// The flag without which a token taken ends nothing.
    pub ends: Option<&'a Port>,
}

/// The channels of a unit with values held beside them.
pub fn all(interface: &Interface) -> impl Iterator<Item = Kept<'_>> {
    interface.links.iter().filter(|link| link.holds()).filter_map(|link| {
        let taken = interface.links_of(Direction::In).next()?;
        let ends = match link.held_until? {
            Until::Taken => None,
            Until::TakenWith(flag) => Some(&taken.fields[taken.place(flag)?]),
            // They count with the token alone.
            Until::Offered => return None,
        };
        Some(Kept { link, taken, fresh: &link.fields[link.place("fresh")?], ends })
    })
}

/// The part of the bench that watches them, and its counts of faults.
pub fn section(interface: &Interface, wiring: Option<&Wiring>) -> (String, Vec<String>) {
    let (mut text, mut wrong) = (String::new(), Vec::new());
    for kept in all(interface) {
        let name = kept.link.name;
        let there = |port: &Port| {
            wiring.is_none_or(|wiring| {
                let links = interface.links.iter().zip(&wiring.links);
                let mut wires = links.flat_map(|(link, ends)| link.fields.iter().zip(&ends.fields));
                wires.any(|(field, wire)| field.id == port.id && *wire != Wire::Absent)
            })
        };
        let held: Vec<(&Port, String)> =
            places(kept.link).skip(kept.link.own).filter(|(port, _)| there(port)).collect();
        if held.is_empty() {
            continue;
        }
        let bits = |of: &Link, port: &Port| {
            let place = places(of).find(|(field, _)| field.id == port.id);
            place.map_or_else(String::new, |(_, bits)| format!(" && {bits}"))
        };
        let (names, values): (Vec<&str>, Vec<&str>) =
            held.iter().map(|(port, bits)| (port.name.as_str(), bits.as_str())).unzip();
        let width: u32 = held.iter().map(|(port, _)| port.width()).sum();
        let ends = kept.ends.map(|ends| bits(kept.taken, ends)).unwrap_or_default();
        text += &KEPT
            .replace("{name}", name)
            .replace("{names}", &names.join(", "))
            .replace("{width}", &width.to_string())
            .replace("{moved}", &format!("{name}_fire{}", bits(kept.link, kept.fresh)))
            .replace("{taken}", &format!("{}_fire{ends}", kept.taken.name))
            .replace("{values}", &values.join(", "));
        wrong.push(format!("{name}_unkept"));
    }
    (text, wrong)
}

const KEPT: &str = r#"
    // {names}: held beside {name}.
    wire [31:0] {name}_unkept;
    bench_kept #(.WIDTH({width}), .AHEAD(CHECK_CYCLES == 0), .NAME("{names}")) {name}_kept (
        .clk(clk), .rst(rst), .told(compared), .cycle(cycle),
        .moved({moved}), .taken({taken}),
        .values({{values}}), .wrong({name}_unkept)
    );
"#;
