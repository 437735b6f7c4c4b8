//! The figures, as a table and as one line of JSON.

use super::job::{Job, Times, Work};
use edgewalk_machine::Counted;
use serde::Serialize;
use serde_json::json;

/// One engine's figures.
#[derive(Serialize)]
pub struct Row {
    engine: &'static str,
    /// Why it took no part.
    #[serde(skip_serializing_if = "Option::is_none")]
    absent: Option<String>,
    /// What it did, where that is not what the machine does: its times mean nothing then.
    #[serde(skip_serializing_if = "Option::is_none")]
    differs: Option<Difference>,
    #[serde(flatten)]
    figures: Option<Figures>,
}

/// Of the part that was drawn; frames by the processor's time, rates by its median.
#[derive(Serialize)]
struct Figures {
    cpu_ms_median: f64,
    ms_min: f64,
    /// Distance of the quartiles of the processor's time, the median being 1; of fewer than four frames there are none.
    noise: Option<f64>,
    /// From the changed parameter to the first frame, on the wall.
    first_ms: f64,
    #[serde(skip)]
    drawn: Counted,
    /// With polygons and lines.
    triangles: usize,
    fragments: u64,
    cycles: u64,
    cycles_per_second: f64,
    pixels_per_second: f64,
    /// With polygons and lines.
    triangles_per_second: f64,
    /// Simulated cycles a second, Verilator's being 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    ratio_to_verilator: Option<f64>,
}

/// Work of a frame beside that of the machine.
#[derive(Serialize)]
struct Difference {
    found: Work,
    expected: Work,
}

impl Row {
    /// What an engine needed for its part, or how its work differs.
    pub fn new(engine: &'static str, job: &Job, times: &Times) -> Row {
        if times.work != job.work {
            let differs = Some(Difference { found: times.work, expected: job.work });
            return Row { engine, absent: None, differs, figures: None };
        }
        let mut cpu: Vec<f64> = times.frames.iter().map(|time| time.cpu).collect();
        cpu.sort_by(f64::total_cmp);
        let quantile = |quarters: usize| cpu[(cpu.len() - 1) * quarters / 4];
        let median = quantile(2);
        let a_second = |count: u64| count as f64 * 1e3 / median;
        let drawn = job.counted();
        let figures = Figures {
            cpu_ms_median: median,
            ms_min: cpu[0],
            noise: (cpu.len() >= 4).then(|| (quantile(3) - quantile(1)) / median),
            first_ms: times.first,
            drawn,
            triangles: drawn.total(),
            fragments: job.fragments,
            cycles: job.work.cycles,
            cycles_per_second: a_second(job.work.cycles),
            pixels_per_second: a_second(job.fragments),
            triangles_per_second: a_second(drawn.total() as u64),
            ratio_to_verilator: None,
        };
        Row { engine, absent: None, differs: None, figures: Some(figures) }
    }

    /// An engine that took no part.
    pub fn absent(engine: &'static str, why: String) -> Row {
        Row { engine, absent: Some(why), differs: None, figures: None }
    }
}

impl Row {
    /// Why there are no figures.
    fn why(&self) -> String {
        match &self.differs {
            Some(Difference { found, expected }) => format!(
                "differs from the machine: {} cycles instead of {}, {} writes instead of {}",
                found.cycles, expected.cycles, found.writes, expected.writes
            ),
            None => self.absent.clone().unwrap_or_default(),
        }
    }
}

/// All engines.
pub struct Table<'a> {
    whole: &'a Job<'a>,
    rows: Vec<Row>,
}

impl<'a> Table<'a> {
    /// With the ratios to Verilator, if it took part.
    pub fn new(whole: &'a Job<'a>, mut rows: Vec<Row>) -> Self {
        let verilator = rows.iter().find(|row| row.engine == "verilator");
        let rate = verilator.and_then(|row| Some(row.figures.as_ref()?.cycles_per_second));
        for figures in rows.iter_mut().filter_map(|row| row.figures.as_mut()) {
            figures.ratio_to_verilator = rate.map(|rate| figures.cycles_per_second / rate);
        }
        Table { whole, rows }
    }

