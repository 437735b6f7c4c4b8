//! Every figure that a sweep prints or writes, beside what follows from its rows.

use super::oracle::{Asked, Axis, Judge, Machine, Over, best, data, fronts, is, plain, pointer, table};
use super::rows;
use crate::support::{csv, edgewalk};
use serde_json::{Value, json};
use std::collections::HashSet;
use std::path::Path;

/// Three inputs, one with a screen of its own; three memories.
const SWEEP: [&str; 22] = [
    "sweep",
    "sphere",
    "torus",
    "own.tri",
    "--set",
    "screen.width=96",
    "--set",
    "screen.height=72",
    "--vary",
    "formats.z_fraction=4,6,9",
    "--vary",
    "formats.color_fraction=5,8",
    "--vary",
    "interpolator.adders=1,4",
    "--stalls",
    "none",
    "--stalls",
    "random:rd=200",
    "--stalls",
    "dram:miss=9",
    "--out",
    "s",
];
const OWN: &str = "size 64 48\nT 0 0 0 1 0 0 0  60 0 0.5 0 1 0 0  0 40 1 0 0 1 0\n";
const INPUTS: [&str; 3] = ["sphere", "torus", "own.tri"];
const MEMORIES: [&str; 3] =
    ["none", "random:seed=1,rd=200,data=64,wr=64", "dram:banks=4,page=256,miss=9,turn=2,refresh=780,busy=13"];
const NAMES: [&str; 3] = ["none", "random:rd=200", "dram:miss=9"];

/// How rows count together, as asked for and as the oracle knows it; the objectives, none for those that are usual; and what
/// text says of the inputs.
type How = (&'static str, Judge, &'static [&'static str], Over, &'static [&'static str], &'static str);

const SUMMED: &str = "Of 3 inputs cycles and bytes are summed, and the worst of every other figure counts";
const ASKED: [How; 6] = [
    ("worst", Judge::Worst, &[], Over::Sum([1.0; 3]), &[], SUMMED),
    ("sum", Judge::Sum, &["cycles", "bytes", "z_bound"], Over::Sum([1.0; 3]), &[], SUMMED),
    ("none", Judge::Only(0), &["color_error", "word_bits", "cycles"], Over::Sum([1.0; 3]), &[], SUMMED),
    (
        "dram:miss=9",
        Judge::Only(2),
        &["z_error", "color_bound", "word_bits", "cycles"],
        Over::Sum([1.0; 3]),
        &["--judge-inputs", "sum"],
        SUMMED,
    ),
    (
        "worst",
        Judge::Worst,
        &[],
        Over::Sum([1.0, 0.125, 300.0]),
        &["--weight", "own.tri=300", "--weight", "torus=0.125"],
        "Of 3 inputs cycles and bytes are summed (own.tri times 300, torus times 0.125), and the worst of every other figure",
    ),
    (
        "sum",
        Judge::Sum,
        &["cycles", "color_error"],
        Over::Worst,
        &["--judge-inputs", "worst"],
        "Of 3 inputs the worst counts, for each figure apart",
    ),
];

struct Ran<'a> {
    at: &'a Path,
    machines: Vec<Machine>,
    rows: Vec<Value>,
    objectives: Vec<&'a str>,
    judge: Judge,
    inputs_said: &'a str,
    fronts: Vec<Option<u64>>,
    bests: Vec<(&'a str, usize)>,
}

#[test]
fn every_figure_follows_from_the_rows() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("own.tri"), OWN).unwrap();
    let mut checked = 0;
    for (place, (judge, of, objectives, over, more, inputs_said)) in ASKED.into_iter().enumerate() {
        let mut arguments: Vec<&str> = SWEEP.to_vec();
        arguments.extend(["--judge", judge]);
        arguments.extend(more);
        objectives.iter().for_each(|name| arguments.extend(["--objective", name]));
        let said = |last: &[&str]| {
            let output = edgewalk(at, &[&arguments[..], last].concat()).output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            String::from_utf8(output.stdout).unwrap()
        };
        let told: Value = serde_json::from_str(&said(&["--json"])).unwrap();
        let text = said(&[]);
        let values = [&[json!(4), json!(6), json!(9)][..], &[json!(5), json!(8)], &[json!(1), json!(4)]];
        let keys = ["formats.z_fraction", "formats.color_fraction", "interpolator.adders"];
        let axes = [0, 1, 2].map(|i| (keys[i], values[i]));
        let rows = rows(&at.join("s"));
        let machines = Asked { axes: &axes, inputs: &INPUTS, memories: &MEMORIES, over }.machines(&rows);
        let usual = ["cycles", "z_error", "color_error", "word_bits"];
        let objectives = if objectives.is_empty() { usual.to_vec() } else { objectives.to_vec() };
        let bests =
            objectives.iter().filter_map(|name| Some((*name, best(&machines, &objectives, name, of)?)));
        let bests = bests.collect();
        let ran = Ran {
            at,
            fronts: fronts(&machines, &objectives, of),
            bests,
            machines,
            rows,
            objectives,
            judge: of,
            inputs_said,
        };
        for (row, channel) in ran.rows.iter().flat_map(|row| ["z", "color"].map(|channel| (row, channel))) {
            let figure = |name: &str| row["report"]["comparison"][format!("{channel}_{name}")].as_f64();
            let slack = figure("bound_for_input").map(|bound| figure("error").unwrap() / bound);
            let told = row["slack"][channel].as_f64();
            assert_eq!(told.is_some(), slack.is_some());
            assert!(
                told.zip(slack).is_none_or(|(told, own)| (told - own).abs() < 1e-12),
                "{told:?} {slack:?}"
            );
        }
        let made = if place == 0 { 108 } else { 0 };
        assert_eq!((&told["made"], &told["points"], &told["rows"]), (&json!(made), &json!(108), &json!(108)));
        checked += ran.json(&told) + ran.text(&text) + ran.csv() + ran.page();
    }
    println!("checked {checked} figures");
    assert!(checked > 20_000, "{checked}");
}

