//! Picture or map: the input `light_pass` of a machine that draws its map, and what it chooses.

use edgewalk_machine::Plan;
use edgewalk_netlist::{Module, Signal};

use crate::ports::Interface;

/// The input; of other machines none, and the picture is chosen.
#[derive(Clone, Copy)]
pub(crate) struct LightPass<'m>(Option<Signal<'m>>);

impl<'m> LightPass<'m> {
    /// Asks for the input.
    pub fn of(plan: &Plan, ports: &Interface<'m>) -> Self {
        LightPass(plan.shadow.draws_map().then(|| ports.constant("light_pass")))
    }

    /// A constant of the picture, or of the map.
    pub fn number(self, m: &'m Module, bits: u32, picture: u128, map: u128) -> Signal<'m> {
        self.choose(m.lit(bits, picture), || m.lit(bits, map))
    }

    /// What is of the picture, or of the map.
    pub fn choose(self, picture: Signal<'m>, map: impl FnOnce() -> Signal<'m>) -> Signal<'m> {
        self.0.map_or(picture, |light_pass| light_pass.mux(map(), picture))
    }

    /// A condition, in the picture only.
    pub fn in_picture(self, condition: Signal<'m>) -> Signal<'m> {
        self.0.map_or(condition, |light_pass| condition & !light_pass)
    }
}
