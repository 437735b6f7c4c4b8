//! The charts of the report in a browser: every mark, line, bar and label is read off the page and held against the rows.

use super::browser::seen;
use super::oracle::{Axis, pointer};
use super::rows;
use crate::support::run;
use rand::seq::{IndexedRandom, SliceRandom};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Reads the charts.
const AFTER: &str = r##"
  const all = (root, query) => [...root.querySelectorAll(query)], number = (element, name) => Number(element.getAttribute(name));
  const ticks = (svg) => ["x-tick", "y-tick"].map((name) => all(svg, "." + name).map((t) => [number(t, name[0]) - (name === "y-tick" ? 4 : 0), t.textContent]));
  const paths = (svg, query) => all(svg, query).map((p) => [p.dataset.input ?? "", p.getAttribute("d")]);
  seen.errors = all(document, "#errors-chart svg[data-channel]").map((svg) => ({ channel: svg.dataset.channel, ticks: ticks(svg),
    points: paths(svg, ".points"), bound: paths(svg, ".bound"), screen: paths(svg, ".screen-bound"), dashes: paths(svg, ".proved"),
    none: all(svg, ".none").map((t) => [t.dataset.bits, t.textContent]) }));
  const front = document.querySelector("#front-chart svg");
  seen.front = { ticks: ticks(front), rest: paths(front, ".rest"), on: paths(front, ".front") };
  seen.legend = all(document, "#front-chart .legend li").map((li) => li.textContent);
  seen.bars = [];
  for (const child of document.querySelector("#causes-chart svg").children) {
    if (child.classList.contains("bar-label")) seen.bars.push({ label: child.firstChild.textContent, told: child.textContent, parts: [] });
    else if (child.tagName === "rect") seen.bars.at(-1).parts.push([child.textContent, number(child, "width")]);
  }
  const lanes = document.querySelector("#parallel-chart svg");
  seen.parallel = lanes && { lines: paths(lanes, ".line"), texts: all(lanes, "text").map((t) => [number(t, "x"), number(t, "y"), t.textContent]) };
  const only = document.querySelector("#only-input");
  if (only) {
    only.value = only.options[1].value; only.dispatchEvent(new Event("change"));
    seen.only = paths(document, "#front-chart .rest").concat(paths(document, "#front-chart .front"));
  }
"##;

/// Places where a path begins a part.
fn starts(d: &str) -> Vec<[f64; 2]> {
    let of = |part: &str| -> [f64; 2] {
        let numbers: String = part.chars().take_while(|c| c.is_ascii_digit() || ". -".contains(*c)).collect();
        let numbers: Vec<f64> = numbers.split_whitespace().map(|number| number.parse().unwrap()).collect();
        [numbers[0], numbers[1]]
    };
    d.split(['M', 'L']).skip(1).map(of).collect()
}

struct Chart<'a> {
    rows: Vec<&'a Value>,
    inputs: Vec<String>,
}

fn figure(row: &Value, name: &str) -> Option<f64> {
    row.pointer(&pointer(name).unwrap())?.as_f64()
}

fn paths(value: &Value) -> Vec<(&str, &str)> {
    value
        .as_array()
        .unwrap()
        .iter()
        .map(|path| (path[0].as_str().unwrap(), path[1].as_str().unwrap()))
        .collect()
}

fn axes(ticks: &Value, logarithmic: bool) -> [Axis; 2] {
    [0, 1].map(|axis| {
        let ticks = ticks[axis].as_array().unwrap().iter();
        let ticks = ticks.map(|tick| (tick[0].as_f64().unwrap(), tick[1].as_str().unwrap().to_owned()));
        Axis::new(ticks, logarithmic && axis == 1)
    })
}

/// What a chart of errors was found to show.
#[derive(Default)]
struct Found {
    points: usize,
    under: usize,
    bounds: usize,
    gaps: usize,
    apart: usize,
}

