//! Tables of energy, as the Liberty format has them: by the load of an output and the transition time of an input.

use super::liberty::{Group, Wrong, cut};

/// A table of values over a load and a transition time, both in the library's units.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Table {
    /// Loads of the rows; one if the load does not count.
    loads: Vec<f64>,
    /// Transition times of the columns; one if the transition time does not count.
    slews: Vec<f64>,
    /// Row by row.
    values: Vec<f64>,
}

/// What a table's axis is.
#[derive(Clone, Copy, PartialEq)]
enum Axis {
    Load,
    Slew,
}

impl Table {
    /// Reads `rise_power (TEMPLATE) { ... }`; the template says what the axes are.
    pub fn read(of: &Group, library: &Group) -> Result<Table, Wrong> {
        let wrong = |line: usize, what: String| Wrong { line, what };
        let template = library.of("power_lut_template").find(|template| template.name() == of.name());
        let mut axes = Vec::new();
        for (variable, index) in [("variable_1", "index_1"), ("variable_2", "index_2")] {
            let Some((name, line)) = template.and_then(|template| template.value(variable)) else { continue };
            let axis = match name {
                "total_output_net_capacitance" => Axis::Load,
                "input_transition_time" | "input_net_transition" => Axis::Slew,
                other => {
                    let what = format!(
                        "found {variable} `{}`; permitted: total_output_net_capacitance, input_transition_time",
                        cut(other)
                    );
                    return Err(wrong(line, what));
                }
            };
            let list = of.list(index).or_else(|| template.and_then(|template| template.list(index)));
            let (parts, line) =
                list.ok_or_else(|| wrong(of.line, format!("`{}` has no {index}", cut(&of.kind))))?;
            let steps = numbers(parts, line)?;
            if steps.is_empty() || steps.windows(2).any(|pair| pair[0] >= pair[1]) {
                return Err(wrong(
                    line,
                    format!("the numbers of {index} do not rise; each is above the last"),
                ));
            }
            axes.push((axis, steps));
        }
        let (parts, line) =
            of.list("values").ok_or_else(|| wrong(of.line, format!("`{}` has no values", cut(&of.kind))))?;
        let values = numbers(parts, line)?;
        let expected: usize = axes.iter().map(|(_, steps)| steps.len()).product();
        if values.len() != expected {
            return Err(wrong(line, format!("found {} values; needed: {expected}", values.len())));
        }
        let steps = |axis| axes.iter().find(|(of, _)| *of == axis).map(|(_, steps)| steps.clone());
        let (loads, slews) = (steps(Axis::Load), steps(Axis::Slew));
        // The first axis is that of the rows.
        let turned = matches!(&axes[..], [(Axis::Slew, _), (Axis::Load, _)]);
        let (loads, slews) = (loads.unwrap_or_else(|| vec![0.0]), slews.unwrap_or_else(|| vec![0.0]));
        let values = match turned {
            false => values,
            true => (0..values.len())
                .map(|at| values[at % slews.len() * loads.len() + at / slews.len()])
                .collect(),
        };
        Ok(Table { loads, slews, values })
    }

    /// The value at that load and transition time: between four values of the table, or beyond its edge on the same planes.
    pub fn at(&self, load: f64, slew: f64) -> f64 {
        let (row, down) = place(&self.loads, load);
        let (column, right) = place(&self.slews, slew);
        let value = |row: usize, column: usize| self.values[row * self.slews.len() + column];
        let along = |row: usize| {
            let (left, more) = (value(row, column), (column + 1).min(self.slews.len() - 1));
            left + right * (value(row, more) - left)
        };
        let upper = along(row);
        upper + down * (along((row + 1).min(self.loads.len() - 1)) - upper)
    }
}

/// The step of an axis at or before `at`, and how far `at` is on the way to the next one.
fn place(steps: &[f64], at: f64) -> (usize, f64) {
    if steps.len() < 2 {
        return (0, 0.0);
    }
    let step = steps.partition_point(|step| *step <= at).clamp(1, steps.len() - 1) - 1;
    (step, (at - steps[step]) / (steps[step + 1] - steps[step]))
}

/// Numbers with commas or space between them, over several texts.
fn numbers(parts: &[String], line: usize) -> Result<Vec<f64>, Wrong> {
    let words = parts.iter().flat_map(|part| part.split(|c: char| c == ',' || c.is_whitespace()));
    let number = |word: &str| {
        let found = word.parse().ok().filter(|number: &f64| number.is_finite());
        found.ok_or_else(|| Wrong { line, what: format!("found `{}`; a number is needed", cut(word)) })
    };
    words.filter(|word| !word.is_empty()).map(number).collect()
}

#[cfg(test)]
mod tests {
    use super::super::liberty::parse;
    use super::Table;

    /// A library whose only table has these axes and this text.
    fn read(variables: [&str; 2], text: &str) -> Result<Table, String> {
        let [one, two] = variables;
        let library = format!(
            "library (l) {{ power_lut_template (t) {{ variable_1 : {one}; variable_2 : {two};
            index_1 (\"1, 2\"); index_2 (\"1, 3, 4\"); }} power_lut_template (scalar) {{ }} {text} }}"
        );
        let library = parse(&library).map_err(|wrong| wrong.what)?;
        let table = library.of("rise_power").next().expect("a table");
        Table::read(table, &library).map_err(|wrong| wrong.what)
    }

    const LOAD: &str = "total_output_net_capacitance";
    const SLEW: &str = "input_transition_time";

    #[test]
    fn values_between_and_beyond_lie_on_planes() {
        // 10 load + slew + load slew at the corners.
        let rows = "rise_power (t) { values (\"12, 16, 18\", \"23, 29, 32\"); }";
        let columns = "rise_power (t) { values (\"12, 23\", \"16, 29\", \"18, 32\"); index_1 (\"1, 3, 4\"); \
                       index_2 (\"1, 2\"); }";
        for table in [read([LOAD, SLEW], rows), read([SLEW, LOAD], columns)] {
            let table = table.expect("a table");
            for (load, slew) in [(1.0, 1.0), (2.0, 4.0), (1.5, 2.0), (1.25, 3.5), (0.0, 0.0), (3.0, 9.0)] {
                let expected = 10.0 * load + slew + load * slew;
                let found = table.at(load, slew);
                assert!((found - expected).abs() < 1e-12, "{load} {slew}: {found}, not {expected}");
            }
        }
        let scalar = read([LOAD, SLEW], "rise_power (scalar) { values (\"0.5\"); }").expect("a table");
        assert_eq!(scalar.at(7.0, 7.0), 0.5);
    }

    #[test]
    fn wrong_tables_are_refused() {
        for (text, why) in [
            ("rise_power (t) { values (\"1, 2, 3\"); }", "found 3 values; needed: 6"),
            ("rise_power (t) { }", "`rise_power` has no values"),
            ("rise_power (t) { values (\"1, 2, x, 4, 5, 6\"); }", "found `x`; a number is needed"),
            ("rise_power (t) { index_1 (\"2, 2\"); values (\"1\"); }", "the numbers of index_1 do not rise"),
        ] {
            let error = read([LOAD, SLEW], text).expect_err(text);
            assert!(error.starts_with(why), "{error}");
        }
        let error = read(["height", SLEW], "rise_power (t) { values (\"1\"); }").expect_err("an axis");
        assert!(error.starts_with("found variable_1 `height`; permitted: total_output"), "{error}");
    }
}
