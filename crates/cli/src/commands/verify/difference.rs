//! A replay of the machine up to the first difference between model and netlist, opened there.

use anyhow::Result;
use edgewalk_lockstep::{Difference, Rig, model};
use edgewalk_machine::Counted;
use edgewalk_replay::{LIMIT, Plane, Recorder, Replay, page};
use edgewalk_vectors::{Suite, Trace};

/// Cycles shown before the difference, where the run is too long to be shown from its begin.
const BEFORE: u64 = 300;
/// Cycles shown behind it.
const AFTER: u64 = 40;

/// The page; none for a unit alone.
pub fn page(suite: &Suite, trace: &Trace, difference: &Difference) -> Result<Option<String>> {
    let Trace { plan, interface, .. } = trace;
    let from = if difference.cycle + AFTER < LIMIT { 0 } else { difference.cycle - BEFORE };
    let mut device = model(plan, interface)?;
    let mut rig = Rig::new(interface, trace.setting.clone());
    let (mut ports, mut recorder, mut shown) = (interface.values(), Recorder::new(), true);
    while rig.cycle() <= difference.cycle + AFTER {
        rig.drive(&mut ports);
        if rig.cycle() >= from {
            recorder.cycle(|view| shown = device.view(&ports, view));
        }
        if !shown {
            return Ok(None);
        }
        device.cycle(&mut ports);
        rig.clock(&ports);
    }
    // Of a part the picture before it is not known.
    let before = if from == 0 { cleared(trace) } else { Vec::new() };
    let recording = recorder.finish(from, before);
    let triangles: Vec<_> = suite.triangles().copied().collect();
    let replay = Replay {
        plan,
        scene: &suite.name,
        triangles: &triangles,
        drawn: Counted::of(&triangles),
        of: Counted::of(&triangles),
        recording: &recording,
        truth: &[],
        command: None,
        difference: Some(edgewalk_replay::Difference {
            cycle: (difference.cycle - from) as u32, // below the limit
            text: difference.to_string(),
            expected: difference.port.shown(difference.expected),
            found: difference.port.shown(difference.found),
        }),
        lesson: None,
    };
    Ok(Some(page::html(&replay.json())))
}

/// The memory at the start, by field of the tokens that are stored and by pixel.
fn cleared(trace: &Trace) -> Vec<Plane> {
    let pixels = (trace.plan.width * trace.plan.height) as usize;
    let clear = |name: &str| {
        let place = trace.interface.memories.iter().position(|memory| memory.name == name);
        place.map_or(0, |place| trace.setting.memories[place].clear)
    };
    // Red, green and blue in one word, red the most significant; without BLEND there is no such memory.
    let (bits, color) = (trace.plan.stored_color().bits, clear("color"));
    let word = |place: usize| match place {
        0 => clear("depth") as u32, // b <= 32 bits
        1..=3 => (color >> (bits * (3 - place as u32))) as u32 & (u32::MAX >> (32 - bits)),
        _ => 0,
    };
    let lit = usize::from(trace.plan.shadow.is_there());
    let plane = |place| Plane::new(u32::BITS, std::iter::repeat_n(word(place), pixels));
    (0..trace.plan.seen_channels().count() + lit).map(plane).collect()
}

#[cfg(test)]
#[allow(clippy::print_stdout, reason = "a test says what it checked")]
mod tests {
    use crate::verdict::Verdict;
    use edgewalk_lockstep::{Difference, LockstepError, StallKind, Unit, netlist};
    use edgewalk_machine::{Machine, Plan};
    use edgewalk_model::DrawState;
    use edgewalk_netlist::mutate::mutants;
    use edgewalk_vectors::{Suite, capture};

    /// A triangle on a small machine with these settings.
    fn one(settings: &[(&str, &str)]) -> (Plan, Suite) {
        let mut machine = Machine { width: 16, height: 12, ..Machine::default() };
        settings.iter().for_each(|(key, value)| machine.set(key, value).expect("a key"));
        let plan = machine.plan().expect("can be built");
        let suite = super::super::directed(&plan).expect("suites")[0].clone();
        let values = vec![0.5; plan.channels().len()];
        let corner = |x, y| plan.port_vertex(x, y, &values).expect("on the screen");
        let triangle = [corner(1.0, 1.0), corner(12.0, 3.0), corner(4.0, 10.0)];
        let case = edgewalk_vectors::Case { name: "one".to_owned(), triangles: vec![triangle] };
        (plan, Suite { cases: vec![case], clear_z: None, ..suite })
    }