impl Chart<'_> {
    fn input(&self, row: &Value) -> usize {
        self.inputs.iter().position(|input| row["input"] == input.as_str()).unwrap()
    }

    /// The bound of each input at these bits; or the inputs that lack it on one of their machines.
    fn bounds(&self, key: &str, name: &str, bits: u64) -> Result<Vec<f64>, Vec<&str>> {
        let of = |input: &String| -> Option<f64> {
            let mine =
                self.rows.iter().filter(|row| row["input"] == input.as_str() && row["keys"][key] == bits);
            let bounds: Option<Vec<f64>> = mine.map(|row| figure(row, name)).collect();
            bounds.filter(|bounds| !bounds.is_empty()).map(|bounds| bounds.into_iter().fold(0.0, f64::max))
        };
        let lacking: Vec<&str> =
            self.inputs.iter().filter(|input| of(input).is_none()).map(String::as_str).collect();
        if lacking.is_empty() { Ok(self.inputs.iter().filter_map(of).collect()) } else { Err(lacking) }
    }

    fn errors(&self, chart: &Value, found: &mut Found) {
        let channel = chart["channel"].as_str().unwrap();
        let key = format!("formats.{channel}_fraction");
        let [x, y] = axes(&chart["ticks"], true);
        let all: BTreeSet<u64> = self.rows.iter().map(|row| row["keys"][&key].as_u64().unwrap()).collect();
        // Lines: for these triangles, and for every triangle.
        let mut lines: BTreeMap<(usize, u64), f64> = BTreeMap::new();
        for (drawn, name) in [("screen", "bound"), ("bound", "bound_for_input")] {
            let own: BTreeMap<u64, Vec<f64>> = all
                .iter()
                .filter_map(|bits| {
                    Some((*bits, self.bounds(&key, &format!("{channel}_{name}"), *bits).ok()?))
                })
                .collect();
            let mut seen = BTreeMap::new();
            for (input, d) in paths(&chart[drawn]) {
                assert!(d.is_empty() || d.starts_with('M'), "{d} draws nothing");
                let of: Vec<usize> = if input == "all" {
                    (0..self.inputs.len()).collect()
                } else {
                    vec![input.parse().unwrap()]
                };
                found.apart += usize::from(input != "all" && drawn == "bound");
                for place in starts(d) {
                    of.iter().for_each(|k| _ = seen.insert((*k, x.value(place[0]).round() as u64), place[1]));
                }
                // A line does not run over a gap.
                for run in d.split('M').skip(1).map(|run| starts(&format!("M{run}"))) {
                    let bits: Vec<u64> = run.iter().map(|place| x.value(place[0]).round() as u64).collect();
                    for pair in bits.windows(2) {
                        let between = all.range(pair[0] + 1..pair[1]).next();
                        assert!(between.is_none(), "{channel} {drawn} runs from {} to {}", pair[0], pair[1]);
                    }
                }
            }
            let places: BTreeSet<(usize, u64)> =
                own.keys().flat_map(|bits| (0..self.inputs.len()).map(|k| (k, *bits))).collect();
            assert_eq!(seen.keys().copied().collect::<BTreeSet<_>>(), places, "{channel} {drawn}");
            for ((input, bits), place) in seen {
                let bound = own[&bits][input];
                assert!(
                    (y.value(place) - bound).abs() <= y.blur(place),
                    "{channel} {drawn} {bits}: {}, {bound}",
                    y.value(place)
                );
                found.bounds += 1;
                if drawn == "bound" {
                    lines.insert((input, bits), place);
                }
            }
        }
        // Points: each error of the rows, none above its input's line.
        for (input, d) in paths(&chart["points"]) {
            let input: usize = input.parse().unwrap();
            let mut own: Vec<(u64, f64)> = self
                .rows
                .iter()
                .filter(|row| self.input(row) == input)
                .map(|row| {
                    (row["keys"][&key].as_u64().unwrap(), figure(row, &format!("{channel}_error")).unwrap())
                })
                .collect();
            own.sort_by(|a, b| a.partial_cmp(b).unwrap());
            own.dedup();
            let mut seen = starts(d);
            seen.sort_by(|a, b| (a[0], -a[1]).partial_cmp(&(b[0], -b[1])).unwrap());
            assert_eq!(seen.len(), own.len(), "{channel} {}", self.inputs[input]);
            for (place, (bits, error)) in seen.iter().zip(own) {
                assert_eq!(x.value(place[0]).round() as u64, bits);
                assert!(
                    (y.value(place[1]) - error).abs() <= y.blur(place[1]),
                    "{} at {bits}: {error}",
                    y.value(place[1])
                );
                found.points += 1;
                if let Some(line) = lines.get(&(input, bits)) {
                    assert!(place[1] >= line - 1e-6, "{}: {error} lies above its bound", self.inputs[input]);
                    found.under += 1;
                }
            }
        }
        // Gaps say who lacks a bound.
        let told: BTreeMap<String, String> = serde_json::from_value(chart["none"].clone())
            .map(|list: Vec<(String, String)>| list.into_iter().collect())
            .unwrap();
        let lacking = |bits: &u64| self.bounds(&key, &format!("{channel}_bound_for_input"), *bits).err();
        let own: BTreeMap<String, String> = all
            .iter()
            .filter_map(|bits| Some((bits.to_string(), format!("none for {}", lacking(bits)?.join(", ")))))
            .collect();
        assert_eq!(told, own, "{channel}");
        found.gaps += own.len();
    }

    /// Marks of the front's chart: cycles and depth error of each row, by input.
    fn front(&self, seen: &Value) -> usize {
        let [x, y] = axes(&seen["front"]["ticks"], false);
        let mut marks: BTreeMap<usize, Vec<[f64; 2]>> = BTreeMap::new();
        for (input, d) in paths(&seen["front"]["rest"]).into_iter().chain(paths(&seen["front"]["on"])) {
            marks.entry(input.parse().unwrap()).or_default().extend(starts(d));
        }
        for (input, marks) in &marks {
            let mine: Vec<&&Value> = self.rows.iter().filter(|row| self.input(row) == *input).collect();
            assert_eq!(marks.len(), mine.len());
            for row in mine {
                let own = [figure(row, "cycles").unwrap(), figure(row, "z_error").unwrap()];
                let near = |place: &&[f64; 2]| {
                    (x.value(place[0]) - own[0]).abs() <= x.blur(place[0])
                        && (y.value(place[1]) - own[1]).abs() <= y.blur(place[1])
                };
                assert!(marks.iter().any(|place| near(&place)), "no mark of {own:?} {}", self.inputs[*input]);
            }
        }
        if self.inputs.len() > 1 {
            let names: Vec<&str> =
                seen["legend"].as_array().unwrap().iter().map(|name| name.as_str().unwrap()).collect();
            assert_eq!(names, self.inputs);
            // One input alone can be looked at.
            let alone = paths(&seen["only"]).into_iter().filter(|(_, d)| !d.is_empty());
            assert!(alone.map(|(input, _)| input).all(|input| input == "0"), "{}", seen["only"]);
        }
        marks.values().map(Vec::len).sum()
    }

    /// Bars: the causes of a row each, named by its input.
    fn bars(&self, seen: &Value, varied: &[String]) -> usize {
        let bars = seen["bars"].as_array().unwrap();
        let mut labels = BTreeSet::new();
        let (mut checked, mut longest) = (0, Vec::new());
        for bar in bars {
            let (label, told) =
                (bar["label"].as_str().unwrap().trim_start_matches("▸ "), bar["told"].as_str().unwrap());
            assert!(labels.insert(label), "two bars are called {label}");
            let mine = |row: &&&Value| {
                let keys = varied.iter().all(|key| {
                    told.contains(&format!(
                        "{key}={}",
                        row["keys"][key].as_str().map_or_else(|| row["keys"][key].to_string(), str::to_owned)
                    ))
                });
                let stalls = row["stalls"] == "none"
                    || told.ends_with(&format!("stalls {}", row["stalls"].as_str().unwrap()));
                keys && told.contains(&format!("{}, ", row["input"].as_str().unwrap())) && stalls
            };
            let row = self
                .rows
                .iter()
                .filter(mine)
                .max_by_key(|row| row["stalls"].as_str().unwrap().len())
                .unwrap_or_else(|| panic!("{told}"));
            assert!(self.inputs.len() == 1 || label.starts_with(row["input"].as_str().unwrap()), "{label}");
            let causes: BTreeMap<&str, u64> = row["report"]["cycles"]["by_cause"]
                .as_object()
                .unwrap()
                .iter()
                .map(|(cause, cycles)| (cause.as_str(), cycles.as_u64().unwrap()))
                .filter(|(_, cycles)| *cycles > 0)
                .collect();
            let parts = bar["parts"].as_array().unwrap();
            assert_eq!(parts.len(), causes.len(), "{told}");
            for part in parts {
                let (cause, cycles) = part[0].as_str().unwrap().split_once(": ").unwrap();
                assert_eq!(cycles, format!("{} cycles", causes[cause]), "{told}");
                longest.push((causes[cause], part[1].as_f64().unwrap()));
                checked += 1;
            }
        }
        // All bars have one scale.
        let scale = longest.iter().map(|(cycles, width)| width / *cycles as f64).collect::<Vec<_>>();
        assert!(scale.iter().all(|of| (of - scale[0]).abs() < 1e-6 * scale[0]), "{scale:?}");
        checked
    }

    /// Parallel coordinates: on each lane the values of all rows.
    fn parallel(&self, seen: &Value, varied: &[String]) -> usize {
        let texts: Vec<(f64, f64, String)> =
            serde_json::from_value(seen["parallel"]["texts"].clone()).unwrap();
        let lines: Vec<Vec<[f64; 2]>> =
            paths(&seen["parallel"]["lines"]).into_iter().map(|(_, d)| starts(d)).collect();
        assert_eq!(lines.len(), self.rows.len());
        let mut checked = 0;
        for lane in texts.chunks(3) {
            let [(x, _, name), (_, top, high), (_, bottom, low)] = lane else { panic!("{lane:?}") };
            let name = varied.iter().find(|key| key.ends_with(&format!(".{name}"))).unwrap_or(name);
            let mut own: Vec<f64> = self.rows.iter().map(|row| figure(row, name).unwrap()).collect();
            let [high, low] = [high, low].map(|label| label.parse::<f64>().unwrap());
            let mut seen: Vec<f64> = lines
                .iter()
                .filter_map(|line| line.iter().find(|place| (place[0] - x).abs() < 0.5))
                .map(|place| low + (bottom - 16.0 - place[1]) / (bottom - 16.0 - (top + 6.0)) * (high - low))
                .collect();
            own.sort_by(f64::total_cmp);
            seen.sort_by(f64::total_cmp);
            assert_eq!(own.len(), seen.len());
            let near = |(a, b): (&f64, &f64)| {
                (a - b).abs() <= 1e-3 * (high - low) + 1e-4 * high.abs()
                    || (high == low && own[0] == own[own.len() - 1])
            };
            assert!(own.iter().zip(&seen).all(near), "{name}: {own:?} {seen:?}");
            checked += own.len();
        }
        checked
    }
}

