//! Sorts steps, and members of a group, by what they read and change. A register that changes before all its readers have read it
//! costs a copy.

use crate::effect::{Effect, Set};

/// Times that every item is looked at, at most: most find their place the first time.
const ROUNDS: usize = 4;

/// Takes, again and again, the item that changes the fewest registers which others still have to read; then moves each to where
/// the fewest copies are needed.
pub(crate) fn sorted<T>(mut open: Vec<(T, Effect)>) -> Vec<T> {
    let harm_of = |writer: &Effect| open.iter().map(|(_, other)| common(&writer.writes, &other.reads)).sum();
    let mut harm: Vec<u32> = open.iter().map(|(_, effect)| harm_of(effect)).collect();
    for (harm, (_, effect)) in harm.iter_mut().zip(&open) {
        *harm -= common(&effect.writes, &effect.reads); // no harm to itself
    }
    let mut order = Vec::new();
    while !open.is_empty() {
        let waits = |i: usize| open.iter().any(|(_, other)| open[i].1.waits_for(other));
        let next = (0..open.len()).filter(|i| !waits(*i)).min_by_key(|i| harm[*i]).unwrap_or(0);
        let first = open.remove(next);
        harm.remove(next);
        for (harm, (_, effect)) in harm.iter_mut().zip(&open) {
            *harm -= common(&effect.writes, &first.1.reads);
        }
        order.push(first);
    }
    move_each(&mut order);
    order.into_iter().map(|(item, _)| item).collect()
}

/// Moves each item to its best place, till none moves.
fn move_each<T>(order: &mut Vec<(T, Effect)>) {
    let Some(words) = order.first().map(|(_, effect)| effect.writes.len()) else { return };
    for _ in 0..ROUNDS {
        let mut moved = false;
        let mut numbers: Vec<usize> = (0..order.len()).collect();
        for item in 0..order.len() {
            let from = numbers.iter().position(|number| *number == item).unwrap_or(0);
            let taken = order.remove(from);
            let number = numbers.remove(from);
            let to = best_place(order, &taken.1, from, words);
            moved |= to != from;
            order.insert(to, taken);
            numbers.insert(to, number);
        }
        if !moved {
            return;
        }
    }
}

/// Where among the others an item needs the fewest copies: as it is, if no other place is better.
fn best_place<T>(others: &[(T, Effect)], item: &Effect, now: usize, words: usize) -> usize {
    // Before each of the others, and behind all: what comes to be or ceases to be a copy there.
    let mut steps = vec![0i32; others.len() + 2];
    let (mut read_later, mut placed) = (vec![0u64; words], vec![0u64; words]);
    for (at, (_, other)) in others.iter().enumerate().rev() {
        for word in 0..words {
            // It has to stand behind the last one that reads what it writes.
            let last = item.writes[word] & other.reads[word] & !placed[word];
            steps[at + 1] -= last.count_ones() as i32;
            placed[word] |= last;
            // It has to stand before the one that writes what it reads, unless there is a copy for others anyway.
            let alone = item.reads[word] & other.writes[word] & !read_later[word];
            steps[at + 1] += alone.count_ones() as i32;
            read_later[word] |= other.reads[word];
        }
    }
    let first = others.iter().rposition(|(_, other)| item.waits_for(other)).map_or(0, |last| last + 1);
    let last = others.iter().position(|(_, other)| other.waits_for(item)).unwrap_or(others.len());
    let mut copies = 0;
    let costs: Vec<i32> = steps[..=others.len()]
        .iter()
        .map(|step| {
            copies += step;
            copies
        })
        .collect();
    (first..=last).min_by_key(|place| (costs[*place], *place != now)).unwrap_or(now)
}

/// How many are in both.
fn common(a: &Set, b: &Set) -> u32 {
    a.iter().zip(b).map(|(a, b)| (a & b).count_ones()).sum()
}
