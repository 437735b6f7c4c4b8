//! The same code for the vector instructions that this processor has.

use super::frame::{self, Bring};
use super::passage::Passage;
use super::picture::Picture;
use super::pixel::Pixel;
use super::refusal::Refusal;
use crate::DrawState;
use crate::counters::Counters;
use edgewalk_machine::Plan;

macro_rules! compiled_for {
    ($name:ident, $features:literal) => {
        #[cfg(target_arch = "x86_64")]
        #[target_feature(enable = $features)]
        fn $name<P: Pixel, const DETAILS: bool>(
            plan: &Plan,
            triangles: &mut Bring,
            state: &DrawState,
            picture: &mut Picture<P>,
            passage: Option<&mut Passage>,
        ) -> Result<Counters, Refusal> {
            frame::draw::<P, DETAILS>(plan, triangles, state, picture, passage)
        }
    };
}

compiled_for!(avx512, "avx512f,avx512bw,avx512dq,avx512vl,bmi1,bmi2");
compiled_for!(avx2, "avx2,bmi1,bmi2");

/// Clears the picture and draws, with the widest vectors there are.
pub(super) fn draw<P: Pixel>(
    plan: &Plan,
    triangles: &mut Bring,
    state: &DrawState,
    details: bool,
    picture: &mut Picture<P>,
    passage: Option<&mut Passage>,
) -> Result<Counters, Refusal> {
    picture.clear(plan, state, details);
    if details {
        widest::<P, true>(plan, triangles, state, picture, passage)
    } else {
        widest::<P, false>(plan, triangles, state, picture, passage)
    }
}

fn widest<P: Pixel, const DETAILS: bool>(
    plan: &Plan,
    triangles: &mut Bring,
    state: &DrawState,
    picture: &mut Picture<P>,
    passage: Option<&mut Passage>,
) -> Result<Counters, Refusal> {
    #[cfg(target_arch = "x86_64")]
    {
        let bmi = is_x86_feature_detected!("bmi1") && is_x86_feature_detected!("bmi2");
        if bmi
            && is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl")
        {
            // SAFETY: the function is safe code, compiled for exactly the features found here.
            return unsafe { avx512::<P, DETAILS>(plan, triangles, state, picture, passage) };
        }
        if bmi && is_x86_feature_detected!("avx2") {
            // SAFETY: as above.
            return unsafe { avx2::<P, DETAILS>(plan, triangles, state, picture, passage) };
        }
    }
    frame::draw::<P, DETAILS>(plan, triangles, state, picture, passage)
}