    /// What a page holds.
    fn replay(page: &str) -> serde_json::Value {
        let data = page.split_once("id=\"replay\">").and_then(|(_, rest)| rest.split_once("</script>"));
        serde_json::from_str(data.expect("a replay in the page").0).expect("JSON")
    }

    /// A fault in the netlist is told by a page that opens where it shows first.
    #[test]
    fn a_fault_opens_where_it_shows() {
        let mut pages = 0;
        for (settings, module) in [(&[][..], "pixel"), (&[("shadow.light", "parallel")], "shadow")] {
            let (plan, suite) = one(settings);
            let state = DrawState { shadow_on: true, ..DrawState::default() };
            let trace = capture(&plan, Unit::MACHINE, &suite, state, StallKind::None);
            let good = netlist(&plan, Unit::MACHINE).expect("it can be built");
            let before = pages;
            let of_module = mutants(&good).into_iter().filter(|mutant| mutant.module.contains(module));
            for mutant in of_module.step_by(7).take(12) {
                let run = trace.lockstep(&mutant.apply(&good));
                let Err(LockstepError::Differs { difference, .. }) = &run else { continue };
                let difference = difference.clone();
                let page =
                    super::page(&suite, &trace, &difference).expect("a replay").expect("of the machine");
                let replay = replay(&page);
                assert_eq!(replay["difference"]["cycle"], difference.cycle);
                assert_ne!(replay["difference"]["expected"], replay["difference"]["found"]);
                assert!(replay["cycles"].as_u64() > Some(difference.cycle));
                assert_eq!(replay["difference"]["text"], difference.to_string());
                pages += 1;
                // The command says the same, how much it compared before, and of how much.
                let out = tempfile::tempdir().expect("a folder");
                let check = super::super::against_netlist(run, &suite, &trace, out.path());
                let check = check.expect("a comparison");
                assert_eq!(check.verdict(), Verdict::Mismatch);
                assert_eq!(check.expected, trace.port_values());
                assert!(check.checked < check.expected, "{} / {}", check.checked, check.expected);
                assert!(out.path().join(format!("{}.html", suite.name)).exists());
            }
            println!("{module}: checked {} pages", pages - before);
            assert!(pages > before + 1, "{module}");
        }
    }

    /// Beyond what a replay can hold from the begin the last cycles are shown, and it opens at the difference.
    #[test]
    fn a_late_difference_is_shown_with_what_came_before() {
        let (plan, suite) = one(&[]);
        let trace = capture(&plan, Unit::MACHINE, &suite, DrawState::default(), StallKind::None);
        let port = trace.interface.status[0].port.clone();
        let found = |cycle| Difference {
            port: port.clone(),
            cycle,
            expected: 0,
            found: 1,
            triangle: None,
            pixel: None,
        };
        for (cycle, first) in [(199_959, 0), (199_960, 199_660)] {
            let page = super::page(&suite, &trace, &found(cycle)).expect("a replay").expect("of the machine");
            let replay = replay(&page);
            assert_eq!(replay["difference"]["cycle"], cycle - first, "{cycle}");
            assert_eq!(replay["cycles"], cycle + 41 - first, "{cycle}");
        }
    }

    #[test]
    fn a_unit_alone_has_no_replay() {
        let (plan, suite) = one(&[]);
        let unit = edgewalk_lockstep::Unit::single(&plan)[1];
        let trace = capture(&plan, unit, &suite, DrawState::default(), StallKind::None);
        let mut difference = None;
        for mutant in mutants(&netlist(&plan, unit).expect("it can be built")) {
            let faulty = mutant.apply(&netlist(&plan, unit).expect("it can be built"));
            if let Err(LockstepError::Differs { difference: found, .. }) = trace.lockstep(&faulty) {
                difference = Some(found);
                break;
            }
        }
        let none = super::page(&suite, &trace, &difference.expect("a fault that shows")).expect("no error");
        assert!(none.is_none(), "a unit alone has no replay");
    }
}
