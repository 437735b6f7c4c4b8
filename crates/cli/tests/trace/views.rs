//! Save files for viewers: each line of them names a signal of the waveform, in a format that fits it.

use crate::support::edgewalk;
use std::collections::BTreeMap;
use std::path::Path;

const KEYS: [&str; 8] = [
    "--set",
    "screen.width=24",
    "--set",
    "screen.height=20",
    "--set",
    "screen.guard_bits=6",
    "--set",
    "blend.kind=constant",
];

/// The save files beside a waveform of this kind.
fn views(folder: &Path, kind: &str) -> [String; 2] {
    let out = format!("t.{kind}");
    let triangle = "T 2 2 0.2 1 0 0 0.5  12 3 0.5 0 1 0 0.5  4 15 0.8 0 0 1 0.5\n";
    std::fs::write(folder.join("in.tri"), format!("size 24 20\n{triangle}{triangle}")).expect("written");
    let arguments = ["trace", "in.tri", "--cycles", "200", "--views", "--out", &out];
    let output = edgewalk(folder, &[&arguments[..], &KEYS].concat()).output().expect("the program runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(said, format!("200 cycles -> {out}; views: .gtkw, .sucl\n"));
    ["t.gtkw", "t.sucl"].map(|name| std::fs::read_to_string(folder.join(name)).expect("written"))
}

/// Bits of the signals of a VCD by their paths; of a text none.
fn signals(text: &str) -> BTreeMap<String, Option<u32>> {
    let (mut scopes, mut found) = (Vec::new(), BTreeMap::new());
    for line in text.lines().take_while(|line| !line.starts_with("$enddefinitions")) {
        match line.split_whitespace().collect::<Vec<_>>()[..] {
            ["$scope", "module", name, "$end"] => scopes.push(name),
            ["$upscope", "$end"] => _ = scopes.pop(),
            ["$var", kind, width, _, name, "$end"] => {
                let bits = (kind == "wire").then(|| width.parse().expect("bits"));
                found.insert(format!("{}.{name}", scopes.join(".")), bits);
            }
            _ => {}
        }
    }
    found
}

#[test]
fn gtkwave_shows_each_port_with_its_point() {
    let folder = tempfile::tempdir().expect("a folder");
    let [text, _] = views(folder.path(), "vcd");
    let there = signals(&std::fs::read_to_string(folder.path().join("t.vcd")).expect("written"));
    let (mut flags, mut shift, mut shown) = (0, 0, BTreeMap::new());
    for line in text.lines().filter(|line| !line.starts_with("[*]")) {
        if let Some(hex) = line.strip_prefix('@') {
            (flags, shift) = (u64::from_str_radix(hex, 16).expect("flags"), 0);
        } else if let Some(count) = line.strip_prefix("[fpshift_count] ") {
            shift = count.parse().expect("a number");
        } else if !line.starts_with(['[', '-']) {
            let (path, width) = match line.split_once('[') {
                Some((path, range)) => {
                    let upper = range.strip_suffix(":0]").expect("from bit 0 on");
                    (path, Some(upper.parse::<u32>().expect("a number") + 1))
                }
                None => (line, there[line]),
            };
            assert_eq!(there.get(path), Some(&width), "{line}");
            assert!(shown.insert(path.to_owned(), (flags, shift)).is_none(), "{path} twice");
        }
    }
    println!("checked {} signals", shown.len());
    assert!(shown.len() > 100 && shown.keys().any(|path| path.starts_with("edgewalk.u_blend.")));
    for (path, flags, shift) in [
        ("edgewalk.tri_valid", 0x28, 0),
        ("edgewalk.tri_x0", 0x4000_0420, 8),
        ("edgewalk.tri_z0", 0x4000_0024, 4),
        ("edgewalk.zwr_addr", 0x24, 0),
        ("edgewalk.u_edge.line_y", 0x24, 0),
        ("edgewalk.activity_name", 0x820, 0),
    ] {
        assert_eq!(shown.get(path), Some(&(flags, shift)), "{path}");
    }
    assert!(shown.values().any(|(flags, shift)| flags & 0x4000_0000 != 0 && *shift > 8));
    assert!(shown.values().all(|(flags, shift)| (flags & 0x4000_0000 != 0) == (*shift > 0)));
    assert!(
        text.lines().any(|line| line == "-machine tri") && text.lines().any(|line| line == "-depth status")
    );
    // An FST keeps names as characters.
    let [text, _] = views(folder.path(), "fst");
    assert!(text.contains("@820\nedgewalk.activity_name[71:0]\n"), "{text}");
}

#[test]
fn surfer_sets_a_format_for_each_port() {
    let folder = tempfile::tempdir().expect("a folder");
    let [_, text] = views(folder.path(), "vcd");
    let there = signals(&std::fs::read_to_string(folder.path().join("t.vcd")).expect("written"));
    let (mut items, mut focus, mut formats) = (Vec::new(), None, BTreeMap::new());
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        match line.split_once(' ').unwrap_or((line, "")) {
            ("divider_add", name) => items.push(format!("-{name}")),
            ("variable_add", path) => {
                assert!(there.contains_key(path) && focus.is_none(), "{line}");
                items.push(path.to_owned());
            }
            ("item_focus", letters) => {
                let digit = |place, letter: char| 16 * place + (letter as usize - 'a' as usize);
                focus = Some(letters.strip_suffix('_').expect("a mark").chars().fold(0, digit));
            }
            ("item_set_format", format) => _ = formats.insert(items[focus.expect("a focus")].clone(), format),
            ("item_unfocus" | "zoom_fit", "") => {}
            other => panic!("{other:?}"),
        }
    }
    println!("checked {} formats", formats.len());
    let variables = items.iter().filter(|item| !item.starts_with('-'));
    for path in variables.clone() {
        let wanted = match there[path] {
            None => None,
            Some(1) => Some("Bit"),
            Some(_) => {
                ["Signed", "Unsigned", "Hexadecimal"].into_iter().find(|f| formats.get(path) == Some(f))
            }
        };
        assert_eq!(formats.get(path).copied(), wanted, "{path}");
    }
    assert!(variables.count() > 100 && formats["edgewalk.tri_x0"] == "Signed");
    assert!(items.iter().any(|item| item == "-depth_status") && formats["edgewalk.zwr_addr"] == "Unsigned");
    let [_, text] = views(folder.path(), "fst");
    assert!(text.contains("item_set_format ASCII\n"));
}

#[test]
fn views_of_transitions_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let output =
        edgewalk(folder.path(), &["trace", "sphere", "--views", "--out", "t.saif"]).output().expect("runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("--views --out t.saif: a SAIF has no waveform; permitted with .vcd and .fst"),
        "{said}"
    );
}
