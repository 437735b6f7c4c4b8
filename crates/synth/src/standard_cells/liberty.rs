//! The Liberty format: groups `KIND (NAME) { ... }` with values `KEY : VALUE ;` and lists `KEY (A, B);`, as text with line
//! numbers.

/// A group, e.g. `pin (A) { ... }`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Group {
    /// `library`, `cell`, `pin`, `ff`.
    pub kind: String,
    /// What stands in its parentheses, part by part, without quotes.
    pub names: Vec<String>,
    /// The line of its kind, counted from 1.
    pub line: usize,
    /// Values by key, with their lines, without quotes.
    values: Vec<(String, String, usize)>,
    /// Lists by key, part by part, with their lines, without quotes.
    lists: Vec<(String, Vec<String>, usize)>,
    /// The groups within.
    pub groups: Vec<Group>,
}

impl Group {
    /// The first value of that key, and its line.
    pub fn value(&self, key: &str) -> Option<(&str, usize)> {
        let found = self.values.iter().find(|(name, ..)| name == key);
        found.map(|(_, value, line)| (&**value, *line))
    }

    /// The first list of that key, and its line.
    pub fn list(&self, key: &str) -> Option<(&[String], usize)> {
        let found = self.lists.iter().find(|(name, ..)| name == key);
        found.map(|(_, parts, line)| (&**parts, *line))
    }

    /// The group's first name; empty if it has none.
    pub fn name(&self) -> &str {
        self.names.first().map_or("", String::as_str)
    }

    /// The groups of that kind within.
    pub fn of<'g>(&'g self, kind: &'g str) -> impl Iterator<Item = &'g Group> {
        self.groups.iter().filter(move |group| group.kind == kind)
    }
}

/// Something that the format does not permit.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Wrong {
    /// Line, counted from 1.
    pub line: usize,
    /// The fault, then the remedy.
    pub what: String,
}

/// Groups lie within groups so deep at most: cells, pins, timing and power are four deep.
const DEPTH: usize = 32;

/// Reads a whole library.
pub(super) fn parse(text: &str) -> Result<Group, Wrong> {
    let mut words = Words { rest: text, line: 1 };
    let mut open: Vec<Group> = Vec::new();
    loop {
        let (word, line) = words.next()?;
        match word {
            Word::Name(kind) => {
                if open.is_empty() && kind != "library" {
                    let what = format!("found `{}`; a Liberty file begins with library (NAME) {{", cut(kind));
                    return Err(Wrong { line, what });
                }
                let Some(group) = open.last_mut() else {
                    open.push(words.group(kind, line)?);
                    continue;
                };
                match words.next()? {
                    (Word::Mark(':'), _) => group.values.push((kind.to_owned(), words.value(line)?, line)),
                    (Word::Mark('('), _) => {
                        let names = words.names(kind, line)?;
                        if words.taken('{')? {
                            if open.len() == DEPTH {
                                let what = format!("groups are nested deeper than {DEPTH}");
                                return Err(Wrong { line, what });
                            }
                            open.push(Group { kind: kind.to_owned(), names, line, ..Group::default() });
                        } else {
                            group.lists.push((kind.to_owned(), names, line));
                        }
                    }
                    (other, line) => {
                        let what =
                            format!("found {} behind `{}`; permitted: `:` or `(`", other.shown(), cut(kind));
                        return Err(Wrong { line, what });
                    }
                }
            }
            Word::Mark('}') if !open.is_empty() => {
                // Just seen that there is one.
                let Some(group) = open.pop() else { continue };
                match open.last_mut() {
                    Some(around) => around.groups.push(group),
                    None => return words.end(group),
                }
            }
            Word::Mark(';') if !open.is_empty() => {}
            Word::End => return Err(unclosed(open.last(), line)),
            other => {
                let what = match open.is_empty() {
                    true => format!("found {}; a Liberty file begins with library (NAME) {{", other.shown()),
                    false => {
                        format!("found {}; permitted: a key, the kind of a group, or `}}`", other.shown())
                    }
                };
                return Err(Wrong { line, what });
            }
        }
    }
}

