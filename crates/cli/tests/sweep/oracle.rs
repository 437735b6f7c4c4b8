//! What a sweep should say, worked out once more from its rows alone.

use serde_json::Value;
use std::collections::BTreeMap;

/// A column of the table, and where a row has it.
pub fn pointer(column: &str) -> Option<String> {
    let own = [
        "key",
        "status",
        "reason",
        "input",
        "input_hash",
        "shading",
        "machine",
        "stalls",
        "version",
        "verdict",
        "seconds",
    ];
    let report = BTreeMap::from([
        ("cycles", "cycles/total"),
        ("path", "cycles/path"),
        ("pixels_per_clock", "cycles/pixels_per_clock"),
        ("triangles", "triangles"),
        ("fragments", "fragments"),
        ("writes", "writes"),
        ("bytes", "traffic/bytes"),
        ("bytes_per_cycle", "traffic/bytes_per_cycle"),
        ("setup_mean", "setup/clocks/mean"),
        ("setup_p95", "setup/clocks/p95"),
        ("setup_most", "setup/clocks/most"),
        ("span_fifo", "occupancy/span_fifo/mean"),
        ("inflight", "occupancy/inflight/mean"),
        ("lanes", "occupancy/lanes/mean"),
        ("covered", "comparison/covered"),
        ("coverage_mismatches", "comparison/coverage_mismatches"),
        ("order_undecided", "comparison/order_undecided"),
        ("order_wrong", "comparison/order_wrong"),
        ("wrapped", "comparison/wrapped"),
        ("additions", "comparison/additions"),
        ("z_error", "comparison/z_error"),
        ("z_bound", "comparison/z_bound"),
        ("z_bound_for_input", "comparison/z_bound_for_input"),
        ("z_mean", "comparison/z_spread/mean"),
        ("z_p99", "comparison/z_spread/p99"),
        ("z_bias", "comparison/z_spread/bias"),
        ("color_error", "comparison/color_error"),
        ("color_bound", "comparison/color_bound"),
        ("color_bound_for_input", "comparison/color_bound_for_input"),
        ("color_mean", "comparison/color_spread/mean"),
        ("color_p99", "comparison/color_spread/p99"),
        ("color_bias", "comparison/color_spread/bias"),
    ]);
    let rest = BTreeMap::from([
        ("z_slack", "/slack/z"),
        ("color_slack", "/slack/color"),
        ("shading_error", "/equation/largest"),
        ("shading_mean", "/equation/mean"),
        ("lut4", "/synth/cells/lut4"),
        ("carry", "/synth/cells/carry"),
        ("ff", "/synth/cells/ff"),
        ("ram", "/synth/cells/ram"),
        ("dsp", "/synth/cells/dsp"),
        ("est_lut4", "/estimate/est_lut4/value"),
        ("est_lut4_error", "/estimate/est_lut4/error"),
        ("est_cells", "/estimate/est_cells/value"),
        ("est_cells_error", "/estimate/est_cells/error"),
        ("est_mhz", "/estimate/est_mhz/value"),
        ("est_mhz_error", "/estimate/est_mhz/error"),
        ("est_carry", "/estimate/est_carry"),
        ("est_ff", "/estimate/est_ff"),
        ("est_ram", "/estimate/est_ram"),
        ("mhz_median", "/synth/mhz/median"),
        ("mhz_min", "/synth/mhz/min"),
        ("mhz_max", "/synth/mhz/max"),
        ("synth_reasons", "/synth/reasons"),
        ("word_bits", "/derived/word_bits"),
        ("frames_per_s", "/derived/frames_per_s"),
        ("mpixels_per_s", "/derived/mpixels_per_s"),
        ("mtriangles_per_s", "/derived/mtriangles_per_s"),
        ("mpixels_per_s_per_lut", "/derived/mpixels_per_s_per_lut"),
        ("mtriangles_per_s_per_lut", "/derived/mtriangles_per_s_per_lut"),
    ]);
    if own.contains(&column) {
        return Some(format!("/{column}"));
    }
    if let Some(at) = report.get(column) {
        return Some(format!("/report/{at}"));
    }
    if let Some(cause) = column.strip_prefix("cycles_") {
        return Some(format!("/report/cycles/by_cause/{cause}"));
    }
    if column.contains('.') {
        return Some(format!("/keys/{column}"));
    }
    rest.get(column).map(|at| (*at).to_owned())
}

