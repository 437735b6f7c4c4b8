//! LOAD: the edges of a polygon go into the table and the order list.

use edgewalk_machine::Plan;
use edgewalk_machine::units::tokens::EDGES;
use edgewalk_netlist::{Module, Signal};

use super::along::{Finds, Lengths};
use super::table::{Tables, Word};
use crate::stepping::{first_rest, parts_of_edge};
use crate::wires::Token;

/// What LOAD reads of the rest of POLY.
pub(super) struct Links<'a, 'm> {
    /// Edges are offered.
    pub prim_valid: Signal<'m>,
    pub prim: &'a Token<'m>,
    /// PIXEL has not loaded the increments of the polygon before.
    pub fresh_queued: Signal<'m>,
    /// The polygon before is still walked.
    pub walking: Signal<'m>,
    /// PASS writes to `rests`.
    pub pass_writes: Signal<'m>,
}

/// What LOAD tells.
pub(super) struct Load<'m> {
    pub prim_ready: Signal<'m>,
    /// The half that is loaded.
    pub bank: Signal<'m>,
    /// Edges in it.
    pub edges: Signal<'m>,
    /// The polygon is walked from now on.
    pub begins: Signal<'m>,
    /// The polygon has too many edges.
    pub refused: Signal<'m>,
    /// A word for `rests`: whether, where, and R - f with the lines left.
    pub stores: Signal<'m>,
    pub place: Signal<'m>,
    pub rest: Signal<'m>,
    /// With bilinear colours: those of the edge on its first line.
    pub values: Vec<Signal<'m>>,
}

/// The fields of the prim with the height of an edge, and how far its first line lies below its upper end.
const HEIGHTS: [&str; 3] = ["height02", "height01", "height12"];
const DOWN: [&str; 3] = ["down0", "down0", "down1"];
/// The sorted vertices at the upper and the lower end.
const ENDS: [[usize; 2]; 3] = [[0, 2], [0, 1], [1, 2]];

/// A side of the prim: its edge, first line and lines.
#[derive(Clone, Copy)]
struct Side<'m> {
    edge: &'static str,
    number: usize,
    first: Signal<'m>,
    lines: Signal<'m>,
    /// There are some.
    some: Signal<'m>,
}

impl<'m> Load<'m> {
    /// The registers of LOAD, and its ports of the memories.
    pub fn new(m: &'m Module, plan: &Plan, tables: &Tables<'m>, links: &Links<'_, 'm>) -> Load<'m> {
        let Links { prim_valid, prim, fresh_queued, walking, pass_writes } = *links;
        m.comment("LOAD: the sides of a prim that count and have lines, one after the other.");
        let bits = tables.index;
        let bank = m.reg("bank", 1).doc("half of the table that is loaded").reset(0);
        let edges = m.reg("edges", bits + 1).doc("in that half").reset(0);
        let over = m.reg("over", 1).doc("there are more").reset(0);
        let putting = m.reg("putting", 1).doc("an edge goes before others of the order list").reset(0);
        let did = m.reg("did", 3).doc("sides of the prim that are chosen").reset(0);

