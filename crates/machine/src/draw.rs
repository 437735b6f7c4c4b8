//! How a picture is drawn: the rules of its passes, the words of the memories that the host fills, and the
//! host's steps.

use crate::plan::Plan;
use crate::record::Record;
use std::borrow::Cow;
use std::iter;

/// What stays the same over a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DrawState {
    /// Compare function, bits 0, 1, 2: less, equal, greater pass; 7 always.
    pub depth_func: u8,
    /// Fragments that pass store their depth.
    pub depth_write: bool,
    /// With SHADOW: the map counts.
    pub shadow_on: bool,
    /// In a machine that draws its map: it draws it, not the picture.
    pub light_pass: bool,
    /// With SHADOW's gate `scale`: what a colour in shadow is multiplied by, b bits.
    pub ambient: u64,
    /// Fragments that pass store their colour; without BLEND they always do.
    pub color_write: bool,
    /// BLEND adds, else it mixes.
    pub blend_add: bool,
    /// Colour of the empty screen, b bits each.
    pub clear: [u64; 3],
}

/// Sets a constant to the value at its port.
pub type Setter = fn(&mut DrawState, u128);

impl Default for DrawState {
    /// The nearest fragment wins, mixed with what is there as its k_t says, on black; no map counts.
    fn default() -> Self {
        DrawState {
            depth_func: 1,
            depth_write: true,
            color_write: true,
            blend_add: false,
            shadow_on: false,
            light_pass: false,
            ambient: 0,
            clear: [0; 3],
        }
    }
}

impl DrawState {
    /// The values of the machine's constants, by the names that the units declare.
    #[must_use]
    pub fn constants(&self) -> [(&'static str, u128); 7] {
        [
            ("depth_func", self.depth_func.into()),
            ("depth_write", self.depth_write.into()),
            ("color_write", self.color_write.into()),
            ("blend_add", self.blend_add.into()),
            ("shadow_on", self.shadow_on.into()),
            ("light_pass", self.light_pass.into()),
            ("ambient", self.ambient.into()),
        ]
    }
}

impl DrawState {
    /// The setter of the constant of that name, if there is one.
    #[must_use]
    pub fn setter(name: &str) -> Option<Setter> {
        let setter: Setter = match name {
            "depth_func" => |state, value| state.depth_func = value as u8, // 3 bits
            "depth_write" => |state, value| state.depth_write = value == 1,
            "color_write" => |state, value| state.color_write = value == 1,
            "blend_add" => |state, value| state.blend_add = value == 1,
            "shadow_on" => |state, value| state.shadow_on = value == 1,
            "light_pass" => |state, value| state.light_pass = value == 1,
            "ambient" => |state, value| state.ambient = value as u64, // at most 16 bits
            _ => return None,
        };
        Some(setter)
    }
}

/// Some triangles and their rules. The machine is idle before a pass begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pass {
    /// How many, those behind the pass before.
    pub triangles: usize,
    /// The rules; `clear` is that of the picture's first pass.
    pub state: DrawState,
    /// The depth memory is cleared first; of the light's own pass the map, with what is left of the light.
    pub clear_depth: bool,
    /// With SHADOW the number of the map that is looked up, or drawn: its place among those that come with
    /// the passes or are drawn by them. None: the map of the pass before.
    pub map: Option<usize>,
}

impl Pass {
    /// All triangles by the same rules.
    #[must_use]
    pub fn all(state: DrawState) -> Pass {
        Pass { triangles: usize::MAX, state, clear_depth: false, map: None }
    }
}

/// The rules that the picture begins with: those of its first pass, whatever map is drawn before.
#[must_use]
pub fn first_of_picture(passes: &[Pass]) -> DrawState {
    let of_picture = passes.iter().find(|pass| !pass.state.light_pass);
    of_picture.map_or_else(DrawState::default, |pass| pass.state)
}