/// An objective: its name, its column, whether values are summed, whether the most is best.
const OBJECTIVES: [(&str, &str, bool, bool); 10] = [
    ("cycles", "cycles", true, false),
    ("bytes", "bytes", true, false),
    ("z_error", "z_error", false, false),
    ("color_error", "color_error", false, false),
    ("z_bound", "z_bound_for_input", false, false),
    ("color_bound", "color_bound_for_input", false, false),
    ("shading_error", "shading_error", false, false),
    ("shading_mean", "shading_mean", false, false),
    ("word_bits", "word_bits", false, false),
    ("mhz", "mhz_median", false, true),
];

/// A machine of the sweep: the values of the varied keys, and its rows, a list for each memory and in it a row for each input.
pub struct Machine {
    pub keys: Vec<(String, Value)>,
    pub rows: Vec<Vec<Value>>,
    pub over: Over,
}

/// How inputs count together: cycles summed with these weights, or the worst input.
#[derive(Clone, Copy)]
pub enum Over {
    Sum([f64; 3]),
    Worst,
}

/// A sweep as it was asked for.
pub struct Asked<'a> {
    /// Keys and their values, the slowest first.
    pub axes: &'a [(&'a str, &'a [Value])],
    pub inputs: &'a [&'a str],
    /// As rows have them.
    pub memories: &'a [&'a str],
    pub over: Over,
}

impl Asked<'_> {
    /// Its machines in their order. Every machine must have its rows.
    pub fn machines(&self, rows: &[Value]) -> Vec<Machine> {
        let mut all: Vec<Vec<(String, Value)>> = vec![Vec::new()];
        for (key, values) in self.axes {
            let with = |keys: &Vec<(String, Value)>, value: &Value| {
                keys.iter().cloned().chain([((*key).to_owned(), value.clone())]).collect()
            };
            all = all.iter().flat_map(|keys| values.iter().map(move |value| with(keys, value))).collect();
        }
        let find = |keys: &[(String, Value)], memory: &str, input: &str| -> Value {
            let mine = |row: &&Value| {
                row["stalls"] == memory
                    && row["input"] == input
                    && keys.iter().all(|(key, value)| row["keys"][key] == *value)
            };
            let found: Vec<&Value> = rows.iter().filter(mine).collect();
            assert_eq!(found.len(), 1, "rows of {keys:?} {memory} {input}");
            found[0].clone()
        };
        let of = |keys: Vec<(String, Value)>| {
            let memory = |memory: &&str| self.inputs.iter().map(|input| find(&keys, memory, input)).collect();
            let rows = self.memories.iter().map(memory).collect();
            Machine { keys, rows, over: self.over }
        };
        all.into_iter().map(of).collect()
    }
}

/// How memories count together.
#[derive(Clone, Copy)]
pub enum Judge {
    Worst,
    Sum,
    Only(usize),
}

impl Machine {
    fn of_memory(&self, memory: usize, name: &str) -> Option<f64> {
        let (_, column, sums, most) = OBJECTIVES.into_iter().find(|of| of.0 == name).unwrap();
        let at = pointer(column).unwrap();
        let values: Option<Vec<f64>> =
            self.rows[memory].iter().map(|row| row.pointer(&at)?.as_f64()).collect();
        let values = values?;
        Some(match (sums, most, self.over) {
            (true, _, Over::Sum(weights)) => {
                assert_eq!(values.len(), weights.len());
                values[0] * weights[0] + values[1] * weights[1] + values[2] * weights[2]
            }
            (_, false, _) => values.into_iter().fold(f64::MIN, f64::max),
            (_, true, _) => values.into_iter().fold(f64::MAX, f64::min),
        })
    }

