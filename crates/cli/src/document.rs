//! JSON documents of the program: each says first which format it has, and which version of it.

use anyhow::Result;
use serde::Serialize;

/// Version of the format `edgewalk-WHAT`. Its first number changes when a key goes or means something else, its second when a key is
/// new.
fn version(what: &str) -> [u32; 2] {
    match what {
        "estimate" | "size" | "compare" => [1, 1],
        "report" | "explain" | "judge" | "energy" | "sweep" => [1, 2],
        "features" | "keys" => [1, 3],
        _ => [1, 0],
    }
}

#[derive(Serialize)]
struct Document<R> {
    format: String,
    version: [u32; 2],
    #[serde(flatten)]
    report: R,
}

fn of<R: Serialize>(what: &str, report: R) -> Document<R> {
    Document { format: format!("edgewalk-{what}"), version: version(what), report }
}

/// `report`, whose JSON is an object, as a document of the format `edgewalk-WHAT`.
pub fn document(what: &str, report: impl Serialize) -> Result<String> {
    Ok(serde_json::to_string_pretty(&of(what, report))? + "\n")
}

/// Like [`document`], in one line.
pub fn line(what: &str, report: impl Serialize) -> Result<String> {
    Ok(serde_json::to_string(&of(what, report))?)
}
