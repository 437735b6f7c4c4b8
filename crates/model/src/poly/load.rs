//! LOAD: takes the edges of a polygon into the table, sorted by their first lines.

use super::along::Along;
use super::table::{Bank, Colours, Order, Record};
use crate::Events;
use crate::counters::one_more;
use crate::tokens::Prim;
use edgewalk_machine::Plan;

/// State of LOAD.
#[derive(Clone, Debug)]
pub(super) struct Load {
    banks: [Bank; 2],
    /// The bank that is loaded; the other one is walked.
    bank: usize,
    /// N.
    places: u32,
    line_mask: u32,
    /// ne: edges of the bank.
    edges: u32,
    /// An edge had no place.
    over: bool,
    /// Sides of the prim that are loaded.
    did: [bool; 3],
    /// No side of the prim was left in the cycle before.
    through: bool,
    /// Line of the last word of the order list.
    top: u32,
    /// An edge waits for its place in the order list.
    putting: Option<Putting>,
    /// With bilinear colours: how those of an edge are found.
    along: Option<Along>,
    /// Clocks for which the colours have been sought.
    at: u32,
    /// The colours are found.
    found: bool,
}

/// An edge on its way to its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Putting {
    /// The place that is free.
    pub place: u32,
    /// okey: what goes there, or before it.
    pub key: Order,
}

impl Load {
    pub fn new(plan: &Plan) -> Load {
        let places = plan.polygon.edges;
        Load {
            banks: [(); 2].map(|()| Bank::new(places as usize)),
            bank: 0,
            places,
            line_mask: u32::MAX >> (32 - plan.widths().line),
            edges: 0,
            over: false,
            did: [false; 3],
            through: false,
            top: 0,
            putting: None,
            along: plan.polygon.is_bilinear().then(|| Along::new(plan)),
            at: 0,
            found: false,
        }
    }

    pub fn reset(&mut self) {
        (self.bank, self.edges, self.over) = (0, 0, false);
        (self.did, self.through, self.putting) = ([false; 3], false, None);
        (self.at, self.found) = (0, false);
    }

    /// With bilinear colours: clocks for which those of an edge have been sought, and whether they are found.
    pub fn sought(&self) -> Option<(u32, bool)> {
        self.along.as_ref().map(|_| (self.at, self.found))
    }

    /// The bank that PASS walks.
    pub fn walked(&mut self) -> &mut Bank {
        &mut self.banks[1 - self.bank]
    }

    /// The same, to look at.
    pub fn shown(&self) -> &Bank {
        &self.banks[1 - self.bank]
    }

    /// The bank that is loaded, its edges so far, and what is on its way.
    pub fn loading(&self) -> (&Bank, u32, Option<Putting>) {
        (&self.banks[self.bank], self.edges, self.putting)
    }

    /// An edge of the polygon had no place.
    pub fn over(&self) -> bool {
        self.over
    }

    /// So many edges are as many as the table holds.
    pub fn is_full(&self, edges: u32) -> bool {
        edges == self.places
    }

    /// No side of the prim that is offered is left, and no edge is on its way, for a cycle or more.
    pub fn is_through(&self) -> bool {
        self.through
    }

    /// A side of the prim is left.
    pub fn is_left<const C: usize>(&self, prim: &Prim<C>) -> bool {
        self.left(prim).is_some()
    }

    /// The first side that counts, has lines and is not loaded.
    fn left<const C: usize>(&self, prim: &Prim<C>) -> Option<usize> {
        (0..3).find(|side| prim.sides >> side & 1 == 1 && lines(prim, *side) > 0 && !self.did[*side])
    }

    /// Clock edge. `writes`: PASS writes a record; `walks`: a polygon is walked.
    pub fn step<const C: usize>(
        &mut self,
        prim: Option<&Prim<C>>,
        writes: bool,
        walks: bool,
        events: &mut Events,
    ) {
        let left = prim.and_then(|prim| Some((prim, self.left(prim)?)));
        self.through = prim.is_some() && left.is_none() && self.putting.is_none();
        let found = self.along.is_none() || self.found;
        if let Some(along) = &self.along
            && left.is_some()
            && !found
        {
            self.found = self.at + 1 == along.clocks;
            self.at = if self.found { 0 } else { self.at + 1 };
        }
        if let Some(putting) = self.putting {
            return self.put(putting, events);
        }
        let Some((prim, side)) = left else { return };
        if !found {
            one_more(&mut events.poly.load_divides);
            return;
        }
        if writes {
            events.poly.load_waits += 1;
            return;
        }
        self.did[side] = true;
        self.found = false;
        if self.edges == self.places {
            self.over = true;
            return;
        }
        events.poly.load_overlap += u64::from(walks);
        let walk = if side == 0 { prim.major } else { prim.minor[side - 1] };
        let below = if side == 2 { prim.lines[0] } else { 0 };
        let key = Order { line: (prim.line + below) & self.line_mask, index: self.edges };
        let bank = &mut self.banks[self.bank];
        bank.edges[self.edges as usize] = Record {
            walk,
            lines: lines(prim, side),
            colours: self.along.as_ref().map_or_else(Colours::default, |along| along.colours(prim, side)),
        };
        if self.edges == 0 || key.line >= self.top {
            bank.order[self.edges as usize] = key;
            self.top = key.line;
            self.edges += 1;
        } else {
            self.putting = Some(Putting { place: self.edges, key });
        }
    }

    /// Moves a word, or puts the edge at its place.
    fn put(&mut self, Putting { place, key }: Putting, events: &mut Events) {
        let order = &mut self.banks[self.bank].order;
        let before = place.checked_sub(1).map(|before| order[before as usize]);
        match before.filter(|word| word.line > key.line) {
            Some(word) => {
                order[place as usize] = word;
                self.putting = Some(Putting { place: place - 1, key });
                events.poly.load_moves += 1;
            }
            None => {
                order[place as usize] = key;
                self.edges += 1;
                self.putting = None;
            }
        }
    }

    /// The prim fires; of one that ends a polygon gives how many edges there are.
    pub fn take(&mut self, ends: bool) -> u32 {
        (self.did, self.through) = ([false; 3], false);
        let edges = self.edges;
        if ends {
            (self.bank, self.edges, self.over) = (1 - self.bank, 0, false);
        }
        edges
    }
}

/// n of a side's edge: major, first and second minor.
fn lines<const C: usize>(prim: &Prim<C>, side: usize) -> u32 {
    let [n1, n2] = prim.lines;
    [n1 + n2, n1, n2][side]
}
