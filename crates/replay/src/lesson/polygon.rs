//! The lesson of POLY: one polygon through LOAD, PASS and MOVER. What comes when follows from the corners, by section 19 of
//! `docs/machine.md`; the recording has the values of the registers.

use super::Lesson;
use super::teacher::{Teacher, register_of};
use crate::recording::{Column, Recording};
use edgewalk_machine::{EdgeKind, Plan, PortVertex, Role, VertexError, Window};

/// The slides' polygon, its pixels' centres half a pixel further.
const CORNERS: [[f64; 2]; 6] = [[2.0, 3.0], [7.0, 1.0], [13.0, 5.0], [13.0, 11.0], [7.0, 7.0], [2.0, 9.0]];

/// The polygon of the lesson as the port takes it, on [`super::SCREEN`]; its values lie in a plane.
///
/// # Errors
/// A machine whose vertices cannot be there.
pub fn polygon(plan: &Plan) -> Result<Vec<[PortVertex; 3]>, VertexError> {
    let corner = |[x, y]: [f64; 2]| {
        let mut values = vec![0.25 + x / 32.0, x / 16.0, y / 16.0, 0.5];
        values.resize(plan.channels().len() + usize::from(plan.has_triangle_kt()), 0.0);
        plan.port_vertex(x + 0.5, y + 0.5, &values)
    };
    let contour = CORNERS.into_iter().map(corner).collect::<Result<Vec<_>, _>>()?;
    let window = plan.window_from(&contour);
    Ok(plan.polygon(&[contour], window))
}

/// An edge that LOAD takes.
#[derive(Clone, Copy)]
struct Edge {
    /// Upper and lower end.
    ends: [PortVertex; 2],
    /// First line, and the line behind the last.
    lines: [i128; 2],
    /// The registers of its walk: C, R, q, f, M.
    walk: [i128; 5],
}

struct Walk<'a> {
    plan: &'a Plan,
    recording: &'a Recording,
    teacher: Teacher<'a>,
    window: Window,
    edges: Vec<Edge>,
    channel: usize,
    /// Cycles in which a pair comes to its place, and in which a line is handed over.
    pairs: Vec<u32>,
    fires: Vec<u32>,
}

/// Walks the tokens of a polygon, alone on an empty screen; `channel` is the one that is shown.
///
/// # Errors
/// What the text asks for and the recording does not have, in words; a machine without POLY, or with bilinear colours.
pub fn polygon_lesson(
    plan: &Plan,
    tokens: &[[PortVertex; 3]],
    recording: &Recording,
    channel: usize,
) -> Result<Lesson, String> {
    if !plan.polygon.is_there() {
        return Err(
            "polygon.edges = 0: the lesson of a polygon goes through POLY; permitted: 8 and more".to_owned()
        );
    }
    if plan.polygon.is_bilinear() {
        return Err("polygon.values = bilinear: the lesson goes through planes; permitted: plane".to_owned());
    }
    let last = tokens.last().ok_or("the polygon has no line")?;
    let window = Window::of(last);
    let mut walk = Walk {
        plan,
        recording,
        teacher: Teacher::new(recording),
        window,
        edges: Vec::new(),
        channel,
        pairs: Vec::new(),
        fires: Vec::new(),
    };
    walk.known();
    walk.load(tokens)?;
    walk.plane(last)?;
    walk.lines()?;
    Ok(walk.teacher.lesson)
}

