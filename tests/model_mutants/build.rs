//! Copies the model's source once for every fault, with that one text replaced, each copy a module of its own.

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

include!("src/list.rs");

fn main() -> Result<(), Box<dyn Error>> {
    let model = Path::new("../../crates/model/src");
    println!("cargo::rerun-if-changed={}", model.display());
    println!("cargo::rerun-if-changed=src/list.rs");
    let out = std::path::PathBuf::from(std::env::var("OUT_DIR")?);
    let mut modules = String::from("type Draw = fn(&Plan, &[Triangle], Setting) -> Seen;\n");
    let mut table = String::new();
    for (i, mutant) in MUTANTS.iter().enumerate() {
        let folder = out.join(format!("m{i}"));
        let found = copy(model, model, &folder, mutant, &format!("crate::models::m{i}::"))?;
        if found != 1 {
            return Err(
                format!("{}: {} has `{}` {found} times, not once", mutant.0, mutant.1, mutant.2).into()
            );
        }
        writeln!(modules, "#[path = {:?}]\nmod m{i};", folder.join("lib.rs"))?;
        writeln!(table, "    draw!(m{i}),")?;
    }
    writeln!(modules, "const DRAW: [Draw; {}] = [\n{table}];", MUTANTS.len())?;
    std::fs::write(out.join("models.rs"), modules)?;
    Ok(())
}

/// How often the text to be replaced stands in its file.
fn copy(from: &Path, root: &Path, to: &Path, mutant: &Mutant, module: &str) -> Result<usize, Box<dyn Error>> {
    let (_, file, old, new) = *mutant;
    std::fs::create_dir_all(to)?;
    let mut found = 0;
    for entry in std::fs::read_dir(from)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default();
        if path.is_dir() {
            // The fast path is another text with the same meaning, compared with this one in the model's own tests.
            if name != "fast" {
                found += copy(&path, root, &to.join(name), mutant, module)?;
            }
            continue;
        }
        let mut text = std::fs::read_to_string(&path)?;
        if path.strip_prefix(root)? == Path::new(file) {
            found = if old.is_empty() { 1 } else { text.matches(old).count() };
            text = if old.is_empty() { text } else { text.replace(old, new) };
        }
        text = text.replace("crate::", module).replace("pub mod fast;\n", "");
        text = text.replace("#[macro_export]\n", ""); // a copy's macro is its own
        std::fs::write(to.join(name), text)?;
    }
    Ok(found)
}