/// The text ends before the group does.
fn unclosed(group: Option<&Group>, line: usize) -> Wrong {
    let what = match group {
        Some(of) => {
            format!(
                "the text ends within `{} ({})` of line {}; a `}}` is needed",
                of.kind,
                of.name(),
                of.line
            )
        }
        None => "the text is empty; a Liberty file begins with library (NAME) {".to_owned(),
    };
    Wrong { line, what }
}

/// A word of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Word<'t> {
    Name(&'t str),
    /// What stands between quotes.
    Quoted(&'t str),
    /// One of [`MARKS`].
    Mark(char),
    End,
}

/// Characters that are words of their own.
const MARKS: [char; 7] = ['(', ')', '{', '}', ':', ';', ','];

impl Word<'_> {
    fn shown(&self) -> String {
        match self {
            Word::Name(text) => format!("`{}`", cut(text)),
            Word::Quoted(text) => format!("`\"{}\"`", cut(text)),
            Word::Mark(mark) => format!("`{mark}`"),
            Word::End => "the end of the text".to_owned(),
        }
    }
}

/// What stands in an error is cut to a readable length, and escaped.
pub(super) fn cut(text: &str) -> String {
    const SHOWN: usize = 40;
    let short: String = text.chars().take(SHOWN).flat_map(char::escape_default).collect();
    if text.chars().nth(SHOWN).is_some() { short + "..." } else { short }
}

/// The text, word by word.
struct Words<'t> {
    rest: &'t str,
    line: usize,
}