        let sides = sides(prim);
        let is_left = |number: u32| {
            let counts = prim["sides"].bit(number) & sides[number as usize].some;
            (counts & !did.q().bit(number)).named(&format!("{}_left", EDGES[number as usize]))
        };
        let [major, minor1, minor2] = [0, 1, 2].map(is_left);
        let any_left = (major | minor1 | minor2).named("any_left");
        let waits = m.reg("edge_waits", 1).doc("an edge is chosen, and not in the table").reset(0);
        let keeps = (waits.q() & (pass_writes | putting.q())).named("edge_stays");
        let finds = Finds::new(m, !tables.colours.is_empty(), prim_valid & any_left & !keeps);
        let turn = m.cat(&[minor2 & !major & !minor1, minor1 & !major, major]).named("turn");
        let takes = prim_valid & any_left & !putting.q() & !(waits.q() & pass_writes);
        let takes = finds.as_ref().map_or(takes, |finds| takes & finds.found.q());
        let takes = takes.named_doc("takes", "a side is chosen");
        waits.set(takes | keeps);
        // Where the major edge counts and has no lines no side has any: which one is chosen does not matter.
        let of_major = (prim["sides"].bit(0) & !did.q().bit(0)).named("of_major");
        let chosen = |of: &dyn Fn(Side<'m>) -> Signal<'m>| {
            of_major.mux(of(sides[0]), minor1.mux(of(sides[1]), of(sides[2])))
        };
        let kept = |name: &str, value: Signal<'m>| m.reg(name, value.width()).when(!keeps, value).q();
        let first = kept("first_line", chosen(&|side| side.first));
        let lines = kept("lines", chosen(&|side| side.lines));
        let parts = parts_of_edge(&prim.parts());
        let part = |name: &str| chosen(&|side| prim[format!("{}_{name}", side.edge).as_str()]);
        let edge = Token::new(parts.clone(), |name| kept(&format!("loaded_{name}"), part(name)));
        let edge = Token::new(parts, |name| match name {
            // A step with a carry adds M - f.
            "m" => {
                let modulus = edge["m"];
                (modulus - edge["f"].zext(modulus.width())).named_doc("loaded_back", "M - f")
            }
            _ => edge[name],
        });
        let colours = finds.map_or_else(Vec::new, |finds| {
            finds.found.when(takes, 0);
            let field = |name: &str| prim[name];
            let height = chosen(&|side| field(HEIGHTS[side.number])).named("edge_height");
            let down = chosen(&|side| field(DOWN[side.number])).named("edge_down");
            let ends = |colour: &str| {
                [0, 1].map(|end| {
                    let value = chosen(&|side| field(&format!("{colour}_at{}", ENDS[side.number][end])));
                    value.named(&format!("{colour}_{}", ["upper", "lower"][end]))
                })
            };
            finds.colours(m, plan, &Lengths { height, down }, &ends)
        });

        let closes = prim["ends"];
        let through = m.reg("through", 1).doc("no side of the prim is left, and none waits").reset(0);
        let prim_ready = through.q() & !putting.q() & !(closes & (walking | fresh_queued));
        let prim_ready = prim_ready.named("prim_ready");
        let fires = (prim_valid & prim_ready).named("fires");
        let closes = (fires & closes).named_doc("closes", "the polygon has all its edges");
        let begins = (closes & edges.q().any() & !over.q() & !prim["void"]).named("begins");
        through.set(prim_valid & !any_left & !keeps & !fires);
        let refused = (closes & over.q()).named("refused");
        bank.when(closes, !bank.q());
        did.when(takes, did.q() | turn).when(fires, 0);

        let full = edges.q().msb();
        let loads = (waits.q() & !keeps).named("loads");
        over.when(loads & full, 1).when(closes, 0);
        let stores = (loads & !full).named("stores");
        let place = tables.at(bank.q(), edges.q()).named("load_place");
        tables.steps.write(stores, place, tables.joined_steps(&edge));
        for (table, (_, step)) in tables.colours.iter().zip(&colours) {
            table.steps.write(stores, place, *step);
        }
        let rest = first_rest(edge["dist"], edge["f"]).named_doc("first_rest", "R - f, signed");

        let order = Order { m, tables, prim_valid, bank: bank.q(), edges: edges.q(), putting: putting.q() };
        let Ordered { inserts, ended } = order.sort(stores, first);
        putting.when(ended, 0).when(inserts, 1);
        edges.when(stores, edges.q() + 1).when(closes, 0);

        let (bank, edges) = (bank.q(), edges.q());
        let values = colours.into_iter().map(|(value, _)| value).collect();
        let rest = m.cat(&[rest, lines]);
        Load { prim_ready, bank, edges, begins, refused, stores, place, rest, values }
    }
}

