//! Save files for viewers: the ports of the machine and what its units give, each in a format that fits.

use edgewalk_lockstep::{Direction, Interface, Port, Unit};
use edgewalk_machine::{Activity, Plan, Scale};
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// A signal as a viewer is to show it.
struct Signal {
    /// Path of the signal below the outermost scope.
    path: String,
    width: u32,
    signed: bool,
    /// Bits behind the point.
    fraction: u32,
    /// Characters, eight bits each, or a text.
    text: bool,
}

/// Signals under a heading.
struct Group {
    heading: String,
    signals: Vec<Signal>,
}

/// What is worth to be seen, in the order of the data. `there` are the paths of the waveform, `texts` how its texts are
/// kept: as characters, or not as bits at all.
pub struct Views {
    top: &'static str,
    groups: Vec<Group>,
    /// Texts are vectors of characters.
    characters: bool,
}

impl Views {
    /// Of a machine under the outermost scope `top`; of signals that the waveform has not nothing is shown.
    pub fn new(plan: &Plan, top: &'static str, there: &BTreeSet<String>, characters: bool) -> Views {
        let mut groups = Vec::new();
        for unit in Unit::all(plan) {
            let scope = if unit == Unit::MACHINE { String::new() } else { format!("u_{}.", unit.name()) };
            let interface = Interface::new(plan, unit);
            let signal = |port: &Port| Signal::new(&scope, port);
            // What a unit takes is what the one before gives.
            let links = interface
                .links
                .iter()
                .filter(|link| unit == Unit::MACHINE || link.direction == Direction::Out);
            for link in links {
                let handshake = [link.valid, link.ready].map(|id| signal(interface.at(id)));
                let signals = handshake.into_iter().chain(link.fields.iter().map(signal)).collect();
                groups.push(Group { heading: format!("{} {}", unit.name(), link.name), signals });
            }
            let status: Vec<Signal> = interface.status.iter().map(|status| signal(&status.port)).collect();
            let mut group = Group { heading: format!("{} status", unit.name()), signals: status };
            if unit == Unit::MACHINE {
                let longest = Activity::ALL.iter().map(|cause| cause.name().len()).max().unwrap_or(1) as u32;
                let path = "activity_name".to_owned();
                group.signals.push(Signal {
                    path,
                    width: 8 * longest,
                    signed: false,
                    fraction: 0,
                    text: true,
                });
            }
            groups.push(group);
        }
        for group in &mut groups {
            group.signals.retain(|signal| signal.text || there.contains(&signal.path));
        }
        groups.retain(|group| !group.signals.is_empty());
        Views { top, groups, characters }
    }

    /// A save file of GTKWave: values with a point are shown with it.
    pub fn gtkwave(&self, plan: &Plan) -> String {
        let mut text = format!("{}[timestart] 0\n[treeopen] {}.\n", plan.stamp("[*]"), self.top);
        // Writing to a string cannot fail.
        for Group { heading, signals } in &self.groups {
            _ = writeln!(text, "@{COMMENT:x}\n-{heading}");
            for signal in signals {
                _ = writeln!(text, "@{:x}", signal.flags());
                if signal.fraction > 0 {
                    _ = writeln!(text, "[fpshift_count] {}", signal.fraction);
                }
                let range = match signal.width {
                    1 => String::new(),
                    _ if signal.text && !self.characters => String::new(),
                    width => format!("[{}:0]", width - 1),
                };
                _ = writeln!(text, "{}.{}{range}", self.top, signal.path);
            }
        }
        text
    }

    /// A command file of Surfer, which shows whole numbers.
    pub fn surfer(&self, plan: &Plan) -> String {
        let (mut added, mut formats, mut place) = (plan.stamp("#"), String::new(), 0);
        for Group { heading, signals } in &self.groups {
            _ = writeln!(added, "divider_add {}", heading.replace(' ', "_"));
            place += 1;
            for signal in signals {
                _ = writeln!(added, "variable_add {}.{}", self.top, signal.path);
                // A text that is no vector has no other format.
                if !signal.text || self.characters {
                    _ = writeln!(
                        formats,
                        "item_focus {}_\nitem_set_format {}",
                        letters(place),
                        signal.format()
                    );
                }
                place += 1;
            }
        }
        // Surfer adds items behind the focused one, so all items are added before one gets the focus.
        added + &formats + "item_unfocus\nzoom_fit\n"
    }
}

/// Flags of a line in GTKWave, as its save files have them.
const DECIMAL: u64 = 1 << 2;
const BINARY: u64 = 1 << 3;
const HEX: u64 = 1 << 1;
const RIGHT: u64 = 1 << 5;
const COMMENT: u64 = 1 << 9;
const SIGNED: u64 = 1 << 10;
const ASCII: u64 = 1 << 11;
const POINT: u64 = 1 << 30;

/// The longest value that viewers show as a decimal number.
const LONGEST: u32 = 64;

impl Signal {
    fn new(scope: &str, port: &Port) -> Signal {
        let fraction = match port.field.scale {
            Scale::Of(_) | Scale::Modular(_) => port.field.format.fraction_bits(),
            Scale::Count | Scale::Unorm => 0,
        };
        let (width, signed) = (port.width(), port.is_signed());
        Signal { path: format!("{scope}{}", port.name), width, signed, fraction, text: false }
    }

    fn flags(&self) -> u64 {
        let point = if self.fraction > 0 { POINT } else { 0 };
        RIGHT
            | match self {
                Signal { text: true, .. } => ASCII,
                Signal { width: 1, .. } => BINARY,
                Signal { width, .. } if *width > LONGEST => HEX,
                Signal { signed: true, .. } => SIGNED | point,
                Signal { .. } => DECIMAL | point,
            }
    }

    fn format(&self) -> &'static str {
        match self {
            Signal { text: true, .. } => "ASCII",
            Signal { width: 1, .. } => "Bit",
            Signal { width, .. } if *width > LONGEST => "Hexadecimal",
            Signal { signed: true, .. } => "Signed",
            Signal { .. } => "Unsigned",
        }
    }
}

/// The place of an item as Surfer writes it: hexadecimal, with the letters a to p.
fn letters(place: usize) -> String {
    let letter = |digit: char| char::from(b'a' + digit.to_digit(16).unwrap_or(0) as u8); // below 16
    format!("{place:x}").chars().map(letter).collect()
}
