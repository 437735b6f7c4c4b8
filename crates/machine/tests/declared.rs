//! What machines of several kinds declare, by hand: widths that follow from two keys, what is there for some machines only.

use edgewalk_machine::presets::PRESETS;
use edgewalk_machine::{Machine, Plan, Ports, Ready, UNITS, UnitSpec};

/// The default machine but for these keys.
fn machine(keys: &[(&str, &str)]) -> Machine {
    let mut machine = Machine::default();
    for (key, value) in keys {
        machine.set(key, value).expect("a key of the machine");
    }
    machine
}

fn plan(keys: &[(&str, &str)]) -> Plan {
    machine(keys).plan().expect("can be built")
}

fn unit(name: &str) -> &'static UnitSpec {
    UNITS.iter().find(|unit| unit.name == name).expect("a unit")
}

/// Bits of the address by which a unit reads its memory.
fn address_bits(name: &str, plan: &Plan) -> u32 {
    let ports = (unit(name).ports)(plan);
    ports.memory[0].read.fields[0].width()
}

fn can_happen(name: &str, event: &str, plan: &Plan) -> bool {
    let event = unit(name).events.iter().find(|declared| declared.name == event).expect("an event");
    (event.can_happen)(plan)
}

#[test]
fn a_texel_is_addressed_by_material_line_and_column() {
    for (materials, side) in [(0, 1), (4, 8), (8, 11)] {
        let keys = [
            ("shade.kind", "phong".to_owned()),
            ("shade.colour", "multiply".to_owned()),
            ("texture.kind", "nearest".to_owned()),
            ("shade.material_bits", materials.to_string()),
            ("texture.bits", side.to_string()),
        ];
        let keys: Vec<_> = keys.iter().map(|(key, value)| (*key, value.as_str())).collect();
        let plan = plan(&keys);
        assert_eq!(address_bits("texel", &plan), materials + 2 * side);
        // The last texel of the last material has the last address.
        let (material, last) = ((1 << materials) - 1, (1 << side) - 1);
        assert_eq!(plan.texel_place(material, last, last), (1 << (materials + 2 * side)) - 1);
        if side == 8 {
            assert_eq!(plan.texel_place(9, 5, 3), 0x9_03_05, "material, line v, column u");
        }
    }
}

#[test]
fn a_map_is_addressed_by_the_bits_of_its_side() {
    for (size, side) in [("1", 1), ("2", 1), ("3", 2), ("512", 9), ("513", 10), ("4096", 12)] {
        let plan = plan(&[("shadow.light", "parallel"), ("shadow.size", size)]);
        assert_eq!((plan.shadow.side_bits(), address_bits("shadow", &plan)), (side, 2 * side), "{size}");
    }
}

#[test]
fn the_longest_word_of_a_channel_is_permitted() {
    let longest = plan(&[("formats.z_bits", "32"), ("formats.z_fraction", "24")]);
    assert_eq!(longest.channels()[0].word(), 56);
}

#[test]
fn a_segment_has_two_bits_at_least() {
    for (segments, bits, fraction, fits) in
        [("4", "4", "4", true), ("4", "4", "3", false), ("2", "2", "2", true), ("2", "2", "1", false)]
    {
        let machine = machine(&[
            ("interpolator.segments", segments),
            ("formats.color_bits", bits),
            ("formats.color_fraction", fraction),
            ("formats.color_vertex", "1"),
        ]);
        let error = machine.plan().err().map(|error| error.to_string());
        assert_eq!(error.is_none(), fits, "{segments} segments, {bits} + {fraction} bits: {error:?}");
        assert!(error.is_none_or(|error| error.contains("segments of two bits")));
    }
}

