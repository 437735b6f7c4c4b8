//! Cycles by cause, line by line of the screen and by size of triangle.
//!
//! A cycle belongs to the span that PIXEL has; a cycle without one belongs to the span that PIXEL gets next. Cycles behind the
//! last span belong to none.

use crate::io::Cycle;
use crate::machine::Model;
use edgewalk_machine::{Activity, Plan};

/// Cycles by cause, indexed by [`Activity`].
pub type Spent = [u64; Activity::ALL.len()];

/// Sizes of triangles: the least pixels of each.
pub const SIZES: [u64; 6] = [0, 1, 4, 16, 64, 256];

/// Where the cycles of a picture went.
#[derive(Clone, Debug)]
pub struct Causes {
    /// By line of the screen.
    pub lines: Vec<Spent>,
    /// By pixels of the triangle that lie on the screen: how many triangles, and their cycles. Only triangles with a span count.
    pub sizes: [(u64, Spent); SIZES.len()],
    /// Behind the last span.
    pub behind: Spent,
}

/// Takes the cycles down.
pub(super) struct Tracker {
    causes: Causes,
    /// Clocks of a pixel.
    clocks: u64,
    /// Triangle and line of the span that PIXEL has in the cycle to come.
    held: Option<(u32, u32)>,
    /// Cycles since PIXEL had a span.
    waiting: Spent,
    /// The triangle that was drawn last.
    triangle: Option<u32>,
    /// Cycles of this triangle.
    spent: Spent,
}

fn add(to: &mut Spent, cycles: &Spent) {
    to.iter_mut().zip(cycles).for_each(|(to, cycles)| *to += cycles);
}

impl Tracker {
    pub fn new(plan: &Plan) -> Self {
        let none = Spent::default();
        let lines = vec![none; plan.height as usize];
        Tracker {
            causes: Causes { lines, sizes: [(0, none); SIZES.len()], behind: none },
            clocks: plan.clocks_per_pixel().into(),
            held: None,
            waiting: none,
            triangle: None,
            spent: none,
        }
    }

    /// A cycle, and the machine behind it.
    pub fn see<const C: usize>(&mut self, model: &Model<C>, cycle: &Cycle<C>) {
        let cause = cycle.outputs.activity as usize;
        match self.held {
            Some((_, line)) => {
                if let Some(line) = self.causes.lines.get_mut(line as usize) {
                    line[cause] += 1;
                }
                self.spent[cause] += 1;
            }
            None => self.waiting[cause] += 1,
        }
        let pixel = &model.pixel;
        self.held = pixel.active().then(|| (pixel.source().id, pixel.place().1));
        let Some((id, line)) = self.held else { return };
        if self.triangle != Some(id) {
            self.close();
            self.triangle = Some(id);
        }
        let waiting = std::mem::take(&mut self.waiting);
        if let Some(line) = self.causes.lines.get_mut(line as usize) {
            add(line, &waiting);
        }
        add(&mut self.spent, &waiting);
    }

    /// The triangle is drawn.
    fn close(&mut self) {
        if self.triangle.take().is_none() {
            return;
        }
        let spent = std::mem::take(&mut self.spent);
        let pixels = spent[Activity::Draw as usize] / self.clocks;
        let size = SIZES.iter().rposition(|least| pixels >= *least).unwrap_or(0);
        let (count, all) = &mut self.causes.sizes[size];
        *count += 1;
        add(all, &spent);
    }

    pub fn finish(mut self) -> Causes {
        self.close();
        Causes { behind: self.waiting, ..self.causes }
    }
}
