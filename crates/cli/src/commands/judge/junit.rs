//! The verdict as a JUnit document: a test case for each cause.

use edgewalk_judge::outside::Judgement;

/// The document; what comes from the command line is escaped.
pub fn document(input: &str, judgement: &Judgement) -> String {
    let wrong = judgement.causes.iter().filter(|count| count.wrong);
    let failures = wrong.clone().filter(|count| count.pixels > 0).count();
    let mut t = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"{}\" tests=\"{}\" failures=\"{failures}\">\n",
        escaped(&format!("edgewalk judge {input}")),
        wrong.clone().count()
    );
    for count in wrong {
        let name = count.cause.text();
        t += &match count.pixels {
            0 => format!("  <testcase classname=\"edgewalk.judge\" name=\"{name}\"/>\n"),
            pixels => format!(
                "  <testcase classname=\"edgewalk.judge\" name=\"{name}\">\n    <failure message=\"{pixels} pixels\">{}</failure>\n  </testcase>\n",
                escaped(&judgement.lines_of(count.cause))
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
