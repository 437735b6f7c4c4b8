//! A frame drawn under a watch.

use crate::io::Cycle;
use crate::machine::Model;
use crate::run::Rig;
use crate::waits::Waits;
use edgewalk_machine::{ForeignVertex, Maps, Pass, Plan, PortVertex, Shading, Step, first_of_picture, steps};

/// What a machine is sent for a frame, as [`render_passes`](crate::render_passes) takes it.
#[derive(Clone, Copy, Debug)]
pub struct Sent<'a> {
    /// In their order.
    pub triangles: &'a [[PortVertex; 3]],
    /// At least one.
    pub passes: &'a [Pass],
    /// The words of the lights' maps that the host makes.
    pub maps: &'a [Vec<u32>],
    /// Records, tables, roots and textures.
    pub shading: &'a Shading,
}

/// Draws the frame: `see` is shown the machine before each cycle of the picture, `watch` behind it.
pub(super) fn run<const C: usize>(
    plan: &Plan,
    sent: &Sent,
    waits: Waits,
    mut see: impl FnMut(&Rig<C>, Option<(&[PortVertex; 3], u32)>),
    mut watch: impl FnMut(&Model<C>, &Cycle<C>),
) -> Result<(), ForeignVertex> {
    let Sent { triangles, passes, maps, shading } = *sent;
    let mut rig = Rig::<C>::new(plan, first_of_picture(passes), waits);
    rig.memories.write_shading(plan, shading);
    let mut triangles = triangles.iter().zip(0..).map(|(t, number)| plan.accept(t, number).map(|()| *t));
    let (mut maps, mut light_pass) = (Maps::of_host(maps), false);
    for step in steps(plan, passes, shading) {
        if let Step::State(state) = step {
            light_pass = state.light_pass;
        }
        if let Some(count) = rig.memories.take_step(plan, step, &mut maps) {
            rig.draw_seen(
                triangles.by_ref().take(count),
                |rig, offered| {
                    if !light_pass {
                        see(rig, offered);
                    }
                },
                |_, model, cycle| {
                    if !light_pass {
                        watch(model, cycle);
                    }
                },
            )?;
        }
    }
    Ok(())
}