impl Walk<'_> {
    /// The machine's constants.
    fn known(&mut self) {
        let (plan, w) = (self.plan, self.plan.widths());
        let channel = plan.channels()[self.channel];
        let half = if channel.kind.is_rounded() { (1u64 << channel.fraction) >> 1 } else { 0 };
        for (name, value) in [
            ("s", i128::from(plan.subpixel_bits)),
            ("t", w.center_fraction.into()),
            ("P", 1 << w.center_fraction),
            ("W", plan.width.into()),
            ("H", plan.height.into()),
            ("F", plan.edge_fraction.into()),
            ("o", 0),
            ("slope", (plan.edge_kind == EdgeKind::Slope).into()),
            ("walked", 1),
            ("b", channel.bits.into()),
            ("r", channel.fraction.into()),
            ("e", channel.vertex_fraction.into()),
            ("half", half.into()),
            ("x0", self.window.x0.into()),
            ("y0", self.window.y0.into()),
        ] {
            self.teacher.set(name, value);
        }
    }

    /// LOAD: the edges in the order in which it takes them, and the order list.
    fn load(&mut self, tokens: &[[PortVertex; 3]]) -> Result<(), String> {
        let run = self.column("run")?;
        let begin = run.at.iter().zip(&run.value).find(|(_, value)| **value == 1).map(|(at, _)| *at);
        let begin = begin.and_then(|cycle| cycle.checked_sub(1)).ok_or("the polygon is never walked")?;
        let found: Vec<[PortVertex; 2]> = tokens.iter().flat_map(sides).collect();
        let mut edges = Vec::new();
        for ends in found {
            let [first, last] = ends.map(|end| self.plan.first_pixel(end.y()));
            let lines = self.plan.lines_of([first, last], self.window);
            if !lines.is_empty() {
                edges.push((ends, [lines.start, lines.end].map(i128::from)));
            }
        }
        self.teacher.moments.insert("begin", begin);
        self.teacher.set("tokens", tokens.len() as i128);
        self.teacher.set("count", edges.len() as i128);
        self.teacher.step("poly", &[], true)?;
        for (index, (ends, lines)) in edges.iter().enumerate() {
            let entering = [("C_valid", 1), ("entering", 1), ("C.edge", index as u64)];
            let cycle = self.first_cycle(&entering)?;
            self.teacher.moments.insert("enter", cycle);
            self.edge(index, *ends, *lines)?;
        }
        let mut order: Vec<usize> = (0..self.edges.len()).collect();
        order.sort_by_key(|index| self.edges[*index].lines[0]); // stable
        self.teacher.step("poly_order", &[], true)?;
        for (row, index) in order.iter().enumerate().take(8) {
            self.teacher.set("k", *index as i128);
            self.teacher.set("j", self.edges[*index].lines[0]);
            self.teacher.block("poly_place", &[("i", &row.to_string())], true)?;
        }
        Ok(())
    }

    fn edge(&mut self, index: usize, ends: [PortVertex; 2], lines: [i128; 2]) -> Result<(), String> {
        let centre = (1 << self.plan.widths().center_fraction) / 2;
        let scale = 1 << (self.plan.widths().center_fraction - self.plan.subpixel_bits);
        for (name, vertex) in ["a", "b"].into_iter().zip(ends) {
            for (axis, at) in [("u", vertex.x()), ("v", vertex.y())] {
                self.teacher.set(&format!("{axis}{name}"), i128::from(at) * scale - centre);
            }
        }
        self.teacher.set("k", index as i128);
        self.teacher.set("j", lines[0]);
        self.teacher.set("n", lines[1] - lines[0]);
        self.teacher.set("long", i128::from(index == 0));
        self.teacher.step("poly_edge", &[], true)?;
        self.teacher.block("edge", &[("e", "C"), ("u", "poly")], true)?;
        let walk = ["C", "R", "q", "f", "M"].map(|part| self.teacher.value(part));
        self.edges.push(Edge { ends, lines, walk });
        Ok(())
    }

    /// The increments of the channel that is shown.
    fn plane(&mut self, corners: &[PortVertex; 3]) -> Result<(), String> {
        self.fires = self.recording.fires("line")?;
        let first = *self.fires.first().ok_or("no line is ever handed over")?;
        self.teacher.moments.insert("fire", first);
        let centre = (1 << self.plan.widths().center_fraction) / 2;
        let scale = 1 << (self.plan.widths().center_fraction - self.plan.subpixel_bits);
        for (k, corner) in corners.iter().enumerate() {
            self.teacher.set(&format!("u{k}"), i128::from(corner.x()) * scale - centre);
            self.teacher.set(&format!("v{k}"), i128::from(corner.y()) * scale - centre);
            self.teacher.set(&format!("c{k}"), corner.values()[self.channel]);
        }
        let channel = self.plan.channels()[self.channel].name;
        self.teacher.step("poly_plane", &[("c", channel)], true)
    }

    /// PASS and MOVER, line by line.
    fn lines(&mut self) -> Result<(), String> {
        let waits = self.column("pair")?;
        let rises = waits.at.iter().zip(&waits.value).filter(|(_, value)| **value == 1);
        self.pairs = rises.map(|(at, _)| *at).collect();
        let top = self.edges.iter().map(|edge| edge.lines[0]).min().unwrap_or(0);
        let end = self.edges.iter().map(|edge| edge.lines[1]).max().unwrap_or(0);
        let (mut pair, mut span) = (0, 0);
        let (mut at_line, mut at_column) = (i128::from(self.window.y0), i128::from(self.window.x0));
        for line in top..end {
            let mut active: Vec<usize> = (0..self.edges.len())
                .filter(|k| (self.edges[*k].lines[0]..self.edges[*k].lines[1]).contains(&line))
                .collect();
            if active.is_empty() {
                continue;
            }
            self.teacher.set("line", line);
            self.teacher.step("poly_line", &[], true)?;
            for index in &active {
                self.step_edge(*index, line)?;
            }
            // Of equal columns any order has the same pairs.
            active.sort_by_key(|index| self.edges[*index].walk[0]);
            for two in active.chunks_exact(2) {
                let [left, right] = [two[0], two[1]].map(|index| self.edges[index].walk[0]);
                let cycle = *self.pairs.get(pair).ok_or("a pair never comes")?;
                pair += 1;
                self.teacher.moments.insert("pair", cycle);
                for (name, value) in [("Cl", left), ("Cr", right), ("Xb", at_column), ("Yb", at_line)] {
                    self.teacher.set(name, value);
                }
                self.teacher.block("poly_pair", &[], true)?;
                let [first, behind] = [left.max(0), right.min(self.plan.width.into())];
                if first < behind {
                    let cycle = *self.fires.get(span).ok_or("a line is never handed over")?;
                    span += 1;
                    self.teacher.moments.insert("fire", cycle);
                    let channel = self.plan.channels()[self.channel].name;
                    self.teacher.block("poly_mover", &[("c", channel)], true)?;
                    (at_line, at_column) = (line, first);
                }
            }
        }
        Ok(())
    }

    /// An edge on a line: as it was loaded, or stepped from the line before.
    fn step_edge(&mut self, index: usize, line: i128) -> Result<(), String> {
        let visit = [("C_valid", 1), ("entering", 0), ("C.edge", index as u64), ("y", line as u64)];
        let cycle = self.first_cycle(&visit)?;
        self.teacher.moments.insert("visit", cycle);
        let Edge { lines, walk, ends } = self.edges[index];
        for (name, value) in ["Cb", "Rb", "q", "f", "M"].into_iter().zip(walk) {
            self.teacher.set(name, value);
        }
        self.teacher.set("k", index as i128);
        self.teacher.set("enters", i128::from(lines[0] == line));
        self.teacher.set("leaves", i128::from(lines[1] == line + 1));
        self.teacher.block("poly_step", &[], true)?;
        let mut walk = walk;
        (walk[0], walk[1]) = (self.teacher.value("C"), self.teacher.value("R"));
        self.edges[index] = Edge { ends, lines, walk };
        Ok(())
    }

    fn column(&self, name: &str) -> Result<&Column, String> {
        let structure = self.recording.view.structure();
        let id = structure.unit("poly").and_then(|unit| register_of(structure, unit, name));
        let id = id.ok_or_else(|| format!("there is no register poly {name}"))?;
        Ok(&self.recording.columns[id])
    }

    /// The first cycle in which registers of POLY hold these values.
    fn first_cycle(&self, wanted: &[(&str, u64)]) -> Result<u32, String> {
        let columns = wanted
            .iter()
            .map(|(name, value)| Ok((self.column(name)?, *value)))
            .collect::<Result<Vec<_>, String>>()?;
        let holds = |cycle: &u32| columns.iter().all(|(column, value)| column.in_cycle(*cycle) == *value);
        (0..self.recording.cycles).find(holds).ok_or_else(|| format!("{wanted:?} never holds in POLY"))
    }
}

/// The edges of a token in the order in which LOAD takes them, each from its upper to its lower end: the long one of the triangle first.
fn sides(token: &[PortVertex; 3]) -> Vec<[PortVertex; 2]> {
    let mut order = [0, 1, 2];
    order.sort_by_key(|vertex| token[*vertex].y()); // stable
    let counts = |a: usize, b: usize| {
        // The side that lies between two vertices begins at the one of them whose next is the other.
        let side = if (a + 1) % 3 == b { a } else { b };
        Role::of(token).sides().has(side)
    };
    [[0, 2], [0, 1], [1, 2]]
        .map(|pair| pair.map(|place: usize| order[place]))
        .into_iter()
        .filter(|[a, b]| counts(*a, *b))
        .map(|pair| pair.map(|vertex| token[vertex]))
        .collect()
}
