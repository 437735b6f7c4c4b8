//! The way through the lesson: which block comes when, and what is known then. What a triangle asks for decides, as it does
//! in the machine.

use super::Lesson;
use super::teacher::{Teacher, register_of};
use crate::recording::Recording;
use edgewalk_machine::{EdgeKind, Fill, Plan, PortVertex};
use edgewalk_model::view::{Moment, Structure};

const EDGES: [&str; 3] = ["major", "minor1", "minor2"];

/// What setup finds of a channel.
#[derive(Clone, Copy, Debug, Default)]
struct Steps {
    start: [i128; 2],
    delta: [i128; 2],
    g: i128,
    /// On the line that is walked.
    value: i128,
}

/// A line with pixels.
#[derive(Clone, Debug)]
struct Row {
    y: i128,
    x: i128,
    count: i128,
    values: Vec<i128>,
}

pub struct Course<'a> {
    plan: &'a Plan,
    recording: &'a Recording,
    structure: &'a Structure,
    corners: [PortVertex; 3],
    /// Which vertex of the port each corner was.
    order: [usize; 3],
    channel: usize,
    teacher: Teacher<'a>,
    steps: Vec<Steps>,
    rows: Vec<Row>,
}

impl<'a> Course<'a> {
    pub fn new(
        plan: &'a Plan,
        corners: &[PortVertex; 3],
        recording: &'a Recording,
        channel: usize,
    ) -> Result<Self, String> {
        let mut order = [0, 1, 2];
        order.sort_by_key(|i| corners[*i].y()); // stable
        if channel >= plan.channels().len() {
            return Err(format!("the machine has no channel {channel}"));
        }
        Ok(Course {
            plan,
            recording,
            structure: recording.view.structure(),
            corners: order.map(|i| corners[i]),
            order,
            channel,
            teacher: Teacher::new(recording),
            steps: vec![Steps::default(); plan.channels().len()],
            rows: Vec::new(),
        })
    }

    pub fn walk(mut self) -> Result<Lesson, String> {
        self.known();
        self.corners()?;
        self.edges()?;
        self.increments()?;
        self.lines()?;
        self.pixel()?;
        Ok(self.teacher.lesson)
    }

    fn is(&self, name: &str) -> bool {
        self.teacher.value(name) != 0
    }

    /// The machine's constants.
    fn known(&mut self) {
        let (plan, w, teacher) = (self.plan, self.plan.widths(), &mut self.teacher);
        let textbook = plan.fill == Fill::Textbook;
        for (name, value) in [
            ("s", plan.subpixel_bits),
            ("t", w.center_fraction),
            ("P", 1 << w.center_fraction),
            ("W", plan.width),
            ("H", plan.height),
            ("F", plan.edge_fraction),
            ("L", plan.latency),
            ("xb", w.x),
            ("T", plan.clocks_per_pixel()),
            ("o", textbook.into()),
            ("textbook", textbook.into()),
            ("exact", (!textbook).into()),
            ("slope", (plan.edge_kind == EdgeKind::Slope).into()),
        ] {
            teacher.set(name, value);
        }
    }

    /// The format of a channel, and its values at the corners.
    fn of_channel(&mut self, place: usize) {
        let channel = self.plan.channels()[place];
        let half = if channel.kind.is_rounded() { (1u64 << channel.fraction) >> 1 } else { 0 };
        let teacher = &mut self.teacher;
        teacher.set("b", channel.bits);
        teacher.set("r", channel.fraction);
        teacher.set("e", channel.vertex_fraction);
        teacher.set("half", half);
        for (k, corner) in self.corners.iter().enumerate() {
            teacher.set(&format!("a{k}"), corner.values()[place]);
        }
    }

    fn corners(&mut self) -> Result<(), String> {
        self.of_channel(self.channel);
        let channel = self.plan.channels()[self.channel].name;
        for (k, corner) in self.corners.iter().enumerate() {
            self.teacher.set(&format!("x{k}"), corner.x());
            self.teacher.set(&format!("y{k}"), corner.y());
            self.teacher.set(&format!("o{k}"), self.order[k] as u32);
        }
        self.teacher.step("vertices", &[], true)?;
        for k in ["0", "1", "2"] {
            self.teacher.block("corner", &[("k", k)], true)?;
        }
        self.teacher.block("value", &[("c", channel), ("n", word(channel))], true)?;
        self.teacher.step("area", &[], true)?;
        self.teacher.step("lines", &[], true)
    }