    /// The value of an objective.
    pub fn value(&self, name: &str, judge: Judge) -> Option<f64> {
        let all: Option<Vec<f64>> = (0..self.rows.len()).map(|memory| self.of_memory(memory, name)).collect();
        match judge {
            Judge::Only(memory) => self.of_memory(memory, name),
            Judge::Sum if ["cycles", "bytes"].contains(&name) => Some(all?.iter().sum()),
            _ if name == "mhz" => Some(all?.into_iter().fold(f64::MAX, f64::min)),
            _ => Some(all?.into_iter().fold(f64::MIN, f64::max)),
        }
    }

    /// Cycles with each memory.
    pub fn cycles(&self) -> Vec<f64> {
        (0..self.rows.len()).map(|memory| self.of_memory(memory, "cycles").unwrap()).collect()
    }

    /// The memories whose causes are told.
    pub fn deciding(&self, judge: Judge) -> Vec<usize> {
        let cycles = self.cycles();
        let most = cycles.iter().copied().fold(f64::MIN, f64::max);
        match judge {
            Judge::Only(memory) => vec![memory],
            Judge::Sum => (0..cycles.len()).collect(),
            Judge::Worst => vec![cycles.iter().position(|cycles| *cycles == most).unwrap()],
        }
    }

    /// Cycles by cause: each input's times its weight, or those of the input that takes longest.
    pub fn causes(&self, memories: &[usize]) -> BTreeMap<String, f64> {
        let mut sums = BTreeMap::new();
        for rows in memories.iter().map(|memory| &self.rows[*memory]) {
            let totals: Vec<u64> =
                rows.iter().map(|row| row["report"]["cycles"]["total"].as_u64().unwrap()).collect();
            let longest = totals.iter().position(|total| total == totals.iter().max().unwrap());
            for (place, row) in rows.iter().enumerate() {
                let weight = match self.over {
                    Over::Sum(weights) => weights[place],
                    Over::Worst => f64::from(u8::from(longest == Some(place))),
                };
                for (cause, cycles) in row["report"]["cycles"]["by_cause"].as_object().unwrap() {
                    *sums.entry(cause.clone()).or_default() += weight * cycles.as_f64().unwrap();
                }
            }
        }
        sums.retain(|_, cycles| *cycles > 0.0);
        sums
    }
}

/// The front of each machine, every one against every other; none where a value is not known.
pub fn fronts(machines: &[Machine], objectives: &[&str], judge: Judge) -> Vec<Option<u64>> {
    let costs: Vec<Option<Vec<f64>>> =
        machines.iter().map(|machine| costs(machine, objectives, judge)).collect();
    let mut fronts = vec![None; machines.len()];
    for rank in 1.. {
        let left: Vec<usize> =
            (0..costs.len()).filter(|i| costs[*i].is_some() && fronts[*i].is_none()).collect();
        if left.is_empty() {
            return fronts;
        }
        let better = |a: usize, b: usize| {
            let pairs = || costs[a].iter().flatten().zip(costs[b].iter().flatten());
            pairs().all(|(a, b)| a <= b) && pairs().any(|(a, b)| a < b)
        };
        let on: Vec<usize> = left.iter().copied().filter(|i| !left.iter().any(|j| better(*j, *i))).collect();
        on.into_iter().for_each(|i| fronts[i] = Some(rank));
    }
    unreachable!()
}

fn costs(machine: &Machine, objectives: &[&str], judge: Judge) -> Option<Vec<f64>> {
    let cost = |name: &&str| Some(machine.value(name, judge)? * if *name == "mhz" { -1.0 } else { 1.0 });
    objectives.iter().map(cost).collect()
}

