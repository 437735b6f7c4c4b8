//! Single units against the model, under inputs that the rest of the machine would rarely give them.

use edgewalk_machine::Plan;
use edgewalk_model::tokens::{Rgb, Source, Words, word_masks};
use rand::Rng;
use rand_pcg::Pcg64Mcg;

mod setup;

mod edge;
mod span;

mod pixel;

mod depth;

mod memory;

pub use depth::depth;
pub use edge::edge;
pub use memory::memory;
pub use pixel::pixel;
pub use setup::setup;
pub use span::span;

/// A token that stays until it is taken, then another after a random gap.
struct Stream<T> {
    token: Option<T>,
}

impl<T> Stream<T> {
    fn next(&mut self, rng: &mut Pcg64Mcg, draw: impl FnOnce(&mut Pcg64Mcg) -> T) {
        if self.token.is_none() && rng.random_bool(0.7) {
            self.token = Some(draw(rng));
        }
    }

    fn taken(&mut self, ready: bool) -> bool {
        let taken = ready && self.token.is_some();
        if taken {
            self.token = None;
        }
        taken
    }
}

fn words(machine: &Plan, rng: &mut Pcg64Mcg) -> Words {
    word_masks(machine).map(|mask| rng.random::<u64>() & mask)
}

fn source(machine: &Plan, rng: &mut Pcg64Mcg) -> Source {
    Source { tag: rng.random::<u32>().checked_shr(32 - machine.tag_bits).unwrap_or(0), id: 0 }
}

fn rgb(machine: &Plan, rng: &mut Pcg64Mcg) -> Rgb {
    let most = machine.color.max() as u16; // at most 16 bits
    Rgb::new(std::array::from_fn(|_| rng.random_range(0..=most)))
}