impl<'t> Words<'t> {
    /// Goes on by so many bytes.
    fn skip(&mut self, bytes: usize) -> &'t str {
        let (skipped, rest) = self.rest.split_at(bytes);
        self.line += skipped.matches('\n').count();
        self.rest = rest;
        skipped
    }

    /// Goes beyond space, comments, and the `\` at the end of a line that goes on.
    fn blank(&mut self) -> Result<(), Wrong> {
        loop {
            let space = self.rest.len() - self.rest.trim_start().len();
            self.skip(space);
            if self.rest.starts_with("/*") {
                let Some(end) = self.rest.find("*/") else {
                    let what = "the comment does not end; `*/` is needed".to_owned();
                    return Err(Wrong { line: self.line, what });
                };
                self.skip(end + 2);
            } else if self.rest.starts_with("//") {
                let end = self.rest.find('\n').unwrap_or(self.rest.len());
                self.skip(end);
            } else if self.rest.starts_with("\\\n") || self.rest.starts_with("\\\r\n") {
                self.skip(1);
            } else {
                return Ok(());
            }
        }
    }

    /// The next word, and its line.
    fn next(&mut self) -> Result<(Word<'t>, usize), Wrong> {
        self.blank()?;
        let line = self.line;
        let Some(first) = self.rest.chars().next() else { return Ok((Word::End, line)) };
        if MARKS.contains(&first) {
            self.skip(first.len_utf8());
            return Ok((Word::Mark(first), line));
        }
        if first == '"' {
            let mut escaped = false;
            let end = self.rest.char_indices().skip(1).find(|&(_, c)| {
                let ends = c == '"' && !escaped;
                escaped = c == '\\' && !escaped;
                ends
            });
            let Some((end, _)) = end else {
                let what = "the text in quotes does not end; `\"` is needed".to_owned();
                return Err(Wrong { line, what });
            };
            let quoted = self.skip(end + 1);
            return Ok((Word::Quoted(&quoted[1..end]), line));
        }
        let ends = |c: char| c.is_whitespace() || c == '"' || MARKS.contains(&c);
        let end = self.rest.find(ends).unwrap_or(self.rest.len());
        let end = self.rest[..end].find("/*").unwrap_or(end);
        Ok((Word::Name(self.skip(end)), line))
    }

    /// Takes the next word if it is that mark.
    fn taken(&mut self, mark: char) -> Result<bool, Wrong> {
        self.blank()?;
        let there = self.rest.starts_with(mark);
        self.skip(if there { mark.len_utf8() } else { 0 });
        Ok(there)
    }

    /// `(NAMES) {` behind the kind of the outermost group.
    fn group(&mut self, kind: &str, line: usize) -> Result<Group, Wrong> {
        if self.taken('(')? {
            let names = self.names(kind, line)?;
            if self.taken('{')? {
                return Ok(Group { kind: kind.to_owned(), names, line, ..Group::default() });
            }
        }
        let (found, line) = self.next()?;
        Err(Wrong { line, what: format!("found {}; needed: library (NAME) {{", found.shown()) })
    }

    /// What stands between parentheses, part by part; the first one is taken.
    fn names(&mut self, kind: &str, line: usize) -> Result<Vec<String>, Wrong> {
        let mut names = vec![String::new()];
        loop {
            match self.next()? {
                (Word::Mark(')'), _) => break,
                (Word::Mark(','), _) => names.push(String::new()),
                (Word::Name(text) | Word::Quoted(text), _) => {
                    names.last_mut().into_iter().for_each(|last| last.push_str(text));
                }
                (Word::Mark(':'), _) => names.last_mut().into_iter().for_each(|last| last.push(':')),
                (other, at) => {
                    let what = format!(
                        "found {} within the parentheses of `{}` of line {line}; a `)` is needed",
                        other.shown(),
                        cut(kind)
                    );
                    return Err(Wrong { line: at, what });
                }
            }
        }
        Ok(if names == [""] { Vec::new() } else { names })
    }

    /// What stands behind `KEY :` on the line of that key. The `;` may lack at the end of the line.
    fn value(&mut self, line: usize) -> Result<String, Wrong> {
        let mut value = String::new();
        loop {
            let before = Words { ..*self };
            match self.next()? {
                (Word::Mark(';'), _) => return Ok(value),
                (Word::Mark('}') | Word::End, _) => {
                    *self = before;
                    return Ok(value);
                }
                (_, at) if at > line && !value.is_empty() => {
                    *self = before;
                    return Ok(value);
                }
                (Word::Name(text) | Word::Quoted(text), _) => {
                    value = if value.is_empty() { text.to_owned() } else { value + " " + text };
                }
                (Word::Mark(mark), _) => value.push(mark),
            }
        }
    }

    /// Nothing may stand behind the library.
    fn end(mut self, library: Group) -> Result<Group, Wrong> {
        match self.next()? {
            (Word::End, _) => Ok(library),
            (found, line) => {
                Err(Wrong { line, what: format!("found {} behind the end of the library", found.shown()) })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_have_names_values_and_lines() {
        let text = "/* a\n comment */ library (\"l\") {\n  time_unit : \"1ns\"; // to the end { of the line\n\
                    capacitive_load_unit (1, pf);\n cell(A) {\n  area : 24\n  pin(B[3:0]) { x : VDD + 0.5; } ff (I, \\\n N) { }\n}}\n";
        let library = parse(text).expect("a library");
        assert_eq!((library.name(), library.line), ("l", 2));
        assert_eq!(library.value("time_unit"), Some(("1ns", 3)));
        let cell = library.of("cell").next().expect("a cell");
        assert_eq!((cell.name(), cell.value("area")), ("A", Some(("24", 6))));
        let pin = cell.of("pin").next().expect("a pin");
        assert_eq!((pin.name(), pin.value("x"), pin.line), ("B[3:0]", Some(("VDD + 0.5", 7)), 7));
        assert_eq!(cell.of("ff").next().expect("registers").names, ["I", "N"]);
        let list = library.list("capacitive_load_unit").expect("a list");
        assert_eq!((list.0, list.1), (&["1".to_owned(), "pf".to_owned()][..], 4));
    }

    #[test]
    fn whatever_is_cut_off_is_an_error() {
        let text = "library (l) { cell (A) { area : 24; pin (Y) { function : \"(!A)\"; } /* c */ } }";
        for end in 0..text.len() {
            assert!(parse(&text[..end]).is_err(), "{}", &text[..end]);
        }
        let deep = "library (l) {".to_owned() + &"a (b) {".repeat(100_000);
        assert!(parse(&deep).is_err_and(|wrong| wrong.what.contains("deeper")));
    }
}
