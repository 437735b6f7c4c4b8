//! Machine files: TOML in, TOML out, single settings, and the hash that everything made from a machine
//! carries.

use crate::error::MachineError;
use crate::key::{Domain, Key};
use crate::keys::KEYS;
use crate::machine::Machine;
use crate::presets::PRESETS;
use edgewalk_nearest::Unknown;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use toml::de::{DeTable, DeValue};

impl Machine {
    /// Sets one key from text, as `--set key=value` does. The combination is not checked yet.
    ///
    /// # Errors
    /// Unknown key, or a value outside its domain.
    pub fn set(&mut self, name: &str, value: &str) -> Result<(), MachineError> {
        let key = Key::named(name)?;
        let number = key.parse(value).ok_or_else(|| MachineError::value(key, value))?;
        (key.set)(self, number);
        Ok(())
    }

    /// Reads a machine file over the preset `default` (or the one it names with `preset = "…"`) and checks
    /// it.
    ///
    /// # Errors
    /// Text that is no TOML, an unknown or repeated key, a value outside its domain, a combination that
    /// cannot be built.
    pub fn from_toml(text: &str) -> Result<Machine, MachineError> {
        let machine = Machine::read(text)?;
        machine.plan()?;
        Ok(machine)
    }

    /// Reads a machine file as [`Machine::from_toml`] does. The combination is not checked yet.
    ///
    /// # Errors
    /// Text that is no TOML, an unknown or repeated key, a value outside its domain.
    pub fn read(text: &str) -> Result<Machine, MachineError> {
        let table = DeTable::parse(text).map_err(|e| {
            let offset = e.span().map_or(0, |s| s.start);
            let what = e.message().replace('\n', " ");
            MachineError::new(format!("{what}; a machine file is TOML: [section] and key = value"))
                .at(text, offset)
        })?;
        let mut machine = Machine::default();
        for (section, value) in table.get_ref() {
            let place = section.span().start;
            match value.get_ref() {
                DeValue::String(name) if section.get_ref().as_ref() == "preset" => {
                    machine = Machine::preset(name).ok_or_else(|| {
                        let unknown =
                            Unknown::new("preset", &MachineError::shown(name), PRESETS.iter().map(|p| p.0));
                        MachineError::new(unknown.to_string()).at(text, place)
                    })?;
                }
                DeValue::Table(_) => {}
                _ => {
                    let name = section.get_ref();
                    let error = Key::named(name).err().unwrap_or_else(|| {
                        MachineError::new(format!("{name} stands outside its section; write [section]"))
                    });
                    return Err(error.at(text, place));
                }
            }
        }
        for (section, value) in table.get_ref() {
            let DeValue::Table(entries) = value.get_ref() else { continue };
            for (name, value) in entries {
                let full = format!("{}.{}", section.get_ref(), name.get_ref());
                let written = || text.get(value.span()).unwrap_or_default().replace('\n', " ");
                let shown = match value.get_ref() {
                    // 32 may be written 0x20.
                    DeValue::Integer(i) => i128::from_str_radix(i.as_str(), i.radix())
                        .map_or_else(|_| written(), |number| number.to_string()),
                    DeValue::String(s) => s.to_string(),
                    _ => written(),
                };
                machine.set(&full, &shown).map_err(|e| e.at(text, name.span().start))?;
            }
        }
        Ok(machine)
    }

    /// The whole machine as a file, every key with its meaning; [`Machine::from_toml`] reads it back.
    #[must_use]
    pub fn to_toml(&self) -> String {
        self.written(|key| (key.used)(self))
    }

    /// Every key as a file, with those of units that the machine has not. [`Machine::read`] reads it back. A
    /// unit that is set later then has the keys that were set for it.
    #[must_use]
    pub fn every_key_to_toml(&self) -> String {
        self.written(|_| true)
    }

    fn written(&self, wanted: impl Fn(&Key) -> bool) -> String {
        let mut text = String::new();
        let mut sections: Vec<&str> = Vec::new();
        for key in KEYS.iter().filter(|key| wanted(key)) {
            let section = key.name.split('.').next().unwrap_or_default();
            if !sections.contains(&section) {
                sections.push(section);
            }
        }
        for section in sections {
            let _ = writeln!(text, "[{section}]");
            for key in KEYS.iter().filter(|k| k.name.split('.').next() == Some(section) && wanted(k)) {
                let name = key.name.split('.').nth(1).unwrap_or_default();
                let value = match key.domain {
                    Domain::Word(_) => format!("\"{}\"", key.show(self)),
                    _ => key.show(self),
                };
                let _ =
                    writeln!(text, "{:<32}# {} ({})", format!("{name} = {value}"), key.doc, key.permitted());
            }
            text.push('\n');
        }
        text
    }