/// The place of the best machine for an objective; of equals the one better in the other objectives in their order, then the first.
pub fn best(machines: &[Machine], objectives: &[&str], name: &str, judge: Judge) -> Option<usize> {
    let order: Vec<&str> =
        [name].into_iter().chain(objectives.iter().copied().filter(|other| *other != name)).collect();
    let mut found: Option<(Vec<f64>, usize)> = None;
    for (place, machine) in machines.iter().enumerate() {
        let Some(own) = costs(machine, &order, judge) else { continue };
        if found.as_ref().is_none_or(|(least, _)| own.partial_cmp(least).unwrap().is_lt()) {
            found = Some((own, place));
        }
    }
    found.map(|(_, place)| place)
}

/// Whether a printed figure equals this one, to the five digits printed.
pub fn is(told: &str, figure: f64) -> bool {
    told.replace(',', "").parse::<f64>().is_ok_and(|told| (told - figure).abs() <= 6e-5 * figure.abs() + 5e-7)
}

/// The body of the table with this caption, as text: rows of cells. The first row is the header.
pub fn table(html: &str, caption: &str) -> Vec<Vec<String>> {
    let from = html.find(&format!("<caption>{caption}")).unwrap_or_else(|| panic!("no table {caption}"));
    let text = html[from..].split("</table>").next().unwrap();
    let cells = |row: &str| -> Vec<String> {
        let cells = row.split("<t").skip(1).filter(|cell| cell.starts_with("d>") || cell.starts_with('h'));
        cells.map(|cell| plain(cell.split_once('>').unwrap().1.split('<').next().unwrap())).collect()
    };
    text.split("<tr>").skip(1).map(cells).filter(|cells: &Vec<String>| !cells.is_empty()).collect()
}

/// Text of HTML.
pub fn plain(html: &str) -> String {
    html.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}

/// The data of the page's script.
pub fn data(html: &str) -> Value {
    let from = html.split_once("<script id=\"data\" type=\"application/json\">").unwrap().1;
    serde_json::from_str(from.split("</script>").next().unwrap()).unwrap()
}

/// Reads values off an axis whose round values stand at these places.
pub struct Axis {
    ticks: Vec<(f64, f64)>,
    logarithmic: bool,
}

impl Axis {
    /// From places and labels.
    pub fn new(ticks: impl Iterator<Item = (f64, String)>, logarithmic: bool) -> Axis {
        let number = |label: String| {
            label.replace(',', "").parse::<f64>().unwrap_or_else(|_| panic!("{label} on an axis"))
        };
        let ticks: Vec<(f64, f64)> = ticks.map(|(place, label)| (place, number(label))).collect();
        // Where all values are alike that value stands there.
        for (_, value) in ticks.iter().filter(|_| ticks.len() > 1) {
            // At most three digits that are not zero: 185525 is no label for people.
            let digits = format!("{value}").replace(['-', '.'], "");
            assert!(digits.trim_matches('0').len() <= 3, "{value} is not round");
        }
        Axis { ticks, logarithmic }
    }

    /// The value at a place; the only one there is where all values are alike.
    pub fn value(&self, place: f64) -> f64 {
        let [first, .., last] = self.ticks[..] else { return self.ticks[0].1 };
        let of = |value: f64| if self.logarithmic { value.log10() } else { value };
        let share = (place - first.0) / (last.0 - first.0);
        let value = of(first.1) + share * (of(last.1) - of(first.1));
        if self.logarithmic { 10_f64.powf(value) } else { value }
    }

    /// How far apart two places are that a reader cannot tell apart, as a value there.
    pub fn blur(&self, place: f64) -> f64 {
        (self.value(place + 0.11) - self.value(place - 0.11)).abs() + 1e-6 * self.value(place).abs()
    }
}