impl Ran<'_> {
    fn on_front(&self) -> Vec<&Machine> {
        self.machines
            .iter()
            .zip(&self.fronts)
            .filter(|(_, front)| **front == Some(1))
            .map(|of| of.0)
            .collect()
    }

    /// What JSON says of a machine.
    fn described(&self, told: &Value, machine: &Machine) -> usize {
        assert_eq!(told["machine"], machine.rows[0][0]["machine"]);
        assert_eq!(told["keys"].as_object().unwrap().len(), 3);
        machine.keys.iter().for_each(|(key, value)| assert_eq!(told["keys"][key], *value));
        assert_eq!(told["values"].as_object().unwrap().len(), self.objectives.len());
        for name in &self.objectives {
            assert_eq!(told["values"][name].as_f64(), machine.value(name, self.judge), "{name}: {told}");
        }
        for (memory, cycles) in MEMORIES.iter().zip(machine.cycles()) {
            assert_eq!(told["cycles"][memory].as_f64(), Some(cycles));
        }
        self.objectives.len() + 7
    }

    fn json(&self, told: &Value) -> usize {
        assert_eq!((&told["machines"], &told["faults"]), (&json!(12), &json!(0)));
        assert_eq!(told["status"], json!({"ok": 108, "pruned": 0, "invalid": 0, "failed": 0, "timeout": 0}));
        assert_eq!(told["best"].as_object().unwrap().len(), self.bests.len());
        let mut checked = 5;
        for (name, place) in &self.bests {
            checked += self.described(&told["best"][name], &self.machines[*place]);
            let file = format!("s/best_{name}.toml");
            assert_eq!(told["best"][name]["file"], file);
            // The file is the machine, and says what it is best in.
            let text = std::fs::read_to_string(self.at.join(&file)).unwrap();
            let hash = self.machines[*place].rows[0][0]["machine"].as_str().unwrap();
            let head = format!("# machine {hash}, best of 12 for {name}: ");
            let value =
                text.strip_prefix(&head).unwrap_or_else(|| panic!("{text}")).split(' ').next().unwrap();
            assert_eq!(value.parse().ok(), self.machines[*place].value(name, self.judge), "{file}");
            let check = ["config", "check", "--json", "--machine", &file];
            let check: Value =
                serde_json::from_slice(&edgewalk(self.at, &check).output().unwrap().stdout).unwrap();
            assert_eq!(check["hash"], hash, "{file}");
        }
        let front = told["front"].as_array().unwrap();
        assert_eq!(front.len(), self.on_front().len());
        checked +=
            front.iter().zip(self.on_front()).map(|(told, own)| self.described(told, own)).sum::<usize>();
        checked
    }

    fn text(&self, text: &str) -> usize {
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("108 points, 108 of them were there: 108 ok"), "{text}");
        let judged = lines.next().unwrap();
        let words = match self.judge {
            Judge::Worst => "by the worst of the memories none, random:rd=200, dram:miss=9",
            Judge::Sum => "by the sum over the memories none, random:rd=200, dram:miss=9",
            Judge::Only(memory) => &format!("by the memory {}", NAMES[memory]),
        };
        assert!(judged.starts_with(self.inputs_said) && judged.ends_with(words), "{judged}");
        let mut checked = 3;
        for (name, place) in &self.bests {
            let words: Vec<&str> = lines.next().unwrap().split_whitespace().collect();
            assert_eq!(words[..2], ["best", name]);
            assert!(is(words[2], self.machines[*place].value(name, self.judge).unwrap()), "{words:?}");
            assert_eq!(words[3], format!("s/best_{name}.toml"));
            checked += 1;
        }
        let front = self.on_front();
        let head = format!("front of {}: {} of 12 machines", self.objectives.join(", "), front.len());
        assert_eq!(lines.next(), Some(head.as_str()), "{text}");
        for machine in front {
            let line = lines.next().unwrap();
            let (figures, cycles) = line.split_once("  cycles: ").unwrap();
            let told: Vec<&str> = cycles.split(", ").collect();
            assert_eq!(told.len(), NAMES.len());
            for ((name, own), told) in NAMES.iter().zip(machine.cycles()).zip(told) {
                let told = told.strip_prefix(&format!("{name} ")).unwrap();
                assert!(is(told, own), "{name} {told}: {own}");
            }
            let words: Vec<&str> = figures.split_whitespace().collect();
            let (values, keys) = words.split_at(self.objectives.len());
            for (name, value) in self.objectives.iter().zip(values) {
                assert!(is(value, machine.value(name, self.judge).unwrap()), "{name}: {line}");
            }
            let own: Vec<String> = machine.keys.iter().map(|(key, value)| format!("{key}={value}")).collect();
            assert_eq!(keys, own);
            checked += self.objectives.len() + 6;
        }
        assert_eq!(lines.next(), None);
        checked
    }

    /// The rows in the order of the points, with their machine's front.
    fn in_order(&self) -> impl Iterator<Item = (&Value, Option<u64>)> {
        let machines = self.machines.iter().zip(&self.fronts);
        machines.flat_map(|(machine, front)| machine.rows.iter().flatten().map(|row| (row, *front)))
    }

    fn csv(&self) -> usize {
        let table = csv(&self.at.join("s/runs.csv"));
        let (mut checked, mut order) = (0, self.in_order());
        let kept = std::fs::read_to_string(self.at.join("s/runs.jsonl")).unwrap();
        let kept: HashSet<&str> = kept.split(':').filter_map(|part| part.split([',', '}']).next()).collect();
        for record in &table[1..] {
            let (row, front) = order.next().unwrap();
            for (name, field) in table[0].iter().zip(record) {
                let own = match name.as_str() {
                    "front" => front.map_or(Value::Null, Value::from),
                    name => {
                        let at = pointer(name).unwrap_or_else(|| panic!("column {name}"));
                        row.pointer(&at).cloned().unwrap_or(Value::Null)
                    }
                };
                let same = match &own {
                    Value::Null => field.is_empty(),
                    Value::String(text) => field == text,
                    // Digit by digit as the row has it.
                    Value::Number(number) if number.is_f64() && name != "seconds" => {
                        field.parse::<f64>().ok() == number.as_f64() && kept.contains(field.as_str())
                    }
                    Value::Number(number) => field.parse::<f64>().ok() == number.as_f64(),
                    other => panic!("{name} is {other}"),
                };
                assert!(same, "{name} = {field:?}, the row has {own}");
                checked += 1;
            }
        }
        assert!(order.next().is_none());
        checked
    }

    fn page(&self) -> usize {
        let html = std::fs::read_to_string(self.at.join("s/report.html")).unwrap();
        let title = "<h1>12 machines on sphere, torus, own.tri, memory none, random:rd=200, dram:miss=9</h1>";
        assert!(html.contains(title) && html.contains("<p>108 points: 108 ok.</p>"));
        let mut checked = 2;
        let bests = table(&html, "The best machine for each objective");
        for (line, (name, place)) in bests[1..].iter().zip(&self.bests) {
            let machine = &self.machines[*place];
            assert!(line[0] == *name && line[3] == format!("best_{name}.toml"), "{line:?}");
            assert!(is(&line[1], machine.value(name, self.judge).unwrap()), "{line:?}");
            let keys: Vec<String> = machine.keys.iter().map(|(_, value)| value.to_string()).collect();
            assert_eq!(line[4..], keys);
            checked += 4;
        }
        assert_eq!(bests.len() - 1, self.bests.len());
        let front = table(&html, "The first front");
        assert_eq!(front.len() - 1, self.on_front().len());
        for (line, machine) in front[1..].iter().zip(self.on_front()) {
            checked += self.front_line(line, machine);
        }
        checked + self.script(&data(&html)) + self.chart(&html)
    }

    fn front_line(&self, line: &[String], machine: &Machine) -> usize {
        let (values, rest) = line.split_at(self.objectives.len());
        for (name, value) in self.objectives.iter().zip(values) {
            assert!(is(value, machine.value(name, self.judge).unwrap()), "{name}: {line:?}");
        }
        let keys: Vec<String> = machine.keys.iter().map(|(_, value)| value.to_string()).collect();
        assert_eq!(&rest[..3], &keys[..]);
        for (told, own) in rest[3..6].iter().zip(machine.cycles()) {
            assert!(is(told, own), "{told}: {own}");
        }
        // Causes of the memory that decides, of the inputs as they count.
        let deciding = machine.deciding(self.judge);
        let told = match deciding[..] {
            [memory] => {
                rest[6].strip_prefix(&format!("{}: ", NAMES[memory])).unwrap_or_else(|| panic!("{line:?}"))
            }
            _ => &rest[6],
        };
        let causes = machine.causes(&deciding);
        let all: f64 = causes.values().sum();
        let shares: Vec<(&str, &str)> = told
            .split(", ")
            .map(|share| share.strip_suffix(" %").unwrap().split_once(' ').unwrap())
            .collect();
        assert_eq!(shares.len(), causes.len(), "{told}");
        for (cause, share) in shares {
            let own = 100.0 * causes[cause] / all;
            assert!((share.parse::<f64>().unwrap() - own).abs() <= 0.0501, "{cause} {share}: {own}");
        }
        self.objectives.len() + 6 + causes.len()
    }

    /// The columns that the script works with.
    fn script(&self, data: &Value) -> usize {
        let names: Vec<&str> =
            data["columns"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
        let lines = data["rows"].as_array().unwrap();
        let (mut checked, mut order) = (0, self.in_order());
        for line in lines {
            let (row, front) = order.next().unwrap();
            for (name, told) in names.iter().zip(line.as_array().unwrap()) {
                let own = match *name {
                    "front" => front.map_or(Value::Null, Value::from),
                    name => row.pointer(&pointer(name).unwrap()).cloned().unwrap_or(Value::Null),
                };
                assert_eq!(*told, own, "{name}");
                checked += 1;
            }
        }
        assert!(order.next().is_none());
        let varied = data["varied"].as_array().unwrap();
        for (key, _) in &self.machines[0].keys {
            assert!(varied.iter().any(|name| name == key), "{key}");
        }
        for (key, value) in data["alike"].as_object().unwrap() {
            assert!(
                self.rows.iter().all(|row| row["keys"].get(key).unwrap_or(&Value::Null) == value),
                "{key}"
            );
        }
        assert_eq!(data["inputs"], json!(INPUTS));
        checked
    }

    /// The chart for readers without scripts: a mark for each machine at its values of the first two objectives.
    fn chart(&self, html: &str) -> usize {
        let svg = html.split_once("<svg").unwrap().1.split("</svg>").next().unwrap();
        let attribute = |element: &str, name: &str| -> String {
            element.split_once(&format!("{name}=\"")).unwrap().1.split('"').next().unwrap().to_owned()
        };
        let texts = || {
            svg.split("<text ").skip(1).map(|element| {
                let text = plain(element.split_once('>').unwrap().1.split('<').next().unwrap());
                let place = ["x", "y"].map(|name| attribute(element, name).parse::<f64>().unwrap());
                (element, place, text)
            })
        };
        let tick = |anchor: &'static str| {
            texts().filter(move |(element, _, text)| {
                element.contains(anchor) && text.starts_with(|c: char| c.is_ascii_digit())
            })
        };
        let x = Axis::new(tick("\"middle\"").map(|(_, [x, _], text)| (x, text)), false);
        // Labels stand four lines below their value.
        let y = Axis::new(tick("\"end\"").map(|(_, [_, y], text)| (y - 4.0, text)), false);
        let known: Vec<&Machine> = self
            .machines
            .iter()
            .zip(&self.fronts)
            .filter(|(_, front)| front.is_some())
            .map(|of| of.0)
            .collect();
        let mut marks = Vec::new();
        for path in svg.split("<path ").skip(1) {
            let d = attribute(path, "d");
            match attribute(path, "class").as_str() {
                "front" => marks.push((true, d)),
                "rest" => marks.extend(d.split('M').skip(1).map(|d| (false, format!("M{d}")))),
                _ => {}
            }
        }
        assert_eq!(marks.len(), known.len());
        for (front, d) in &marks {
            let (left, rest) = d[1..].split_once(' ').unwrap();
            let top: String = rest.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
            // A diamond begins at its top.
            let place =
                [left.parse::<f64>().unwrap(), top.parse::<f64>().unwrap() + if *front { 6.0 } else { 0.0 }];
            let near = |machine: &Machine| {
                let value = |i: usize| machine.value(self.objectives[i], self.judge).unwrap();
                (x.value(place[0]) - value(0)).abs() <= x.blur(place[0])
                    && (y.value(place[1]) - value(1)).abs() <= y.blur(place[1])
            };
            assert!(known.iter().any(|machine| near(machine)), "a mark at {place:?} is no machine's");
        }
        assert_eq!(marks.iter().filter(|(front, _)| *front).count(), self.on_front().len());
        2 * marks.len()
    }
}