    /// All engines that took part did what the machine does.
    pub fn agrees(&self) -> bool {
        !self.rows.iter().any(|row| row.differs.is_some())
    }

    /// What kept each engine out, if none took part.
    pub fn nothing_timed(&self) -> Option<String> {
        let took_part = |row: &Row| row.figures.is_some() || row.differs.is_some();
        let why = self.rows.iter().map(|row| format!("{}: {}", row.engine, row.why()));
        (!self.rows.iter().any(took_part)).then(|| why.collect::<Vec<_>>().join("; "))
    }

    /// As JSON. The first engine that took part, the fastest, stands for all.
    pub fn json(&self) -> serde_json::Value {
        let first = self.rows.iter().find_map(|row| Some((row.engine, row.figures.as_ref()?)));
        let counted = self.whole.counted();
        json!({
            "renderer": "edgewalk",
            "engine": first.map(|(engine, _)| engine),
            "cpu_ms_median": first.map(|(_, figures)| figures.cpu_ms_median),
            "ms_min": first.map(|(_, figures)| figures.ms_min),
            "repeat": self.whole.repeat,
            "triangles": counted.triangles,
            "polygons": counted.polygons,
            "lines": counted.lines,
            "fragments": self.whole.fragments,
            "cycles": self.whole.work.cycles,
            "machine": self.whole.machine.hash(),
            "engines": self.rows,
        })
    }

    /// As a page of text.
    pub fn text(&self) -> String {
        let (whole, counted) = (self.whole, self.whole.counted());
        let mut text = format!(
            "{counted}, {} fragments, {} cycles a frame, machine {}; median of {} frames\n\
             {:<12}{:>10}{:>10}{:>8}{:>11}{:>11}{:>10}{:>12}{:>9}\n",
            whole.fragments,
            whole.work.cycles,
            whole.machine.hash(),
            whole.repeat,
            "engine",
            "CPU ms",
            "CPU min",
            "noise",
            "first ms",
            "Mcycle/s",
            "Mpixel/s",
            if counted.total() == counted.triangles { "Mtriangle/s" } else { "Mprim/s" },
            "ratio",
        );
        for row in &self.rows {
            text += &match &row.figures {
                Some(figures) => self.line(row.engine, figures),
                None => format!("{:<12}  {}\n", row.engine, row.why()),
            };
        }
        text
    }

