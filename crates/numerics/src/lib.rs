//! Formats, words, rounding, proved bounds, and the one description of a machine