/// The sides of a prim: major, first and second minor edge.
fn sides<'m>(prim: &Token<'m>) -> [Side<'m>; 3] {
    let (first, upper, lower) = (prim["jm"], prim["n1"], prim["n2"]);
    let all = (upper + lower).named("all_lines");
    let knee = (first + upper.trunc(first.width())).named_doc("knee", "first line of the lower part");
    let side = |edge: usize, first: Signal<'m>, lines: Signal<'m>, some: Signal<'m>| Side {
        edge: EDGES[edge],
        number: edge,
        first,
        lines,
        some,
    };
    // Whether the major edge has lines does not wait for their sum.
    let some = [upper.any() | lower.any(), upper.any(), lower.any()];
    [side(0, first, all, some[0]), side(1, first, upper, some[1]), side(2, knee, lower, some[2])]
}

/// The order list of the half that is loaded.
struct Order<'a, 'm> {
    m: &'m Module,
    tables: &'a Tables<'m>,
    prim_valid: Signal<'m>,
    bank: Signal<'m>,
    edges: Signal<'m>,
    putting: Signal<'m>,
}

/// What becomes of an edge.
struct Ordered<'m> {
    /// The edge goes before some others, which first move up.
    inserts: Signal<'m>,
    /// The others have moved, and the edge is put in its place.
    ended: Signal<'m>,
}

impl<'m> Order<'_, 'm> {
    /// Sorts an edge in by its first line: of equal lines the earlier edge stays first.
    fn sort(&self, stores: Signal<'m>, first: Signal<'m>) -> Ordered<'m> {
        let Order { m, tables, prim_valid, bank, edges, putting } = *self;
        m.comment("The order list: those that begin later move up, a clock each, the last first. The words before it are read two clocks ahead.");
        let last = m.reg("last_first", tables.line).doc("first line of the last edge of the list");
        let last_index = m.reg("last_index", tables.index).doc("its number");
        let position = m.reg("position", tables.index).doc("the place that is free");
        let line = m.reg("put_line", tables.line).doc("first line of the edge that is put there");
        let own = Word { key: first, index: edges.trunc(tables.index) };
        let number = m.reg("put_index", tables.index).doc("its number").when(!putting, own.index);
        let put = Word { key: line.q(), index: number.q() };
        line.when(!putting, first);

        let later = first.ge(last.q()) | !edges.any();
        let later = later.named_doc("later", "no edge of the list begins later");
        let appends = (stores & later).named("appends");
        let inserts = (stores & !later).named("inserts");
        last.when(appends, first);
        last_index.when(appends, own.index);
        let top = Word { key: last.q(), index: last_index.q() };

        let below = m.reg("next_below", tables.index).doc("place of the word that is read next");
        let read = putting.mux(below.q(), edges.trunc(tables.index) - 2).named("read_below");
        below.set(read - 1);
        let read = tables.word(tables.order.read(prim_valid, tables.at(bank, read)));
        let word = Word {
            key: m
                .reg("below_line", tables.line)
                .doc("first line of the edge before the free place")
                .set(read.key)
                .q(),
            index: m.reg("below_index", tables.index).doc("its number").set(read.index).q(),
        };
        let greater = m.reg("below_later", 1).doc("that edge begins later than the one that is put");
        let greater = greater.set(read.key.gt(line.q())).q();
        let moves_last = m.reg("moves_last", 1).doc("the last edge moves up").set(inserts).q();
        let moves = (moves_last | (greater & position.q().any())).named("moves_up");
        let ended = (putting & !moves).named("ended");
        let place = putting.mux(position.q(), edges.trunc(tables.index)).named("order_place");
        position.set(place).when(putting & moves, position.q() - 1);
        let moved = Word::choose(moves_last, top, word);
        let written = Word::choose(putting, Word::choose(moves, moved, put), own);
        tables.order.write(appends | putting, tables.at(bank, place), written.joined());
        Ordered { inserts, ended }
    }
}