#[test]
fn a_machine_that_draws_its_map_needs_no_more_than_its_depths() {
    let light = [("shadow.light", "parallel"), ("shadow.own_pass", "yes"), ("formats.z_bits", "16")];
    for (bits, fits) in [("15", true), ("16", true), ("17", false)] {
        let keys = [&light[..], &[("shadow.depth_bits", bits)]].concat();
        let error = machine(&keys).plan().err().map(|error| error.to_string());
        assert_eq!(error.is_none(), fits, "{bits}: {error:?}");
    }
    for own_pass in ["no", "yes"] {
        let plan =
            plan(&[("shadow.light", "parallel"), ("shadow.own_pass", own_pass), ("shadow.depth_bits", "16")]);
        assert_eq!(can_happen("shadow", "own_map", &plan), own_pass == "yes");
    }
}

#[test]
fn materials_change_only_where_there_are_several() {
    for (bits, several) in [("0", false), ("1", true)] {
        let plan = plan(&[("shade.kind", "fast-phong"), ("shade.material_bits", bits)]);
        assert_eq!(can_happen("shade", "material_change", &plan), several);
        assert!(can_happen("shade", "tables_read", &plan));
    }
    assert!(!can_happen("shade", "tables_read", &Plan::default()));
}

#[test]
fn a_light_is_divided_only_in_perspective() {
    for (light, divided) in [("none", false), ("parallel", false), ("perspective", true)] {
        let plan = plan(&[("shadow.light", light)]);
        assert_eq!((unit("project").present)(&plan), divided, "{light}");
        assert_eq!((unit("shadow").present)(&plan), light != "none");
    }
}

#[test]
fn what_needs_no_texel_comes_behind_one_that_does_only_where_there_is_room() {
    for (queue, room) in [("1", false), ("2", true), ("16", true)] {
        let plan = plan(&[("shadow.light", "parallel"), ("fifo.shadow", queue)]);
        assert_eq!(can_happen("shadow", "known_behind_read", &plan), room, "{queue}");
    }
    assert!(!can_happen("shadow", "known_behind_read", &Plan::default()));
}

#[test]
fn what_colours_in_flight_can_meet_follows_from_the_policy() {
    // With drain, with interlock, with forward.
    let events = [
        ("opaque", [true; 3]),
        ("opaque_behind", [false, true, true]),
        ("color_drain_stall", [true, false, false]),
        ("color_interlock_stall", [false, true, false]),
        ("behind_opaque", [false, false, true]),
        ("color_head_wait", [false, false, true]),
        ("color_forward_queue", [false, false, true]),
        ("color_forward_entry", [false, false, true]),
        ("color_forward_write", [false, false, true]),
        ("color_forward_used", [false, false, true]),
    ];
    for (place, hazard) in ["drain", "interlock", "forward"].into_iter().enumerate() {
        let policy = ("memory.color_hazard", hazard);
        let (blend, none) = (plan(&[("blend.kind", "constant"), policy]), plan(&[policy]));
        for (event, can) in events {
            assert_eq!(can_happen("blend", event, &blend), can[place], "{event}, {hazard}");
            assert!(!can_happen("blend", event, &none), "{event} without BLEND");
        }
    }
}

/// Where it depends on the token whether it is taken: nothing else may be asked of such a ready.
#[test]
fn a_ready_is_for_a_token_where_it_depends_on_what_is_offered() {
    let plan = plan(&[
        ("shade.kind", "phong"),
        ("shade.colour", "multiply"),
        ("texture.kind", "nearest"),
        ("texture.bump", "yes"),
        ("shadow.light", "perspective"),
        ("blend.kind", "constant"),
    ]);
    let mut found = Vec::new();
    for unit in plan.units() {
        let ports = (unit.ports)(&plan);
        let memories = ports.memory.iter().flat_map(|memory| [&memory.read, &memory.data]);
        let links = ports.takes.iter().chain(&ports.gives).chain(&ports.writes).chain(memories);
        let for_tokens = links.filter(|link| link.ready == Ready::WhileValid);
        found.extend(for_tokens.map(|link| format!("{} {}", unit.name, link.name)));
    }
    let by_hand = [
        "term span",
        "texel frag",
        "texel xdata",
        "shade frag",
        "shadow frag",
        "shadow mdata",
        "depth frag",
        "depth pass",
        "blend pass",
    ];
    assert_eq!(found, by_hand);
}

