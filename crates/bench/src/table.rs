//! The figures, as a table and as one line of JSON.

use super::job::{Job, Times};
use serde::Serialize;
use serde_json::json;

/// One engine's figures.
#[derive(Serialize)]
pub struct Row {
    engine: &'static str,
    /// Why it took no part.
    #[serde(skip_serializing_if = "Option::is_none")]
    absent: Option<String>,
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
    triangles: usize,
    fragments: u64,
    cycles: u64,
    cycles_per_second: f64,
    pixels_per_second: f64,
    triangles_per_second: f64,
    /// Simulated cycles a second, Verilator's being 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    ratio_to_verilator: Option<f64>,
}

impl Row {
    /// What an engine needed for its part.
    pub fn new(engine: &'static str, job: &Job, times: &Times) -> Row {
        let mut cpu: Vec<f64> = times.frames.iter().map(|time| time.cpu).collect();
        cpu.sort_by(f64::total_cmp);
        let quantile = |quarters: usize| cpu[(cpu.len() - 1) * quarters / 4];
        let median = quantile(2);
        let a_second = |count: u64| count as f64 * 1e3 / median;
        let figures = Figures {
            cpu_ms_median: median,
            ms_min: cpu[0],
            noise: (cpu.len() >= 4).then(|| (quantile(3) - quantile(1)) / median),
            first_ms: times.first,
            triangles: job.triangles.len(),
            fragments: job.fragments,
            cycles: job.work.cycles,
            cycles_per_second: a_second(job.work.cycles),
            pixels_per_second: a_second(job.fragments),
            triangles_per_second: a_second(job.triangles.len() as u64),
            ratio_to_verilator: None,
        };
        Row { engine, absent: None, figures: Some(figures) }
    }

    /// An engine that took no part.
    pub fn absent(engine: &'static str, why: String) -> Row {
        Row { engine, absent: Some(why), figures: None }
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

    /// As JSON. The first engine that took part, the fastest, stands for all.
    pub fn json(&self) -> serde_json::Value {
        let first = self.rows.iter().find_map(|row| Some((row.engine, row.figures.as_ref()?)));
        json!({
            "renderer": "edgewalk",
            "engine": first.map(|(engine, _)| engine),
            "cpu_ms_median": first.map(|(_, figures)| figures.cpu_ms_median),
            "ms_min": first.map(|(_, figures)| figures.ms_min),
            "repeat": self.whole.repeat,
            "triangles": self.whole.triangles.len(),
            "fragments": self.whole.fragments,
            "cycles": self.whole.work.cycles,
            "machine": self.whole.machine.hash(),
            "engines": self.rows,
        })
    }

    /// As a page of text.
    pub fn text(&self) -> String {
        let whole = self.whole;
        let mut text = format!(
            "{} triangles, {} fragments, {} cycles a frame, machine {}; median of {} frames\n\
             {:<12}{:>10}{:>10}{:>8}{:>11}{:>11}{:>10}{:>12}{:>9}\n",
            whole.triangles.len(),
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
            "Mtriangle/s",
            "ratio",
        );
        for row in &self.rows {
            text += &match &row.figures {
                Some(figures) => self.line(row.engine, figures),
                None => format!("{:<12}  {}\n", row.engine, row.absent.as_deref().unwrap_or_default()),
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
        if f.triangles < self.whole.triangles.len() {
            line += &format!("  first {} triangles, {} cycles", f.triangles, f.cycles);
        }
        line + "\n"
    }
}