/// Words of the memories behind TERM, TEXEL, NORMAL, LAMP and SHADE.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Shading {
    /// The record of every triangle, culled or not, in their order; of those behind the last the memory holds
    /// nothing.
    pub records: Vec<Record>,
    /// Entries of the tables, [`Plan::table_word`] at [`Plan::table_place`]; an entry that is not there is 0.
    pub tables: Vec<u128>,
    /// Entries of NORMAL's or LAMP's tables, [`Plan::root_word`].
    pub roots: Vec<u128>,
    /// Texels, [`Plan::texel_word`] at [`Plan::texel_place`].
    pub textures: Vec<u128>,
}

/// What the host does next. It does everything but `Draw` while the machine is idle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step<'a> {
    /// Begins a pass: sets its rules. They choose the page that DEPTH and BLEND reach, the picture or the
    /// map.
    State(DrawState),
    /// Clears the depths of the picture.
    ClearDepth,
    /// Clears the map that is drawn: its depths, and the share of the light that is left.
    ClearMap,
    /// Fills the memory of SHADOW with the map of this number, if there is one.
    LoadMap(usize),
    /// Writes the record of the triangle of this number into the memory of TERM.
    Record(usize, &'a Record),
    /// Offers so many triangles one after the other, or as many as are left, and waits until the machine is
    /// idle again.
    Draw(usize),
    /// Keeps the map that is drawn under this number.
    StoreMap(usize),
}

/// The steps of a picture in order. A pass whose records do not all fit into the memory of TERM is drawn in
/// parts.
pub fn steps<'a>(
    plan: &Plan,
    passes: &'a [Pass],
    shading: &'a Shading,
) -> impl Iterator<Item = Step<'a>> + use<'a> {
    let at_once = if plan.shade.is_there() { 1 << plan.shade.record_bits } else { usize::MAX };
    let records = if plan.shade.is_there() { &shading.records[..] } else { &[] };
    let mut begun = 0usize;
    passes.iter().flat_map(move |pass| {
        let first = begun;
        begun = begun.saturating_add(pass.triangles);
        let of_light = pass.state.light_pass;
        let clear = if of_light { Step::ClearMap } else { Step::ClearDepth };
        let load = pass.map.filter(|_| !of_light).map(Step::LoadMap);
        let store = pass.map.filter(|_| of_light).map(Step::StoreMap);
        iter::once(Step::State(pass.state))
            .chain(pass.clear_depth.then_some(clear))
            .chain(load)
            .chain(parts(first, pass.triangles, &records[first.min(records.len())..], at_once))
            .chain(store)
    })
}

/// The triangles of a pass, at most `at_once` together, each part behind its records; those without a record
/// in the last.
fn parts(
    first: usize,
    triangles: usize,
    records: &[Record],
    at_once: usize,
) -> impl Iterator<Item = Step<'_>> + use<'_> {
    let records = &records[..triangles.min(records.len())];
    let count = records.len().div_ceil(at_once).max(1);
    (0..count).flat_map(move |part| {
        let from = part * at_once;
        let next = if part + 1 == count { triangles } else { from + at_once };
        let own = records[from..next.min(records.len())].iter().zip(first + from..);
        own.map(|(record, triangle)| Step::Record(triangle, record))
            .chain(iter::once(Step::Draw(next - from)))
    })
}

/// The words of the lights' maps by number: maps that the host has made, and maps that the machine draws.
#[derive(Clone, Debug)]
pub struct Maps<'a>(Vec<Cow<'a, [u32]>>);

