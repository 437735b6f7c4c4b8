//! Fronts: which points no other is better than, exactly.

/// The front of each point, 1 the best: 1 where no other point is at least as good in every cost and better in one, 2 where only
/// those of front 1 are, and so on. Less is better in every cost.
#[must_use]
pub fn fronts(costs: &[Vec<f64>]) -> Vec<u32> {
    // In lexicographic order nothing is dominated by what comes after it; so every point's front is known once it is compared
    // with those before it, front by front.
    let mut order: Vec<usize> = (0..costs.len()).collect();
    order.sort_by(|a, b| {
        let pairs = costs[*a].iter().zip(&costs[*b]);
        pairs.map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne()).unwrap_or(a.cmp(b))
    });
    let mut members: Vec<Vec<usize>> = Vec::new();
    let mut ranks = vec![0; costs.len()];
    for point in order {
        let dominated =
            |front: &Vec<usize>| front.iter().rev().any(|other| dominates(&costs[*other], &costs[point]));
        let rank = members.iter().position(|front| !dominated(front)).unwrap_or(members.len());
        if rank == members.len() {
            members.push(Vec::new());
        }
        members[rank].push(point);
        ranks[point] = rank as u32 + 1;
    }
    ranks
}

/// At least as good in all, better in one.
fn dominates(a: &[f64], b: &[f64]) -> bool {
    let pairs = || a.iter().zip(b);
    pairs().all(|(a, b)| a <= b) && pairs().any(|(a, b)| a < b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{Rng, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    /// Peels front by front, every point against every other.
    fn peeled(costs: &[Vec<f64>]) -> Vec<u32> {
        let mut ranks = vec![0; costs.len()];
        for rank in 1.. {
            let left: Vec<usize> = (0..costs.len()).filter(|i| ranks[*i] == 0).collect();
            if left.is_empty() {
                break;
            }
            for i in &left {
                if !left.iter().any(|j| dominates(&costs[*j], &costs[*i])) {
                    ranks[*i] = rank;
                }
            }
        }
        ranks
    }

    #[test]
    fn every_front_is_that_of_comparing_all_with_all() {
        let mut random = Pcg64Mcg::seed_from_u64(1);
        let (mut points, mut deepest) = (0, 0);
        for _ in 0..200 {
            let (count, objectives, values) =
                (random.random_range(0..60), random.random_range(1..5), random.random_range(2..9));
            let mut costs = vec![vec![0.0; objectives]; count];
            costs.iter_mut().flatten().for_each(|cost| *cost = f64::from(random.random_range(0..values)));
            let found = fronts(&costs);
            assert_eq!(found, peeled(&costs), "{costs:?}");
            points += count;
            deepest = deepest.max(found.into_iter().max().unwrap_or(0));
        }
        println!("checked {points} points in fronts to {deepest}");
        assert!(points > 3000 && deepest > 8);
    }
}