/// Keys of a light of the other kind mean nothing: they stay out of the file and of the machine's name.
#[test]
fn a_light_has_the_keys_of_its_kind() {
    for (light, keys) in [
        ("none", [false, false, false, false]),
        ("parallel", [true, true, false, false]),
        ("perspective", [true, false, true, true]),
    ] {
        let plain = machine(&[("shadow.light", light)]);
        let file = plain.to_toml();
        let settings =
            [("depth_bits", "12"), ("guard_bits", "5"), ("light_bits", "22"), ("project", "serial")];
        for ((key, value), means) in settings.into_iter().zip(keys) {
            let section = file.split("[shadow]").nth(1).unwrap_or_default();
            assert_eq!(section.contains(&format!("\n{key} = ")), means, "{light}, {key}");
            let other = machine(&[("shadow.light", light), (&format!("shadow.{key}"), value)]);
            assert_eq!(other.hash() != plain.hash(), means, "{light}, {key}");
        }
    }
}

#[test]
fn k_t_is_the_triangles_or_a_channel() {
    for (kind, of_triangle, channels) in
        [("none", false, 4), ("constant", true, 4), ("interpolated", false, 5)]
    {
        let plan = plan(&[("blend.kind", kind)]);
        let port = (unit("setup").ports)(&plan).takes.expect("triangles");
        let kt = |name: &str| port.fields.iter().any(|field| field.name == name);
        assert_eq!(
            (kt("kt"), kt("kt0"), plan.channels().len()),
            (of_triangle, channels == 5, channels),
            "{kind}"
        );
    }
}

#[test]
fn k_t_of_a_vertex_is_a_share() {
    let plan = plan(&[("blend.kind", "constant"), ("blend.kt_bits", "8")]);
    let vertex = |kt: f64| plan.port_vertex(0.0, 0.0, &[0.0, 0.0, 0.0, 0.0, kt]);
    for (kt, word) in [(0.0, 0), (0.25, 64), (1.0, 256)] {
        assert_eq!(vertex(kt).expect("a share").kt(), word);
    }
    for kt in [-0.001, 1.001, f64::NAN] {
        assert!(vertex(kt).expect_err("no share").to_string().contains("kt"));
    }
}

#[test]
fn slopes_stand_below_the_colour_of_a_texel() {
    let keys = |kind, bits| {
        [
            ("shade.kind", kind),
            ("shade.colour", "multiply"),
            ("texture.kind", "nearest"),
            ("texture.bump", "yes"),
            ("texture.slope_bits", bits),
        ]
    };
    for (kind, bits, record, given) in [("fast-phong", "5", 33, 11), ("phong", "16", 42, 18)] {
        let plan = plan(&keys(kind, bits));
        let slope: u32 = bits.parse().expect("a number");
        let texel = (unit("texel").ports)(&plan);
        assert_eq!(texel.memory[0].data.fields[0].width(), 24 + 2 * slope);
        assert_eq!((plan.texel_word_bits(), plan.record_length()), (24 + 2 * slope, record));
        assert_eq!(
            plan.texel_word([1, 2, 3], [-1, 4]),
            ((0x01_0203 << slope) + (1 << slope) - 1) << slope | 4
        );
        let bumped = (unit("bump").ports)(&plan).gives.expect("a link").fields;
        let cosine = bumped.iter().find(|field| ["nl0", "pl0"].contains(&field.name.as_str()));
        assert_eq!(cosine.expect("a cosine").width(), given);
        assert!(bumped.iter().all(|field| !["bu", "bv", "nl0u", "tuu"].contains(&field.name.as_str())));
        assert_eq!(can_happen("bump", "square_cut", &plan), kind == "phong");
    }
    // Without the key all is as it was.
    let plain =
        plan(&keys("phong", "16").map(|(key, value)| (key, if value == "yes" { "no" } else { value })));
    assert_eq!((plain.texel_word_bits(), plain.record_length()), (24, 21));
    assert!(!(unit("bump").present)(&plain) && plain.texel_word([1, 2, 3], [-1, 4]) == 0x01_0203);
    let long = machine(&keys("fast-phong", "4"));
    for (key, most) in [("term.fraction", "40"), ("term.linear_fraction", "40")] {
        let mut long = long.clone();
        for (key, value) in [("shade.table_bits", "10"), ("shade.gloss_bits", "8"), (key, "41")] {
            long.set(key, value).expect("a key");
        }
        let error = long.plan().expect_err("65 bits").to_string();
        assert!(error.contains(key) && error.contains("65 bits") && error.contains(most), "{error}");
    }
}

