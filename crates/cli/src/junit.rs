//! Results as a JUnit document, for servers that show tests.

/// A test and how it ended.
pub struct Case {
    /// Name of the test.
    pub name: String,
    /// Where it failed: a line, and what was found.
    pub failure: Option<(String, String)>,
}

/// The document of a suite; `class` is that of all its cases. Texts are escaped.
pub fn document(suite: &str, class: &str, cases: &[Case]) -> String {
    let failures = cases.iter().filter(|case| case.failure.is_some()).count();
    let mut t = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" failures=\"{failures}\">\n",
        escaped(suite),
        cases.len()
    );
    for Case { name, failure } in cases {
        let name = escaped(name);
        t += &match failure {
            None => format!("  <testcase classname=\"{class}\" name=\"{name}\"/>\n"),
            Some((line, found)) => format!(
                "  <testcase classname=\"{class}\" name=\"{name}\">\n    <failure message=\"{}\">{}</failure>\n  </testcase>\n",
                escaped(line),
                escaped(found)
            ),
        };
    }
    t + "</testsuite>\n"
}

/// Text as XML shows it; control characters, which XML cannot hold, become blanks.
fn escaped(text: &str) -> String {
    let of = |letter: char| match letter {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '>' => "&gt;".to_owned(),
        '"' => "&quot;".to_owned(),
        c if c.is_control() && c != '\n' => " ".to_owned(),
        c => c.to_string(),
    };
    text.chars().map(of).collect()
}