    fn edges(&mut self) -> Result<(), String> {
        let [n1, n2] = [self.is("n1"), self.is("n2")];
        for (edge, from, to, line, walked) in
            [("major", 0, 2, "jm", true), ("minor1", 0, 1, "j0", n1), ("minor2", 1, 2, "j1", n2)]
        {
            self.between(from, to, line);
            self.teacher.set("walked", i128::from(walked));
            self.teacher.set("long", i128::from(edge == EDGES[0]));
            self.teacher.step("edge", &[("e", edge), ("u", "setup")], true)?;
            for part in ["C", "R", "q", "f", "M"] {
                let value = self.teacher.value(part);
                self.teacher.set(&format!("{part}_{edge}"), value);
            }
        }
        Ok(())
    }

    /// An edge from corner to corner, from a line on.
    fn between(&mut self, from: usize, to: usize, line: &str) {
        let teacher = &mut self.teacher;
        for (end, corner) in [("a", from), ("b", to)] {
            for axis in ["u", "v", "c"] {
                let value = teacher.value(&format!("{axis}{corner}"));
                teacher.set(&format!("{axis}{end}"), value);
            }
        }
        let j = teacher.value(line);
        teacher.set("j", j);
    }

    fn increments(&mut self) -> Result<(), String> {
        for (place, channel) in self.plan.channels().iter().enumerate() {
            let shown = place == self.channel;
            let put = [("c", channel.name), ("n", word(channel.name))];
            self.of_channel(place);
            self.teacher.block("value", &put, false)?;
            for part in ["C", "R", "q", "f", "M"] {
                let value = self.teacher.value(&format!("{part}_major"));
                self.teacher.set(part, value);
            }
            self.teacher.step("plane", &put, shown)?;
            let value = |name| self.teacher.value(name);
            let mut steps = Steps { g: value("g"), ..Steps::default() };
            if self.plan.fill == Fill::Exact {
                (steps.start, steps.delta) = ([value("start"); 2], [value("d0"), value("d1")]);
            } else {
                for part in 0..2 {
                    let (start, delta) = self.left_edge(part, channel.name, shown)?;
                    (steps.start[part], steps.delta[part]) = (start, delta);
                }
            }
            self.steps[place] = steps;
        }
        Ok(())
    }

    /// First value and step of a part in textbook fill.
    fn left_edge(&mut self, part: usize, channel: &str, shown: bool) -> Result<(i128, i128), String> {
        let (from, to) = match (self.is("major_right"), part) {
            (false, _) => (0, 2),
            (true, 0) => (0, 1),
            (true, _) => (1, 2),
        };
        self.between(from, to, ["j0", "j1"][part]);
        let drawn = self.is(["n1", "n2"][part]);
        self.teacher.set("drawn", i128::from(drawn));
        let put = [("c", channel), ("n", word(channel)), ("k", ["a", "b"][part])];
        self.teacher.step("left", &put, shown)?;
        Ok((self.teacher.value("start"), self.teacher.value("d")))
    }

    /// Loads an edge: what is walked stands in `names`.
    fn load(&mut self, edge: &str, names: [&str; 5]) {
        for (part, name) in ["C", "R", "q", "f", "M"].into_iter().zip(names) {
            let value = self.teacher.value(&format!("{part}_{edge}"));
            self.teacher.set(name, value);
        }
    }