#[test]
fn sequenced_setup_takes_a_triangle_word_by_word() {
    let keys = [("setup.kind", "sequenced"), ("blend.kind", "constant"), ("memory.tag_bits", "5")];
    let plan = plan(&keys);
    let link = (unit("setup").ports)(&plan).takes.expect("a link");
    let words: Vec<&str> = link.words.iter().map(|word| word.name.as_str()).collect();
    let vertices = ["x0 y0 z0 r0 g0 b0", "x1 y1 z1 r1 g1 b1", "x2 y2 z2 r2 g2 b2", "kt"].join(" ");
    assert_eq!(words, vertices.split(' ').collect::<Vec<_>>());
    assert_eq!(plan.triangle_words() as usize, words.len());
    // z has 24 + 4 bits, x 14 + 8, a colour 8 + 4, kt 9.
    let ports: Vec<(&str, u32)> = link.fields.iter().map(|port| (port.name.as_str(), port.width())).collect();
    assert_eq!((link.name, ports), ("in", vec![("data", 28), ("tag", 5)]));
}

/// Every port says what it means, whatever the machine; no meaning begins with what the format says.
#[test]
fn every_port_has_a_meaning() {
    let presets = PRESETS.iter().map(|(name, _)| Machine::preset(name).expect("a preset"));
    let keys: [&[(&str, &str)]; 4] = [
        &[("shade.kind", "phong"), ("shadow.light", "parallel"), ("blend.kind", "interpolated")],
        &[("shadow.light", "perspective"), ("blend.kind", "constant"), ("memory.tag_bits", "4")],
        &[
            ("channels.extra", "4"),
            ("polygon.edges", "8"),
            ("polygon.values", "bilinear"),
            ("edge.kind", "slope"),
        ],
        &[("polygon.edges", "8"), ("polygon.lines", "yes"), ("shadow.light", "parallel")],
    ];
    let (mut ports, mut without) = (0, Vec::new());
    for machine in presets.chain(keys.map(machine)) {
        let plan = machine.plan().expect("can be built");
        for unit in plan.units() {
            let Ports { takes, gives, writes, held_in, held_out, memory, constants, levels, status } =
                (unit.ports)(&plan);
            let reads = memory.into_iter().flat_map(|memory| [memory.read, memory.data]);
            let links = takes.into_iter().chain(gives).chain(writes).chain(reads);
            let fields = links.flat_map(|link| link.fields.into_iter().chain(link.words));
            let held = held_in.into_iter().chain(held_out).flat_map(|held| held.fields);
            let single =
                constants.into_iter().chain(levels).chain(status.into_iter().map(|status| status.field));
            for field in fields.chain(held).chain(single) {
                ports += 1;
                let twice = field.to_string().matches("signed").count() > 1;
                if field.doc.is_empty() || twice {
                    without.push(format!("{} {}: {field}", unit.name, field.name));
                }
            }
        }
    }
    println!("checked {ports} ports");
    assert!(without.is_empty() && ports > 1000, "{ports} ports; {without:#?}");
}
