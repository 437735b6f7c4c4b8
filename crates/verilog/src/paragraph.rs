//! The lines of a module's body: declarations in paragraphs with their comments aligned, blocks with a blank line around.

/// Longest line without its comment.
pub(crate) const LINE: usize = 100;

/// The text of a module's body while it grows; every line is indented by two spaces.
#[derive(Default)]
pub(crate) struct Body {
    text: String,
    /// Statement and comment of the lines of the open paragraph.
    open: Vec<(String, String)>,
    /// The head of a section of which nothing has been written yet.
    head: String,
}

impl Body {
    /// A declaration or assignment with its doc; a statement may have several lines.
    pub fn line(&mut self, statement: String, comment: &str) {
        self.open.push((statement, comment.to_string()));
    }

    /// A comment that begins a section; left out if the section stays empty.
    pub fn section(&mut self, text: &str) {
        self.gap();
        self.head = text.lines().map(|line| format!("{}\n", format!("  // {line}").trim_end())).collect();
    }

    /// Lines that stand together and alone.
    pub fn block(&mut self, lines: &[String]) {
        self.gap();
        self.text.push_str(&std::mem::take(&mut self.head));
        for line in lines {
            self.text.push_str(&format!("  {line}\n"));
        }
        self.text.push('\n');
    }

    /// Ends the paragraph.
    pub fn gap(&mut self) {
        if self.open.is_empty() {
            return;
        }
        self.text.push_str(&std::mem::take(&mut self.head));
        let width = |statement: &str| statement.lines().next().map_or(0, |line| line.chars().count());
        let with_comment = self.open.iter().filter(|(_, comment)| !comment.is_empty());
        let column = with_comment.map(|(statement, _)| width(statement)).filter(|w| *w < LINE / 2).max();
        for (statement, comment) in self.open.drain(..) {
            // The comment stands on the first line.
            let (first, rest) = statement.split_once('\n').unwrap_or((&statement, ""));
            let mut text = format!("  {first}");
            if !comment.is_empty() {
                let fill = column.unwrap_or(0).saturating_sub(width(&statement));
                text.push_str(&format!("{:fill$}  // {}", "", comment.replace('\n', " ")));
            }
            text.push('\n');
            rest.lines().for_each(|line| text.push_str(&format!("  {line}\n")));
            self.text.push_str(&text);
        }
        self.text.push('\n');
    }

    /// The whole body, without blank lines at its end.
    pub fn finish(mut self) -> String {
        self.gap();
        self.text.truncate(self.text.trim_end().len());
        self.text
    }
}

/// Statements with their comments, if they have one, in a column behind them.
pub(crate) fn commented(rows: &[(String, String)]) -> Vec<String> {
    let width = rows.iter().map(|(statement, _)| statement.chars().count()).max().unwrap_or(0);
    let line = |(statement, comment): &(String, String)| match comment.is_empty() {
        true => statement.clone(),
        false => format!("{statement:width$}  // {comment}"),
    };
    rows.iter().map(line).collect()
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