    fn lines(&mut self) -> Result<(), String> {
        let fires = self.recording.fires("line")?;
        let spans = self.recording.fires("span")?;
        let (mut n1, mut n2) = (self.teacher.value("n1"), self.teacher.value("n2"));
        let mut line = self.teacher.value("jm");
        self.load("major", ["CM", "RM", "qM", "fM", "MM"]);
        let first = if n1 > 0 { EDGES[1] } else { EDGES[2] };
        self.load(first, ["Cm", "Rm", "qm", "fm", "Mm"]);
        let textbook = self.plan.fill == Fill::Textbook;
        // How a line comes about: the major edge, the minor edge, and which increments.
        let mut major = "loadmajor";
        let (mut minor, mut knee) = ("loadminor", false);
        let mut part = usize::from(n1 == 0);
        for k in 0.. {
            if n1 + n2 == 0 {
                break;
            }
            let cycle = *fires.get(k).ok_or_else(|| format!("line {k} is never handed over"))?;
            self.teacher.moments.insert("line", cycle);
            self.teacher.set("line", line);
            self.teacher.set("knee", i128::from(knee));
            let kept = self.kept();
            self.teacher.step("line", &[], true)?;
            self.teacher.block(major, &[], true)?;
            self.teacher.block(minor, &[], true)?;
            let way = (major, textbook && major == "keepmajor", part);
            self.values(way, kept)?;
            self.teacher.block("carry", &[], true)?;
            self.teacher.block("cut", &[], true)?;
            self.row(line, &spans)?;

            knee = n1 == 1 && n2 > 0;
            (major, minor) = ("stepmajor", "stepminor");
            part = usize::from(n1 == 0);
            if knee {
                self.load(EDGES[2], ["Cm", "Rm", "qm", "fm", "Mm"]);
                minor = "loadminor";
            }
            if knee && textbook {
                major = "keepmajor";
            } else {
                line += 1;
            }
            (n1, n2) = if n1 > 0 { (n1 - 1, n2) } else { (0, n2 - 1) };
        }
        Ok(())
    }

    /// Keeps the edges as they were on the line before; gives whether the major one had a carry.
    fn kept(&mut self) -> bool {
        for (now, before) in [("C", "Cb"), ("R", "Rb"), ("Cn", "Cp"), ("Rn", "Rp")] {
            let value = self.teacher.value(now);
            self.teacher.set(before, value);
        }
        self.teacher.value("Rb") < self.teacher.value("fM")
    }

    /// The values of all channels on this line.
    fn values(&mut self, (major, again, part): (&str, bool, usize), carry: bool) -> Result<(), String> {
        for (place, channel) in self.plan.channels().iter().enumerate() {
            self.of_channel(place);
            let steps = self.steps[place];
            let loads = major == "loadmajor" || (again && self.is("major_right"));
            let of = if again { 1 } else { part };
            let delta = match self.plan.fill {
                Fill::Exact => steps.delta[usize::from(carry)],
                Fill::Textbook => steps.delta[part],
            };
            self.teacher.set("start", steps.start[of]);
            self.teacher.set("before", steps.value);
            self.teacher.set("d", if again { 0 } else { delta });
            let block = if loads { "first" } else { "next" };
            self.teacher.set("shown", i128::from(place == self.channel));
            let put = [("c", channel.name), ("n", word(channel.name))];
            self.teacher.block(block, &put, place == self.channel)?;
            self.steps[place].value = self.teacher.value("value");
        }
        Ok(())
    }

    /// The span of the line, if it has one.
    fn row(&mut self, y: i128, spans: &[u32]) -> Result<(), String> {
        let (x, count) = (self.teacher.value("x"), self.teacher.value("count"));
        if count == 0 {
            return Ok(());
        }
        let cycle = *spans.get(self.rows.len()).ok_or("a span is never handed over")?;
        self.teacher.moments.insert("span", cycle);
        self.teacher.block("span", &[], true)?;
        self.rows.push(Row { y, x, count, values: self.steps.iter().map(|steps| steps.value).collect() });
        Ok(())
    }

    /// A pixel of the longest span on its way to memory, and the causes of all cycles.
    fn pixel(&mut self) -> Result<(), String> {
        let leftward = self.plan.fill == Fill::Exact && self.is("major_right");
        let column = |row: &Row, k: i128| if leftward { row.x - k } else { row.x + k };
        let seen = 0..i128::from(self.plan.width);
        let visible =
            |row: &Row| -> Vec<i128> { (0..row.count).filter(|k| seen.contains(&column(row, *k))).collect() };
        let all: i128 = self.rows.iter().map(|row| row.count).sum();
        let pixels: i128 = self.rows.iter().map(|row| visible(row).len() as i128).sum();
        // Where a line is drawn twice, the first time.
        let new = |place: usize| self.rows[..place].iter().all(|row| row.y != self.rows[place].y);
        let first = self.rows.iter().enumerate().filter(|(place, _)| new(*place)).map(|(_, row)| row);
        let longest = first.max_by_key(|row| visible(row).len()).cloned();
        if let Some((row, k)) = longest.and_then(|row| {
            let list = visible(&row);
            list.get(1).or(list.first()).copied().map(|k| (row, k))
        }) {
            self.one_pixel(&row, column(&row, k), k)?;
        }
        self.teacher.set("pixels", pixels);
        self.teacher.set("lost", all - pixels);
        self.teacher.step("activity", &[], true)?;
        // Of the whole run: it ends there.
        self.teacher
            .lesson
            .steps
            .iter_mut()
            .last()
            .into_iter()
            .for_each(|step| step.cycle = self.recording.cycles - 1);
        Ok(())
    }

