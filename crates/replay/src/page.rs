//! The page: one HTML file with all it needs in it.

use serde_json::Value;

const HTML: &str = include_str!("../page/page.html");
const CSS: &str = include_str!("../page/page.css");
/// In the order in which they call each other.
const SCRIPTS: [&str; 9] = [
    include_str!("../page/decode.js"),
    include_str!("../page/show.js"),
    include_str!("../page/cells.js"),
    include_str!("../page/strip.js"),
    include_str!("../page/cards.js"),
    include_str!("../page/planes.js"),
    include_str!("../page/tell.js"),
    include_str!("../page/lesson.js"),
    include_str!("../page/main.js"),
];

/// The page with a replay in it.
#[must_use]
pub fn html(replay: &Value) -> String {
    // `</script` would end the element and `<!--` hide its end; in JSON a `<` stands in strings alone.
    let data = replay.to_string().replace('<', "\\u003c");
    source().replace("{{data}}", &data)
}

/// The page without a replay.
#[must_use]
pub fn source() -> String {
    HTML.replace("{{css}}", CSS).replace("{{script}}", &SCRIPTS.concat())
}
