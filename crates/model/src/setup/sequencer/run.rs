//! A triangle on its way through the program.

use super::factors::{Digits, Pair};
use super::lane::{Addend, Formats, Lane, Number, signed};
use super::slow::{Ran, SlowSetup};
use crate::setup::Culled;
use crate::tokens::{Prim, sign_extend};
use edgewalk_machine::sequencer::word::{
    Act, Control, Corner, Drop, Factor, Give, Only, Part, Row, Step, Word, Write,
};
use edgewalk_machine::sequencer::{NAMED_ROWS, edges_are_beside};
use edgewalk_machine::{Fill, PortVertex, Role};

/// A word that waits this long sees what a row or a check has become.
const BEHIND: u32 = 3;

/// Where the program is, and all that its words change.
pub(super) struct Run<'a, const C: usize> {
    setup: &'a SlowSetup,
    vertices: &'a [PortVertex; 3],
    light_pass: bool,
    lanes: Vec<Lane>,
    factors: Vec<Pair>,
    digits: Digits,
    /// Place of the next word.
    place: u16,
    /// Of the word behind the call.
    link: u16,
    clock: u32,
    /// Words executed when no prim waits any more.
    room: Option<u32>,
    over: bool,
    culled: Option<Culled>,
    /// Numbers of the vertices, in their order so far.
    order: [usize; 3],
    /// Round of channels, or the edge.
    number: usize,
    beside: bool,
    /// A < 0 as tests see it: before the step of the word before.
    negative: bool,
    right: bool,
    /// The upper and the lower part have lines.
    lines: [bool; 2],
    unfit: bool,
    checked: u32,
    count: u32,
    /// The counter is that of a channel's doublings.
    counts_channels: bool,
    /// i.
    scale: u32,
    /// Clocks in which rows were written.
    written: [u32; NAMED_ROWS as usize],
    early: u32,
    prim: Prim<C>,
}

impl<'a, const C: usize> Run<'a, C> {
    pub fn new(setup: &'a SlowSetup, vertices: &'a [PortVertex; 3], light_pass: bool) -> Self {
        let plan = &setup.plan;
        let lanes = (0..plan.lanes).map(|_| first_rows(setup)).collect();
        Run {
            setup,
            vertices,
            light_pass,
            lanes,
            factors: vec![Pair::default(); plan.lanes as usize],
            digits: Digits::new(plan.widths().center + 2),
            place: 0,
            link: 0,
            clock: BEHIND,
            room: None,
            over: false,
            culled: None,
            order: [0, 1, 2],
            number: 0,
            beside: false,
            negative: false,
            right: false,
            lines: [false; 2],
            unfit: false,
            checked: 0,
            count: 0,
            counts_channels: false,
            scale: 0,
            written: [0; NAMED_ROWS as usize],
            early: 0,
            prim: Prim::default(),
        }
    }

    pub fn is_over(&self) -> bool {
        self.over
    }

    pub fn clocks(&self) -> u32 {
        self.clock - BEHIND
    }

    pub fn ran(self) -> Ran<C> {
        let clocks = self.room.unwrap_or(self.clocks());
        let load = self.clocks() - clocks;
        Ran { clocks, load, culled: self.culled, prim: self.prim, early: self.early }
    }

    /// Executes a word once.
    pub fn word(&mut self) {
        let setup = self.setup;
        let Some(word) = setup.program.words.get(usize::from(self.place)) else {
            self.place = 0; // behind the last word: only an altered program comes here
            self.clock += 1;
            return;
        };
        let negative = self.lanes[0].now.a < 0;
        let digits: Vec<u8> = (0..self.lanes.len()).map(|lane| self.digits_of(lane)).collect();
        let zero = self.counted().all(|lane| digits[lane] == 0);
        self.step(word, &digits);
        if let Some(give) = word.give {
            self.give(give);
        }
        if let Some((factor, row)) = word.factor {
            self.load(factor, row);
        }
        if let Some(Write { row, only_a, numbered }) = word.write {
            let row = if numbered { self.numbered(row) } else { row };
            self.lanes.iter_mut().for_each(|lane| lane.write(row, only_a));
            self.written[usize::from(row)] = self.clock;
        }
        let next = self.next(word.control, zero);
        if let Some(act) = word.act {
            self.act(act);
        }
        self.place = next;
        self.negative = negative;
        self.clock += 1;
    }

