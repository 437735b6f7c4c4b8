//! A name that does not exist: the error suggests a near one, and no other.

use crate::support::run;

#[test]
fn every_command_suggests_near_names_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let sweep = ["sweep", "sphere", "--out", "s", "--vary"];
    let vectors = ["vectors", "--out", "v", "--suite"];
    for (arguments, suggested) in [
        (&["config", "explain", "hazard"][..], Some("memory.hazard")),
        (&["config", "explain", "memory.hazrad"], Some("memory.hazard")),
        (&["config", "explain", "foo"], None),
        (&["config", "check", "--set", "width=9"], Some("screen.width")),
        (&["config", "check", "--set", "setup.radix=9"], None),
        (&["config", "check", "--set", "edge.fill=exakt"], Some("exact")),
        (&["config", "check", "--set", "edge.fill=foo"], None),
        (&["config", "check", "--machine", "smal"], Some("small")),
        (&["config", "check", "--machine", "foo"], None),
        (&[sweep[0], sweep[1], sweep[2], sweep[3], sweep[4], "foo=1,2"], None),
        (
            &[sweep[0], sweep[1], sweep[2], sweep[3], sweep[4], "interpolator.ader=1,2"],
            Some("interpolator.adders"),
        ),
        (
            &[sweep[0], sweep[1], sweep[2], sweep[3], sweep[4], "setup.lanes=1", "--objective", "cylces"],
            Some("cycles"),
        ),
        (&[sweep[0], sweep[1], sweep[2], sweep[3], sweep[4], "setup.lanes=1", "--objective", "foo"], None),
        (&["synth", "--target", "up5k"], Some("ice40-up5k")),
        (&["synth", "--target", "foo"], None),
        (&["synth", "--unit", "spam"], Some("span")),
        (&["synth", "--unit", "nosuch"], None),
        (&[vectors[0], vectors[1], vectors[2], vectors[3], "hazard"], Some("hazards")),
        (&[vectors[0], vectors[1], vectors[2], vectors[3], "foo"], None),
        (&[vectors[0], vectors[1], vectors[2], vectors[3], "hazards", "--unit", "pixl"], Some("pixel")),
        (&[vectors[0], vectors[1], vectors[2], vectors[3], "hazards", "--unit", "nosuch"], None),
        (&["render", "sphere", "--stalls", "drm"], Some("dram")),
        (&["render", "sphere", "--stalls", "foo"], None),
        (&["render", "spere"], Some("sphere")),
        (&["render", "foo"], None),
        (&["gallery", "mach-band"], Some("mach-bands")),
        (&["gallery", "foo"], None),
    ] {
        let (code, said) = run(folder.path(), arguments);
        assert_eq!(code, Some(2), "{arguments:?}: {said}");
        let near = said.split_once("nearest: ").or_else(|| said.split_once("did you mean `"));
        let near = near.and_then(|(_, near)| near.split(['\n', '`', ' ']).next());
        assert_eq!(near, suggested, "{arguments:?}: {said}");
    }
}