    fn line(&self, engine: &str, f: &Figures) -> String {
        let mut line = format!(
            "{engine:<12}{:>10.3}{:>10.3}{:>8}{:>11.1}{:>11.3}{:>10.3}{:>12.4}",
            f.cpu_ms_median,
            f.ms_min,
            f.noise.map_or_else(|| "-".to_owned(), |noise| format!("{:.1} %", noise * 100.0)),
            f.first_ms,
            f.cycles_per_second / 1e6,
            f.pixels_per_second / 1e6,
            f.triangles_per_second / 1e6,
        );
        if let Some(ratio) = f.ratio_to_verilator {
            line += &format!("{ratio:>9.2}");
        }
        if f.triangles < self.whole.counted().total() {
            line += &format!("  first {}, {} cycles", f.drawn, f.cycles);
        }
        line + "\n"
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // a test that unwraps nothing reports it
mod tests {
    use super::*;
    use crate::stopwatch::Time;
    use edgewalk_machine::{Machine, Plan};
    use edgewalk_model::{DrawState, Shading, Waits};

    fn times(job: &Job, first: f64, cpu: &[f64]) -> Times {
        let frames = cpu.iter().map(|cpu| Time { cpu: *cpu, wall: 1e6 + cpu }).collect();
        Times { first, frames, work: job.work }
    }

    fn triangles(plan: &Plan) -> Vec<[edgewalk_machine::PortVertex; 3]> {
        let corner = |x, y| plan.port_vertex(x, y, &[0.5, 0.5, 0.5, 0.5]).unwrap();
        (0..4).map(|k| [corner(1.0, 1.0), corner(20.0 + f64::from(k), 2.0), corner(3.0, 17.0)]).collect()
    }

    /// Every figure of JSON and text, from times by hand: two engines, of which the second draws a part.
    #[test]
    fn figures_follow_from_times() {
        let plan = Machine { width: 24, height: 20, guard_bits: 6, ..Machine::default() }.plan().unwrap();
        let (all, shading) = (triangles(&plan), Shading::default());
        let state = (DrawState::default(), Waits::Never);
        let whole = Job::new(&plan, &all, &shading, state, 9).unwrap();
        let part = Job::new(&plan, &all[..3], &shading, state, 9).unwrap();
        let fast =
            Row::new("fast", &whole, &times(&whole, 77.0, &[0.5, 0.1, 0.9, 0.3, 0.7, 0.2, 0.8, 0.4, 10.0]));
        let verilator = Row::new("verilator", &part, &times(&part, 88.0, &[2.0, 4.0, 8.0]));
        let late = Times {
            work: Work { cycles: whole.work.cycles + 1, ..whole.work },
            ..times(&whole, 1.0, &[1.0])
        };
        let table = Table::new(
            &whole,
            vec![fast, Row::new("tick", &whole, &late), Row::absent("jit", "why".to_owned()), verilator],
        );
        let json = table.json();
        let row = |place: usize| &json["engines"][place];
        // Sorted: 0.1 0.2 0.3 0.4 0.5 0.7 0.8 0.9 10; the quartiles are 0.3, 0.5 and 0.8.
        let wanted = [("cpu_ms_median", 0.5), ("ms_min", 0.1), ("noise", 1.0), ("first_ms", 77.0)];
        for (key, value) in wanted {
            assert!((row(0)[key].as_f64().unwrap() - value).abs() < 1e-12, "{key}: {}", row(0));
        }
        assert_eq!((row(3)["cpu_ms_median"].as_f64(), row(3)["ms_min"].as_f64()), (Some(4.0), Some(2.0)));
        assert!(row(3)["noise"].is_null(), "three frames have no quartiles");
        for (place, job, median) in [(0, &whole, 0.5), (3, &part, 4.0)] {
            let counts = [
                ("cycles_per_second", job.work.cycles),
                ("pixels_per_second", job.fragments),
                ("triangles_per_second", job.triangles.len() as u64),
            ];
            for (key, count) in counts {
                let rate = count as f64 / median * 1000.0;
                assert!(
                    (row(place)[key].as_f64().unwrap() / rate - 1.0).abs() < 1e-12,
                    "{key}: {}",
                    row(place)
                );
            }
            assert_eq!(row(place)["cycles"].as_u64(), Some(job.work.cycles));
            assert_eq!(row(place)["fragments"].as_u64(), Some(job.fragments));
            assert_eq!(row(place)["triangles"].as_u64(), Some(job.triangles.len() as u64));
        }
        let ratio = (whole.work.cycles as f64 / 0.5) / (part.work.cycles as f64 / 4.0);
        assert!(ratio > 8.0 && (row(0)["ratio_to_verilator"].as_f64().unwrap() / ratio - 1.0).abs() < 1e-12);
        assert_eq!(row(3)["ratio_to_verilator"].as_f64(), Some(1.0));
        let expected = json!({"cycles": whole.work.cycles, "writes": whole.work.writes});
        let found = json!({"cycles": whole.work.cycles + 1, "writes": whole.work.writes});
        assert_eq!(row(1), &json!({"engine": "tick", "differs": {"found": found, "expected": expected}}));
        assert_eq!(row(2), &json!({"engine": "jit", "absent": "why"}));
        assert!(!table.agrees());
        // Of all engines the first that took part stands for the table.
        let head = [
            ("engine", json!("fast")),
            ("cpu_ms_median", json!(0.5)),
            ("ms_min", json!(0.1)),
            ("repeat", json!(9)),
        ];
        let head = head.into_iter().chain([
            ("triangles", json!(4)),
            ("fragments", json!(whole.fragments)),
            ("cycles", json!(whole.work.cycles)),
            ("machine", json!(plan.hash())),
        ]);
        head.for_each(|(key, value)| assert_eq!(json[key], value, "{key}"));

        // The text has the same figures, rounded.
        let text = table.text();
        let lines: Vec<&str> = text.lines().collect();
        let (first, of) = (&whole.work.cycles, plan.hash());
        assert_eq!(
            lines[0],
            format!(
                "4 triangles, {} fragments, {first} cycles a frame, machine {of}; median of 9 frames",
                whole.fragments
            )
        );
        let columns = [
            "engine",
            "CPU ms",
            "CPU min",
            "noise",
            "first ms",
            "Mcycle/s",
            "Mpixel/s",
            "Mtriangle/s",
            "ratio",
        ];
        assert_eq!(lines[1].split_whitespace().collect::<String>(), columns.concat().replace(' ', ""));
        for (place, more) in
            [(0, String::new()), (3, format!("  first 3 triangles, {} cycles", part.work.cycles))]
        {
            let figure = |key: &str| row(place)[key].as_f64().unwrap();
            let noise = row(place)["noise"]
                .as_f64()
                .map_or("-".to_owned(), |noise| format!("{:.1} %", noise * 100.0));
            let wanted = format!(
                "{:<12}{:>10.3}{:>10.3}{noise:>8}{:>11.1}{:>11.3}{:>10.3}{:>12.4}{:>9.2}{more}",
                row(place)["engine"].as_str().unwrap(),
                figure("cpu_ms_median"),
                figure("ms_min"),
                figure("first_ms"),
                figure("cycles_per_second") / 1e6,
                figure("pixels_per_second") / 1e6,
                figure("triangles_per_second") / 1e6,
                figure("ratio_to_verilator"),
            );
            assert_eq!(lines[2 + place], wanted);
        }
        let (cycles, writes) = (whole.work.cycles, whole.work.writes);
        let differs =
            format!("{} cycles instead of {cycles}, {writes} writes instead of {writes}", cycles + 1);
        assert_eq!(lines[3], format!("{:<12}  differs from the machine: {differs}", "tick"));
        assert_eq!(lines[4], format!("{:<12}  why", "jit"));
    }

    /// A part of polygons has no open contour, and is counted in polygons.
    #[test]
    fn a_part_has_whole_polygons() {
        let polygon = edgewalk_machine::Polygon { edges: 8, ..Default::default() };
        let plan =
            Machine { width: 24, height: 20, guard_bits: 6, polygon, ..Machine::default() }.plan().unwrap();
        let corner = |x, y| plan.port_vertex(x, y, &[0.5, 0.5, 0.5, 0.5]).unwrap();
        let contour = vec![corner(1.0, 1.0), corner(20.0, 2.0), corner(18.0, 17.0), corner(3.0, 15.0)];
        let one = plan.polygon(std::slice::from_ref(&contour), plan.window_from(&contour));
        let (all, shading) = ([one.clone(), one.clone(), one.clone()].concat(), Shading::default());
        let whole = Job::new(&plan, &all, &shading, (DrawState::default(), Waits::Never), 1).unwrap();
        assert_eq!((one.len(), whole.counted().to_string()), (2, "3 polygons".to_owned()));
        for cycles in 1..=whole.work.cycles {
            let part = whole.part(cycles).unwrap();
            assert_eq!(part.triangles.len(), 2 * part.counted().polygons, "{cycles} cycles");
        }
    }

    /// A frame that differs is not hidden by those before or after it.
    #[test]
    fn one_frame_that_differs_counts() {
        let plan = Machine { width: 24, height: 20, guard_bits: 6, ..Machine::default() }.plan().unwrap();
        let (all, shading) = (triangles(&plan), Shading::default());
        let job = Job::new(&plan, &all, &shading, (DrawState::default(), Waits::Never), 4).unwrap();
        let wrong = Work { writes: job.work.writes - 1, ..job.work };
        for odd in 0..5 {
            let mut frame = 0..;
            let draw = || Ok(if frame.next() == Some(odd) { wrong } else { job.work });
            let times = job.time(&crate::stopwatch::Stopwatch::start(), draw).unwrap();
            assert_eq!((times.work, times.frames.len()), (wrong, 4), "frame {odd}");
        }
    }
}
