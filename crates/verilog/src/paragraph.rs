//! The lines of a module's body: declarations in paragraphs with their comments aligned, blocks with a blank line around.

/// Longest line without its comment.
pub(crate) const LINE: usize = 100;

/// The text of a module's body while it grows; every line is indented by two spaces.
#[derive(Default)]
pub(crate) struct Body {
    text: String,
    /// Statement and comment of the lines of the open paragraph.
    open: Vec<(String, String)>,
}

impl Body {
    /// A declaration or assignment with its doc; a statement may have several lines.
    pub fn line(&mut self, statement: String, comment: &str) {
        self.open.push((statement, comment.to_string()));
    }

    /// A comment that begins a section.
    pub fn section(&mut self, text: &str) {
        self.gap();
        for line in text.lines() {
            self.text.push_str(format!("  // {line}").trim_end());
            self.text.push('\n');
        }
    }

    /// Lines that stand together and alone.
    pub fn block(&mut self, lines: &[String]) {
        self.gap();
        for line in lines {
            self.text.push_str(&format!("  {line}\n"));
        }
        self.text.push('\n');
    }

    /// Ends the paragraph.
    pub fn gap(&mut self) {
        let width = |statement: &str| statement.lines().last().map_or(0, |line| line.chars().count());
        let with_comment = self.open.iter().filter(|(_, comment)| !comment.is_empty());
        let column = with_comment.map(|(statement, _)| width(statement)).filter(|w| *w < LINE / 2).max();
        for (statement, comment) in self.open.drain(..) {
            let mut text = statement.replace('\n', "\n  ");
            if !comment.is_empty() {
                let fill = column.unwrap_or(0).saturating_sub(width(&statement));
                text.push_str(&format!("{:fill$}  // {}", "", comment.replace('\n', " ")));
            }
            self.text.push_str(&format!("  {text}\n"));
        }
        if !self.text.is_empty() && !self.text.ends_with("\n\n") {
            self.text.push('\n');
        }
    }

    /// The whole body, without blank lines at its end.
    pub fn finish(mut self) -> String {
        self.gap();
        self.text.truncate(self.text.trim_end().len());
        self.text
    }
}

/// Lines of two columns, `.name (value)`, the second aligned, with commas between.
pub(crate) fn columns(rows: &[(String, String)]) -> Vec<String> {
    let width = rows.iter().map(|(left, _)| left.chars().count()).max().unwrap_or(0);
    let last = rows.len().saturating_sub(1);
    let line = |(index, (left, right)): (usize, &(String, String))| {
        format!("{left:width$}{right}{}", if index < last { "," } else { "" })
    };
    rows.iter().enumerate().map(line).collect()
}
