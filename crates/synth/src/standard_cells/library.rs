//! The library of standard cells: OSU's for 0.18 um, as Debian packages it.

use edgewalk_tool::Stop;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Where the Debian package puts the library.
pub const LIBRARY: &str = "/usr/share/qflow/tech/osu018/osu018_stdcells.lib";
/// What installs it.
const INSTALL: &str = "apt-get install -y --no-install-recommends qflow-tech-osu018";

/// The flip-flop onto which every register is mapped.
pub(super) const FLIP_FLOP: &str = "DFFPOSX1";
/// Areas are told in multiples of this cell's (gate equivalents).
const GATE: &str = "NAND2X1";
/// What the tools are told of the world outside: it drives inputs with this cell, and outputs have this load, pF.
pub(super) const CONSTRAINTS: &str = "set_driving_cell INVX2\nset_load 0.05\n";

/// A library of cells in the Liberty format.
#[derive(Clone, Debug)]
pub struct Library {
    pub(super) path: PathBuf,
    /// SHA-256 of its text.
    pub(super) hash: String,
    /// Area of each cell, um2.
    areas: BTreeMap<String, f64>,
}

impl Library {
    /// Reads the file.
    ///
    /// # Errors
    /// It is not there, or lacks the areas of the cells that every design takes.
    pub fn read(path: &Path) -> Result<Library, Stop> {
        let tool = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => Stop::Missing { tool: tool.clone(), install: INSTALL.to_owned() },
            _ => Stop::broken(&tool, &error),
        })?;
        let areas = areas(&text);
        for cell in [GATE, FLIP_FLOP] {
            if !areas.contains_key(cell) {
                let lines = vec![format!("the library has no area of a cell {cell}")];
                return Err(Stop::Broken { tool, lines });
            }
        }
        let hash = Sha256::digest(&text).iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Library { path: path.to_owned(), hash, areas })
    }

    /// Area of a cell, um2.
    pub(super) fn area(&self, cell: &str) -> Option<f64> {
        self.areas.get(cell).copied()
    }

    /// Area of one gate equivalent, um2.
    pub(super) fn gate(&self) -> f64 {
        self.areas[GATE] // there: `read` has looked
    }
}

/// The area of each cell of a Liberty text: the first `area` behind each `cell (NAME)`.
fn areas(text: &str) -> BTreeMap<String, f64> {
    let mut areas = BTreeMap::new();
    let mut cell: Option<&str> = None;
    for line in text.lines().map(str::trim) {
        if let Some(rest) = line.strip_prefix("cell") {
            let name = rest.trim_start().strip_prefix('(').and_then(|rest| rest.split_once(')'));
            cell = name.map(|(name, _)| name.trim().trim_matches('"')).or(cell);
        } else if let Some(value) =
            line.strip_prefix("area").and_then(|rest| rest.trim_start().strip_prefix(':'))
        {
            let number = value.trim().trim_end_matches(';').trim().parse();
            if let (Some(name), Ok(area)) = (cell.take(), number) {
                areas.insert(name.to_owned(), area);
            }
        }
    }
    areas
}

#[cfg(test)]
mod tests {
    use super::areas;

    #[test]
    fn areas_are_those_of_their_cells() {
        let text = "library(l) {\n  cell_rise(x) { area : 7; }\n  cell (A) {\n    area : 24;\n    pin(Y) { area : 9; }\n  }\n\
                    cell(\"B\") {\narea:96.5 ;\n}\ncell (C) {\n}\n}";
        let found: Vec<_> = areas(text).into_iter().collect();
        assert_eq!(found, [("A".to_owned(), 24.0), ("B".to_owned(), 96.5)]);
    }
}