    /// The first lines of every text file that is made from this machine: licence, program with version,
    /// hash. Each line begins with the mark of a comment.
    #[must_use]
    pub fn stamp(&self, comment: &str) -> String {
        format!(
            "{comment} SPDX-License-Identifier: {}\n{comment} edgewalk {}, machine {}\n",
            env!("CARGO_PKG_LICENSE"),
            env!("CARGO_PKG_VERSION"),
            self.hash()
        )
    }

    /// Twelve hex digits that stand for this configuration in every picture, file and report made with it.
    #[must_use]
    pub fn hash(&self) -> String {
        let mut digest = Sha256::new();
        for key in KEYS.iter().filter(|key| key.tells(self)) {
            digest.update(format!("{}={}\n", key.name, key.show(self)));
        }
        digest.finalize().iter().take(6).map(|b| format!("{b:02x}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blend::{Blend, BlendKind};
    use crate::dither::{Dither, ScreenDoor};
    use crate::shade::{Bump, Shade, ShadeColour, ShadeKind, Texture};
    use crate::shadow::{Shadow, ShadowLight};

    const TEXTBOOK: &str = "0ee73237105a";

    #[test]
    fn what_is_written_reads_back() {
        for (name, _) in PRESETS {
            let machine = Machine::preset(name).expect("listed");
            assert_eq!(Machine::from_toml(&machine.to_toml()), Ok(machine));
        }
    }

    /// In one of these every key means something and can be set.
    fn machines() -> [Machine; 5] {
        let plain = Shade { kind: ShadeKind::Phong, colour: ShadeColour::Multiply, ..Shade::default() };
        let relief = Shade { texture: Texture::Nearest, bump: Bump::Yes, ..plain };
        let with = |extra, shade, light, kind| Machine {
            extra,
            shade,
            shadow: Shadow { light, ..Shadow::default() },
            blend: Blend { kind, ..Blend::default() },
            subpixel_bits: 0, // for textbook fill
            ..Machine::default()
        };
        [
            with(0, plain, ShadowLight::Parallel, BlendKind::Interpolated),
            with(0, plain, ShadowLight::Perspective, BlendKind::Constant),
            with(4, relief, ShadowLight::None, BlendKind::Constant),
            Machine { dither: Dither { bits: 5, screen_door: ScreenDoor::Yes }, ..Machine::default() },
            Machine::preset("bilinear").expect("listed"),
        ]
    }

    /// Machines with another value of the key that can be built.
    fn others(machine: Machine, key: &Key) -> impl Iterator<Item = Machine> {
        let values = match key.domain {
            Domain::Range(low, high) => {
                let value = (key.get)(&machine);
                vec![low, high, value.max(low + 1) - 1, value.min(high - 1) + 1]
            }
            Domain::OneOf(list) => list.to_vec(),
            // The first is often that a unit is not there, and its keys with it.
            Domain::Word(words) => (0..words.len() as u32).rev().collect(),
        };
        let set = move |value| {
            let mut other = machine.clone();
            (key.set)(&mut other, value);
            assert_eq!((key.get)(&other), value, "{}", key.name);
            (other != machine && other.plan().is_ok()).then_some(other)
        };
        values.into_iter().filter_map(set)
    }

    #[test]
    fn every_setting_survives_the_file_and_changes_the_hash() {
        let mut seen: std::collections::HashSet<String> = machines().iter().map(Machine::hash).collect();
        assert_eq!(seen.len(), 5);
        for key in KEYS {
            let used = machines().into_iter().filter(|machine| (key.used)(machine));
            let other = used.flat_map(|machine| others(machine, key)).next();
            let other = other.unwrap_or_else(|| panic!("{} means nothing anywhere", key.name));
            assert!(seen.insert(other.hash()), "{} does not reach the hash", key.name);
            assert_eq!(Machine::from_toml(&other.to_toml()), Ok(other), "{}", key.name);
        }
        assert_eq!(seen.len(), 5 + KEYS.len());
    }

    /// Keys of units that a machine has not stay out: so pictures and files of earlier days keep its name.
    #[test]
    fn units_that_are_not_there_leave_the_hash_as_it_was() {
        let hash = |name| Machine::preset(name).expect("listed").hash();
        assert_eq!((hash("default").as_str(), hash("textbook").as_str()), ("4f0c71f00838", TEXTBOOK));
        let mut machine = Machine::default();
        for (key, value) in [("shade.table_bits", "8"), ("term.walk", "memory"), ("memory.root_latency", "7")]
        {
            machine.set(key, value).expect("a key");
        }
        assert_eq!(machine.hash(), "4f0c71f00838");
        machine.set("shade.kind", "fast-phong").expect("a key");
        let shaded = machine.hash();
        machine.set("memory.root_latency", "2").expect("a key");
        assert_eq!(machine.hash(), shaded, "there are no roots");
        machine.set("memory.table_latency", "3").expect("a key");
        assert!(machine.hash() != shaded && shaded != "4f0c71f00838");
    }

    /// A sweep counts machines that differ in such keys alone as one.
    #[test]
    fn keys_without_meaning_leave_the_hash_and_are_kept_in_the_file_of_every_key() {
        let mut checked = 0;
        for machine in machines().into_iter().chain([Machine::default()]) {
            for key in KEYS.iter().filter(|key| !(key.used)(&machine)) {
                let values = match key.domain {
                    Domain::Range(low, high) => vec![low, high],
                    Domain::OneOf(list) => list.to_vec(),
                    Domain::Word(words) => (0..words.len() as u32).collect(),
                };
                for value in values {
                    let other = machine.with(|machine| (key.set)(machine, value));
                    assert_eq!(other.hash(), machine.hash(), "{} = {value}", key.name);
                    assert_eq!(Machine::read(&other.every_key_to_toml()), Ok(other), "{}", key.name);
                    checked += 1;
                }
            }
        }
        assert!(checked > 100, "{checked}");
    }

    #[test]
    fn refusals_name_place_and_remedy() {
        let cases = [
            ("[screen]\nwidht = 3\n", "line 2: unknown key screen.widht; nearest: screen.width"),
            ("[screen]\nwidth = 0\n", "line 2: screen.width = 0 is not permitted (1 to 8192); nearest: 1"),
            (
                "[setup]\nradix = 4\n",
                "line 2: unknown key setup.radix; `edgewalk config print` shows all keys",
            ),
            ("[setup]\nlanes = 3\n", "line 2: setup.lanes = 3 is not permitted (1, 2, 4); nearest: 2"),
            (
                "[edge]\nfill = \"textbok\"\n",
                "line 2: edge.fill = textbok is not permitted (exact, textbook); nearest: textbook",
            ),
            (
                "[edge]\nfill = \"textbook\"\n",
                "screen.subpixel_bits = 8 cannot be built: textbook fill takes integer vertices; try screen.subpixel_bits = 0",
            ),
            (
                "preset = \"defalt\"\n",
                "line 1: unknown preset defalt; permitted: default, textbook, polygon, bilinear, small, ecp5, hx8k, up5k; nearest: default",
            ),
            (
                "[formats]\nz_vertex = 16\n",
                "formats.z_vertex = 16 cannot be built: a vertex cannot have more fraction bits than the interpolator (14); try formats.z_vertex = 14",
            ),
            (
                "[screen]\nguard_bits = 8\n",
                "screen.guard_bits = 8 cannot be built: the screen is 640 pixels wide or high and must lie in the guard band; try screen.guard_bits = 10",
            ),
            (
                "[interpolator]\nadders = 5\n",
                "interpolator.adders = 5 cannot be built: there are only 4 channels to add; try interpolator.adders = 4",
            ),
            (
                "[channels]\nextra = 1\ne0_fraction = 2\n",
                "channels.e0_vertex = 4 cannot be built: a vertex cannot have more fraction bits than the interpolator (2); try channels.e0_vertex = 2",
            ),
            ("width = 3\n", "line 1: unknown key width; nearest: screen.width"),
            ("hazard = 3\n", "line 1: unknown key hazard; nearest: memory.hazard"),
            ("[edge]\nfill = \"foo\"\n", "line 2: edge.fill = foo is not permitted (exact, textbook)"),
        ];
        for (text, message) in cases {
            assert_eq!(Machine::from_toml(text).expect_err(text).to_string(), message);
        }
        assert!(Machine::from_toml("[screen\n").expect_err("no TOML").to_string().starts_with("line 1: "));
    }
}
