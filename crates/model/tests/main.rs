//! The suites of this crate as one program, a file a suite: built once, and none waits for the one before.

mod common;

mod bilinear;
mod blend;
mod channels;
mod corners;
mod dither;
mod exact;
mod fast;
mod fast_poly;
mod named;
mod golden;
mod hazards;
mod memory;
mod lines;
mod own_pass;
mod pairs;
mod polygon;
mod passage;
mod perspective;
mod project;
mod reset;
mod sequencer;
mod sequencer_gains;
mod shade;
mod shadow;
mod slope;
mod term;
mod texels;
mod textbook;
mod timing;
mod view;