    fn step(&mut self, word: &Word, digits: &[u8]) {
        let Some(Step { base, row, operand, sign, only }) = word.step else { return };
        for (lane, digit) in (0..self.lanes.len()).zip(digits) {
            let formats = self.formats(lane);
            let value = self.read(row, lane, *digit);
            let a = self.lanes[lane].now.a;
            let holds = self.counts_channels
                && word.control == Control::Again
                && self.count <= self.spare_doublings(lane);
            let done = match only {
                Only::Always => true,
                Only::Negative => a < 0,
                Only::Positive => a >= 0,
                Only::NoUpper => !self.lines[0],
                Only::Right => self.right,
                Only::Thin => Role::of(self.vertices) != Role::Triangle,
            };
            if done && !holds {
                self.lanes[lane].step(&Addend { base, row: value, operand, sign }, &formats);
            }
            let unfit = (a < 0) == (self.lanes[lane].now.a < 0);
            if word.act == Some(Act::Check) && unfit && (!self.beside || self.is_counted(lane)) {
                self.unfit = true;
            }
        }
        if word.act == Some(Act::Check) {
            self.checked = self.clock;
        }
    }

    /// Doublings that the lane's channel has less than the longest of its round.
    fn spare_doublings(&self, lane: usize) -> u32 {
        self.setup.doublings_of_round(self.number) - self.formats(lane).doublings
    }

    fn formats(&self, lane: usize) -> Formats {
        let plan = &self.setup.plan;
        let channel = plan.channels().get(self.channel(lane));
        let most = self.setup.doublings_of_round(self.number);
        Formats {
            rest_bits: self.setup.rest_bits(),
            factor_bits: self.digits.bits(),
            below_column: self.setup.slope_fraction().map_or(0, |fraction| fraction + 1),
            center_fraction: plan.widths().center_fraction,
            doublings: channel.map_or(most, |channel| self.setup.doublings(channel)),
            right: self.right,
        }
    }

    fn channel(&self, lane: usize) -> usize {
        lane + self.number * self.lanes.len()
    }

    /// The lane whose digits a lane goes by.
    fn digits_of(&self, lane: usize) -> u8 {
        let own = self.beside && lane < 3;
        self.factors[if own { lane } else { 0 }].digits(self.digits.bits())
    }