impl<'a> Maps<'a> {
    /// The maps that the host has made.
    #[must_use]
    pub fn of_host(maps: &'a [Vec<u32>]) -> Maps<'a> {
        Maps(maps.iter().map(Cow::from).collect())
    }

    /// The words of a map by address, if it is there already.
    #[must_use]
    pub fn words(&self, number: usize) -> Option<&[u32]> {
        self.0.get(number).map(AsRef::as_ref)
    }

    /// Keeps a map that was drawn.
    pub fn keep(&mut self, number: usize, words: Vec<u32>) {
        self.0.resize(self.0.len().max(number + 1), Cow::default());
        self.0[number] = words.into();
    }

    /// All maps after these passes; none where no pass draws one.
    #[must_use]
    pub fn drawn_by(self, passes: &[Pass]) -> Vec<Vec<u32>> {
        let draws = passes.iter().any(|pass| pass.state.light_pass);
        if draws { self.0.into_iter().map(Cow::into_owned).collect() } else { Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Machine;

    fn plan(keys: &[(&str, &str)]) -> Plan {
        let mut machine = Machine::default();
        for (key, value) in keys {
            machine.set(key, value).expect("a key of the machine");
        }
        machine.plan().expect("can be built")
    }

    fn record(x: i32) -> Record {
        Record { x, ..Record::default() }
    }

    /// Three records fit beside each other twice; the fifth triangle has none.
    #[test]
    fn records_cut_a_pass_into_parts() {
        let plan = plan(&[("shade.kind", "phong"), ("term.record_bits", "1")]);
        let shading = Shading { records: (0..4).map(record).collect(), ..Shading::default() };
        let state = DrawState::default();
        let pass = |triangles| Pass { triangles, ..Pass::all(state) };
        let r = &shading.records;
        let passes = [pass(1), pass(0), pass(4)];
        let found: Vec<Step> = steps(&plan, &passes, &shading).collect();
        let expected = [
            Step::State(state),
            Step::Record(0, &r[0]),
            Step::Draw(1),
            Step::State(state),
            Step::Draw(0),
            Step::State(state),
            Step::Record(1, &r[1]),
            Step::Record(2, &r[2]),
            Step::Draw(2),
            Step::Record(3, &r[3]),
            Step::Draw(2),
        ];
        assert_eq!(found, expected);
        // Without TERM no record is written, and nothing cuts the pass.
        let passes = [Pass::all(state)];
        let found: Vec<Step> = steps(&Plan::default(), &passes, &shading).collect();
        assert_eq!(found, [Step::State(state), Step::Draw(usize::MAX)]);
    }

    #[test]
    fn a_light_clears_and_stores_its_map_and_loads_none() {
        let plan = plan(&[("shadow.light", "parallel"), ("shadow.own_pass", "yes")]);
        let shading = Shading::default();
        let light = DrawState { light_pass: true, ..DrawState::default() };
        let picture = DrawState { shadow_on: true, ..DrawState::default() };
        let pass = |state, map| Pass { triangles: 3, state, clear_depth: true, map };
        let passes = [pass(light, Some(1)), pass(picture, Some(1)), pass(picture, None)];
        let found: Vec<Step> = steps(&plan, &passes, &shading).collect();
        let of_light = [Step::State(light), Step::ClearMap, Step::Draw(3), Step::StoreMap(1)];
        let of_picture = [Step::State(picture), Step::ClearDepth, Step::LoadMap(1), Step::Draw(3)];
        let again = [Step::State(picture), Step::ClearDepth, Step::Draw(3)];
        assert_eq!(found, [&of_light[..], &of_picture, &again].concat());
        assert_eq!(first_of_picture(&passes), picture);
    }

    #[test]
    fn maps_are_kept_by_their_numbers() {
        let sent = [vec![1, 2]];
        let light = Pass::all(DrawState { light_pass: true, ..DrawState::default() });
        let mut maps = Maps::of_host(&sent);
        assert_eq!((maps.words(0), maps.words(2)), (Some(&[1, 2][..]), None));
        assert!(maps.clone().drawn_by(&[Pass::all(DrawState::default())]).is_empty());
        maps.keep(2, vec![7]);
        assert_eq!((maps.words(1), maps.words(2)), (Some(&[][..]), Some(&[7][..])));
        assert_eq!(maps.drawn_by(&[light]), [vec![1, 2], vec![], vec![7]]);
    }
}
