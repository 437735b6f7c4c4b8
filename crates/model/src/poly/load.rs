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
    /// ne: edges of the bank, with one on its way through the order list.
    edges: u32,
    /// An edge had no place.
    over: bool,
    /// Sides of the prim that are chosen.
    did: [bool; 3],
    /// The edge place: an edge on its way to the table, its record and j.
    chosen: Option<(Record, u32)>,
    /// In the cycle before no side of the prim was left, and no edge had to stay in its place.
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
            chosen: None,
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
        (self.did, self.chosen) = ([false; 3], None);
        (self.through, self.putting) = (false, None);
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

    /// All edges of the prim that is offered are in the table, and in the order list.
    pub fn is_through(&self) -> bool {
        self.through && self.putting.is_none()
    }

    /// An edge is in the edge place.
    pub fn has_chosen(&self) -> bool {
        self.chosen.is_some()
    }

    /// The edge in the edge place does not leave it; `writes`: PASS writes a record.
    pub fn stays(&self, writes: bool) -> bool {
        self.chosen.is_some() && (writes || self.putting.is_some())
    }

    /// A side of the prim is left.
    pub fn is_left<const C: usize>(&self, prim: &Prim<C>) -> bool {
        self.left(prim).is_some()
    }

    /// The first side that counts, has lines and is not chosen.
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
        let stays = self.stays(writes);
        let left = prim.and_then(|prim| Some((prim, self.left(prim)?)));
        self.through = prim.is_some() && left.is_none() && !stays;
        let next = left.filter(|_| !stays && self.colours_found(events) && self.putting.is_none());
        if let Some(putting) = self.putting {
            self.put(putting, events);
        } else if stays {
            events.poly.load_waits += 1;
        } else if let Some((record, line)) = self.chosen.take() {
            self.store(record, line, walks, events);
        }
        if let Some((prim, side)) = next {
            self.did[side] = true;
            self.found = false;
            self.chosen = Some(self.edge(prim, side));
        }
    }

    /// The colours of the side whose turn it is are found, or there are none; if not they are sought for a cycle.
    fn colours_found(&mut self, events: &mut Events) -> bool {
        let Some(along) = &self.along else { return true };
        let found = self.found;
        if !found {
            one_more(&mut events.poly.load_divides);
            self.found = self.at + 1 == along.clocks;
            self.at = if self.found { 0 } else { self.at + 1 };
        }
        found
    }

    /// The record of a side's edge, and j.
    fn edge<const C: usize>(&self, prim: &Prim<C>, side: usize) -> (Record, u32) {
        let walk = if side == 0 { prim.major } else { prim.minor[side - 1] };
        let below = if side == 2 { prim.lines[0] } else { 0 };
        let colours = self.along.as_ref().map_or_else(Colours::default, |along| along.colours(prim, side));
        (Record { walk, lines: lines(prim, side), colours }, (prim.line + below) & self.line_mask)
    }

    /// An edge goes to the table, and to the end of the order list or on its way to a place before that.
    fn store(&mut self, record: Record, line: u32, walks: bool, events: &mut Events) {
        if self.edges == self.places {
            self.over = true;
            return;
        }
        events.poly.load_overlap += u64::from(walks);
        let (place, key) = (self.edges, Order { line, index: self.edges });
        self.edges += 1;
        let bank = &mut self.banks[self.bank];
        bank.edges[place as usize] = record;
        if place == 0 || line >= self.top {
            bank.order[place as usize] = key;
            self.top = line;
        } else {
            self.putting = Some(Putting { place, key });
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
