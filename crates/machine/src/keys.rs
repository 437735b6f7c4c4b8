//! Every key of a machine file, in the order the data flows: the one table behind files, `--set`, `config explain`, error
//! messages, hashes and random machines.

use crate::key::Key;
use crate::{blend, dither, extra, machine, polygon, shade, shadow};

const PARTS: [&[Key]; 10] = [
    machine::FRONT,
    polygon::KEYS,
    extra::KEYS,
    machine::PIXEL,
    shade::KEYS,
    machine::DEPTH,
    shadow::KEYS,
    dither::KEYS,
    blend::KEYS,
    machine::TAG,
];

const LENGTH: usize = {
    let (mut part, mut length) = (0, 0);
    while part < PARTS.len() {
        length += PARTS[part].len();
        part += 1;
    }
    length
};

/// All keys.
pub const KEYS: &[Key] = &{
    let mut all = [machine::FRONT[0]; LENGTH];
    let (mut part, mut key, mut place) = (0, 0, 0);
    while part < PARTS.len() {
        if key == PARTS[part].len() {
            (part, key) = (part + 1, 0);
        } else {
            all[place] = PARTS[part][key];
            (key, place) = (key + 1, place + 1);
        }
    }
    all
};