    fn one_pixel(&mut self, row: &Row, x: i128, k: i128) -> Result<(), String> {
        let addr = (row.y << self.plan.widths().x | x) as u64;
        self.teacher.moments.insert("pixel", self.emitted(x, row.y)?);
        for (name, moment) in [("frag", "fragment"), ("compare", "compare"), ("write", "written")] {
            let cycle = self.happens(moment, addr)?;
            self.teacher.moments.insert(name, cycle);
        }
        for (name, value) in [("x", x), ("y", row.y), ("k", k)] {
            self.teacher.set(name, value);
        }
        // The colour that is shown, then the depth, whose output the compare takes.
        let mut places: Vec<usize> = (1..self.plan.channels().len()).collect();
        places.push(0);
        for place in places {
            let channel = self.plan.channels()[place].name;
            self.of_channel(place);
            self.teacher.set("value0", row.values[place]);
            self.teacher.set("g", self.steps[place].g);
            self.teacher.step("pixel", &[("c", channel)], place == self.channel)?;
        }
        self.teacher.step("depth", &[("h", hazard(self.plan))], true)?;
        let read = self.teacher.moments.get("frag").copied().unwrap_or(0);
        let compared = self.teacher.moments.get("compare").copied().unwrap_or(0);
        self.teacher.set("read", read);
        self.teacher.moments.insert("compared", compared);
        self.teacher.step("memory", &[], true)
    }

    /// The cycle in which PIXEL has a pixel done.
    fn emitted(&self, x: i128, y: i128) -> Result<u32, String> {
        let unit = self.structure.unit("pixel").ok_or("there is no unit pixel")?;
        let column = |name: &str| {
            let id = register_of(self.structure, unit, name)
                .ok_or_else(|| format!("there is no register {name}"))?;
            Ok::<_, String>(&self.recording.columns[id])
        };
        let wanted = [
            (column("active")?, 1),
            (column("x")?, x as u64),
            (column("y")?, y as u64),
            (column("phase")?, u64::from(self.plan.clocks_per_pixel() - 1)),
        ];
        let holds = |cycle: &u32| wanted.iter().all(|(column, value)| column.in_cycle(*cycle) == *value);
        (0..self.recording.cycles).find(holds).ok_or_else(|| format!("pixel ({x}, {y}) never comes"))
    }

    /// The cycle in which this happens to the fragment of an address.
    fn happens(&self, title: &str, addr: u64) -> Result<u32, String> {
        let moments = self.structure.units.iter().flat_map(|unit| &unit.moments);
        let moment: &Moment = moments
            .into_iter()
            .find(|moment| moment.title == title)
            .ok_or_else(|| format!("there is no moment {title}"))?;
        let (when, token) = (&self.recording.columns[moment.when], &self.recording.columns[moment.token]);
        let kinds = self.recording.view.tokens().kinds();
        let holds = |cycle: &u32| {
            let number = token.in_cycle(*cycle);
            let met = kinds.iter().find(|kind| kind.name == "fragment").map(|kind| &kind.met);
            let own = met.and_then(|met| met.get((number as usize).checked_sub(1)?));
            when.in_cycle(*cycle) == 1 && own.is_some_and(|token| token[1] == addr)
        };
        (0..self.recording.cycles)
            .find(holds)
            .ok_or_else(|| format!("{title} never happens to address {addr}"))
    }
}

/// What the channel of this name is called.
fn word(name: &str) -> &str {
    let words = [("z", "depth"), ("r", "red"), ("g", "green"), ("b", "blue")];
    words.iter().find(|(own, _)| *own == name).map_or(name, |(_, word)| word)
}

fn hazard(plan: &Plan) -> &'static str {
    match plan.hazard {
        edgewalk_machine::Hazard::Drain => "drain",
        edgewalk_machine::Hazard::Interlock => "interlock",
        edgewalk_machine::Hazard::Forward => "forward",
    }
}