    /// The lanes that say how many digits there are, and whether all fits.
    fn counted(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.lanes.len()).filter(|lane| self.is_counted(*lane))
    }

    fn is_counted(&self, lane: usize) -> bool {
        match lane {
            0 => true,
            1 | 2 => self.beside && self.lines[lane - 1],
            _ => false,
        }
    }

    fn edge(&self, lane: usize) -> usize {
        if self.beside { lane } else { self.number }
    }

    /// The row of a table.
    fn numbered(&self, table: u8) -> u8 {
        table | self.number as u8 & 7
    }

    fn read(&mut self, row: Row, lane: usize, digits: u8) -> Number {
        let plan = &self.setup.plan;
        let named = match row {
            Row::Named(row) => row,
            Row::Digits(table) => table + digits,
            Row::Edge(table) => table + (self.edge(lane) as u8 & 3),
            Row::Number(table) => self.numbered(table),
            Row::Pass(table) if Role::of(self.vertices) == (Role::Line { flat: true }) => {
                let [height, width] = ["height", "width"].map(|name| self.setup.program.row(name));
                (if table == height { width } else { height }) + u8::from(self.light_pass)
            }
            Row::Pass(table) => table + u8::from(self.light_pass),
            Row::Vertex(corner, part) => {
                let place = match corner {
                    Corner::Place(place) => place.into(),
                    Corner::Upper => usize::from(self.edge(lane) == 2),
                    Corner::Lower if self.edge(lane) == 1 => 1,
                    Corner::Lower => 2,
                };
                return Number { a: self.vertex(self.order[place], part, lane), w: 0 };
            }
            Row::OfChannel => {
                let Some(channel) = plan.channels().get(self.channel(lane)) else { return Number::default() };
                let p = 1i128 << plan.widths().center_fraction;
                let rounds = channel.kind.is_rounded() && channel.fraction > 0;
                let half = if rounds { 1i128 << (channel.fraction - 1) } else { 0 };
                return Number { a: 0, w: p / 2 + half * p };
            }
        };
        if self.clock < self.written[usize::from(named)] + BEHIND {
            self.early += 1;
        }
        self.lanes[lane].row(named)
    }

    /// A word of a vertex as it stands in its row.
    fn vertex(&self, number: usize, part: Part, lane: usize) -> i128 {
        let plan = &self.setup.plan;
        let vertex = &self.vertices[number];
        let coordinate = |value: i32| {
            let value = signed(value.into(), plan.widths().vertex);
            if plan.subpixel_bits == 0 { 2 * value } else { value }
        };
        match part {
            Part::X => coordinate(vertex.x()),
            Part::Y => coordinate(vertex.y()),
            Part::Value => {
                let place = self.channel(lane);
                let Some(channel) = plan.channels().get(place) else { return 0 };
                let value = i128::from(vertex.values()[place]);
                let bits = channel.vertex_bits();
                if channel.kind.is_signed() { signed(value, bits) } else { value & ((1 << bits) - 1) }
            }
        }
    }

    fn load(&mut self, factor: Factor, row: Row) {
        let bits = self.digits.bits();
        for lane in 0..self.lanes.len() {
            let value = self.read(row, lane, 0).a as u64 & ((1 << bits) - 1);
            match factor {
                Factor::F => self.factors[lane].f = value,
                Factor::G => self.factors[lane].g = value,
            }
        }
        self.digits.load();
        if factor == Factor::G {
            let counted: Vec<usize> = self.counted().collect();
            self.digits.skip(self.clock, &mut self.factors, |lane| counted.contains(&lane));
        }
    }

    fn shift(&mut self) {
        let bits = self.digits.bits();
        self.factors.iter_mut().for_each(|pair| pair.shift(1, bits));
    }

    /// The place of the next word; the digits go on where the word says so.
    fn next(&mut self, control: Control, zero: bool) -> u16 {
        let (same, behind) = (self.place, self.place + 1);
        let last = self.digits.is_last();
        let goes = |condition: bool, to: u16| if condition { to } else { behind };
        match control {
            Control::Next | Control::Words => behind,
            Control::Room => {
                self.room = Some(self.clocks() + 1);
                behind
            }
            Control::Settle if self.digits.are_settled(self.clock) => behind,
            Control::Settle => same,
            Control::Digits => {
                self.shift();
                self.digits.next();
                goes(!last, same)
            }
            Control::Again => {
                let done = self.count == 1;
                self.count = self.count.wrapping_sub(1);
                goes(!done, same)
            }
            Control::Zeros(_) if !zero => behind,
            Control::Zeros(to) => {
                self.shift();
                self.digits.next();
                if last { to } else { same }
            }
            Control::More(to) => {
                self.shift();
                self.digits.next();
                goes(!last, to)
            }
            Control::Negative(to) => goes(self.negative, to),
            Control::Unfit(to) => {
                self.early += u32::from(self.clock < self.checked + BEHIND);
                goes(self.unfit, to)
            }
            Control::NoUpper(to) => goes(!self.lines[0], to),
            Control::NoLower(to) => goes(!self.lines[1], to),
            Control::Rounds(to) => {
                let more = self.number > 0;
                self.number = self.number.saturating_sub(1);
                goes(more, to)
            }
            Control::Goto(to) => to,
            Control::Call(to) => {
                self.link = behind;
                to
            }
            Control::Return => self.link,
        }
    }

    fn act(&mut self, act: Act) {
        match act {
            Act::Unsorted => self.order = [0, 1, 2],
            Act::Swap01 if self.negative => self.order.swap(0, 1),
            Act::Swap12 if self.negative => self.order.swap(1, 2),
            Act::Swap01 | Act::Swap12 | Act::Check => {}
            Act::Side => {
                self.right = self.negative;
                self.prim.major_right = self.right;
            }
            Act::Upper => self.lines[0] = !self.negative,
            Act::Lower => self.lines[1] = !self.negative,
            Act::Shift => self.shift(),
            Act::Judge => self.unfit = false,
            Act::TimesT => self.times(self.setup.plan.widths().center_fraction, false),
            Act::TimesF => self.times(self.setup.plan.edge_fraction, false),
            Act::TimesTf => {
                let fraction = self.setup.plan.edge_fraction;
                self.times(self.setup.plan.widths().center_fraction + fraction, false);
            }
            Act::TimesK => self.times(self.setup.doublings_of_round(self.number) + self.scale, true),
            Act::Scale => self.scale += 3,
            Act::LastRound => {
                self.number = self.setup.rounds - 1;
                self.scale = 0;
            }
            Act::Edge(edge) => self.number = edge.into(),
            Act::Beside => {
                self.beside = true;
                self.number = 0;
            }
            Act::Alone => self.beside = false,
            Act::Drop(drop) => {
                self.over = true;
                self.culled = Some(match drop {
                    Drop::Lines => Culled::Lines,
                    Drop::Columns => Culled::Columns,
                    Drop::Area => Culled::Area,
                });
            }
            Act::Done => self.over = true,
        }
    }

    fn times(&mut self, count: u32, of_channels: bool) {
        self.count = count;
        self.counts_channels = of_channels;
    }

    fn give(&mut self, give: Give) {
        let t = self.setup.plan.widths().center_fraction;
        let Number { a, .. } = self.lanes[0].now;
        match give {
            Give::Jm => self.prim.line = (a >> t) as u32,
            Give::N1 => self.prim.lines[0] = (a >> t) as u32,
            Give::N2 => self.prim.lines[1] = (a >> t) as u32,
            Give::M | Give::Qf | Give::R | Give::C if edges_are_beside(&self.setup.plan) => {
                (0..3).for_each(|lane| self.give_edge(give, lane, lane));
            }
            Give::M | Give::Qf | Give::R | Give::C => self.give_edge(give, self.number, 0),
            Give::Start | Give::StartB | Give::D0 | Give::D1 | Give::G => self.give_channels(give),
        }
    }

    fn give_edge(&mut self, give: Give, edge: usize, lane: usize) {
        let t = self.setup.plan.widths().center_fraction;
        let column_bits = self.setup.plan.widths().column;
        if edge > 2 || (edge > 0 && !self.lines[edge - 1]) {
            return; // not walked; a number above 2 has only an altered program
        }
        let Number { a, w } = self.lanes[lane].now;
        let edge = if edge == 0 { &mut self.prim.major } else { &mut self.prim.minor[edge - 1] };
        if let Some(fraction) = self.setup.slope_fraction() {
            let fractions = ((w >> 1) & ((1 << fraction) - 1)) as i32;
            match give {
                Give::M => edge.m = 1 << fraction,
                Give::Qf => {
                    (edge.q, edge.f) = (sign_extend((w >> (fraction + 1)) as i32, column_bits), fractions);
                }
                Give::R => edge.r = fractions,
                _ => edge.c = sign_extend((a >> t) as i32, column_bits),
            }
            return;
        }
        match give {
            Give::M => edge.m = a as i32,
            Give::Qf => (edge.q, edge.f) = (sign_extend(w as i32, column_bits), (a >> t) as i32),
            Give::R => edge.r = (a >> t) as i32,
            _ => edge.c = sign_extend((a >> t) as i32, column_bits),
        }
    }

    fn give_channels(&mut self, give: Give) {
        let t = self.setup.plan.widths().center_fraction;
        let textbook = self.setup.plan.fill == Fill::Textbook;
        for lane in 0..self.lanes.len() {
            let place = self.channel(lane);
            let Some(channel) = self.setup.plan.channels().get(place) else { continue };
            let w = self.lanes[lane].now.w;
            let word = |shift: u32| (w >> shift) as u64 & ((1 << channel.word()) - 1);
            // In textbook fill a part without lines has no values.
            let of_part =
                |part: usize, shift: u32| if textbook && !self.lines[part] { 0 } else { word(shift) };
            match give {
                Give::Start => self.prim.start[0][place] = of_part(0, t),
                Give::StartB => self.prim.start[1][place] = of_part(1, t),
                Give::D0 => self.prim.delta[0][place] = of_part(0, 1),
                Give::D1 => self.prim.delta[1][place] = of_part(1, 1),
                _ => self.prim.gradient[place] = word(1),
            }
        }
    }
}

/// A lane with its constants.
fn first_rows(setup: &SlowSetup) -> Lane {
    let plan = &setup.plan;
    let p = 1i128 << plan.widths().center_fraction;
    let mut lane = Lane::new();
    let map = i128::from(plan.shadow.size) * p;
    for (name, index, value) in [
        ("one", 0, 1),
        ("half", 0, p / 2),
        ("up", 0, p / 2 - 1),
        ("pixel", 0, p),
        ("height", 0, i128::from(plan.height) * p),
        ("height", 1, map),
        ("width", 0, i128::from(plan.width) * p),
        ("width", 1, map),
    ] {
        lane.hold(setup.program.row(name) + index, value);
    }
    lane
}