#[test]
fn charts_of_random_sweeps_show_their_rows() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    std::fs::write(at.join("a b.tri"), "size 64 48\nT 0 0 0 1 0 0 0  60 0 0.5 0 1 0 0  0 40 1 0 0 1 0\n")
        .unwrap();
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (mut found, mut marks, mut bars, mut parallel) = (Found::default(), 0, 0, 0);
    for round in 0..5 {
        let mut inputs = vec!["sphere", "torus", "a b.tri"];
        inputs.shuffle(&mut random);
        inputs.truncate(if round == 0 { 1 } else { random.random_range(2..=3) });
        let [z, color] = [0, 1].map(|_| random.random_range(4..6));
        let mut vary = vec![
            format!("formats.z_fraction={z}..{}", z + random.random_range(2..6)),
            format!("formats.color_fraction={color}..{}..2", color + 4),
        ];
        let others = [
            "interpolator.adders=1,4",
            "edge.kind=exact,slope",
            "screen.guard_bits=10,13",
            "setup.lanes=1,2",
        ];
        vary.push((*others.choose(&mut random).unwrap()).to_owned());
        let out = format!("s{round}");
        let mut arguments = vec![
            "sweep",
            "--quiet",
            "--out",
            &out,
            "--set",
            "screen.width=160",
            "--set",
            "screen.height=120",
        ];
        arguments.extend(&inputs);
        vary.iter().for_each(|vary| arguments.extend(["--vary", vary]));
        if round % 2 == 1 {
            arguments.extend(["--stalls", "none", "--stalls", "dram"]);
        }
        assert_eq!(run(at, &arguments), (Some(0), String::new()), "{arguments:?}");
        let rows = rows(&at.join(&out));
        let inputs = inputs.iter().map(|input| (*input).to_owned()).collect();
        let chart = Chart { rows: rows.iter().filter(|row| row["status"] == "ok").collect(), inputs };
        let seen = seen(at, &format!("{out}/report.html"), AFTER);
        let errors = seen["errors"].as_array().unwrap();
        assert_eq!(errors.len(), 2);
        errors.iter().for_each(|errors| chart.errors(errors, &mut found));
        let varied: Vec<String> =
            vary.iter().map(|vary| vary.split('=').next().unwrap().to_owned()).collect();
        marks += chart.front(&seen);
        bars += chart.bars(&seen, &varied);
        parallel += chart.parallel(&seen, &varied);
    }
    let Found { points, under, bounds, gaps, apart } = found;
    println!(
        "checked {points} points, {under} of them under a line, {bounds} bounds, {gaps} gaps, {apart} lines of one input; {marks} marks, {bars} bars, {parallel} places on lanes"
    );
    assert!(
        points > 60 && under > 20 && bounds > 30 && gaps > 5 && apart > 3,
        "{points} {under} {bounds} {gaps} {apart}"
    );
    assert!(marks > 300 && bars > 200 && parallel > 1500, "{marks} {bars} {parallel}");
}
