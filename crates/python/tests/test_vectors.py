"""`vectors` and `Live` beside the program. Run by tests/python."""

import re
import signal
import threading

import numpy as np
import pytest

import edgewalk
from test_edgewalk import HEADER, SCREEN, file_of, program, triangles

SMALL = {"screen.width": 24, "screen.height": 20, "formats.z_bits": 8, "formats.color_bits": 4}
# Machines that have every unit between them.
MACHINES = [
    {"memory.hazard": "drain", "interpolator.adders": 1},
    {"shade.kind": "phong", "texture.kind": "nearest", "texture.bump": "yes", "shade.colour": "multiply"},
    {"shade.kind": "phong", "shade.light": "positional", "shade.colour": "multiply", "setup.kind": "sequenced"},
    {"shadow.light": "perspective", "shadow.project": "pipelined", "blend.kind": "constant"},
    {"polygon.edges": 16, "dither.bits": 4, "formats.color_bits": 8},
]


def settings(keys):
    return [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]


def same(one, other):
    files = [sorted(p.relative_to(f) for p in f.rglob("*") if p.is_file()) for f in (one, other)]
    assert files[0] == files[1] and len(files[0]) > 15
    for name in files[0]:
        assert (one / name).read_bytes() == (other / name).read_bytes(), name


@pytest.mark.parametrize("suite, unit, more", [
    ("hazards", "pixel", {}),
    ("random", "machine", {"count": 5, "seed": 3, "stalls": "late"}),
    ("depth_gequal", "depth", {}),
    ("corners", "setup", {"only": ["flat_top", "flat_bottom"]}),
])
def test_directory_is_that_of_the_program(tmp_path, suite, unit, more):
    options = [w for key, value in more.items() if key != "only" for w in (f"--{key}", str(value))]
    options += [word for case in more.get("only", []) for word in ("--only", case)]
    done = program(tmp_path, "vectors", "--suite", suite, "--unit", unit, "--out", "p", *options, *settings(SMALL))
    assert done.returncode == 0, done.stderr
    made = edgewalk.vectors(edgewalk.Machine(keys=SMALL), unit=unit, suite=suite, **more)
    made.write(tmp_path / "m", tables=True)
    assert made.name == f"{suite}_{unit}"
    same(tmp_path / "p" / made.name, tmp_path / "m")
    made.write(tmp_path / "m")  # once more, in place of the first
    assert list((tmp_path / "m").glob("*.csv"))


def test_triangles_are_a_suite(tmp_path):
    values = triangles(6)
    path = file_of(tmp_path, values)
    done = program(tmp_path, "vectors", "own.tri", "--unit", "span", "--no-csv", "--out", "p")
    assert done.returncode == 0, done.stderr
    made = edgewalk.vectors(unit="span", triangles=path)
    made.write(tmp_path / "m")
    found, expected = [(tmp_path / f / "span.exp.mem").read_bytes() for f in ("m", "p/own_span")]
    assert found == expected and len(found) > 100
    array = edgewalk.vectors(edgewalk.Machine(keys=SCREEN), unit="span", triangles=values, header=HEADER)
    assert array.name == "triangles_span" and np.array_equal(array.tokens("span"), made.tokens("span"))


def test_arrays_are_those_of_the_directory(tmp_path):
    made = edgewalk.vectors(edgewalk.Machine(keys=SMALL), unit="pixel", suite="corners")
    made.write(tmp_path / "v")
    manifest, total = made.manifest, 0
    for channel in manifest["channels"]:
        tokens, name = made.tokens(channel["name"]), channel["name"]
        assert tokens.dtype.names == tuple(field["port"] for field in channel["fields"])
        packed = np.zeros(len(tokens), object)
        for field in channel["fields"]:
            values = tokens[field["port"]]
            assert values.dtype == (np.int64 if field["signed"] else np.uint64)
            packed += [(int(value) & (1 << field["width"]) - 1) << field["lsb"] for value in values]
        words = [int(line, 16) for line in (tmp_path / "v" / channel["tokens"]).read_text().split()]
        assert packed.tolist() == words
        for array, file in [(made.cycles(name), channel["moved"]), (made.triangles(name), channel["triangles"])]:
            if file:
                steps = [int(line, 16) for line in (tmp_path / "v" / file).read_text().split()]
                assert array.tolist() == (np.cumsum(steps) & 0xFFFFFFFF).tolist()
        assert (made.tokens("span")["span_x"] < 0).any(), "signed values keep their sign"
        total += len(tokens) if channel["direction"] == "out" else 0
    assert made.expected == manifest["expected"] == total + len(made.status)
    assert made.total_cycles == manifest["cycles"] and made.links == ["span", "frag"]
    assert made.status.dtype.names[0] == "cycle" and (np.diff(made.status["cycle"].astype(int)) > 0).all()
    assert "hazards" in dict(edgewalk.suites()) and "shade" not in dict(edgewalk.suites())


def units(keys):
    names = "setup edge poly span term pixel texel bump normal lamp shade project shadow dither depth blend".split()
    machine = edgewalk.Machine(keys={**SMALL, **keys})
    cases = [case["name"] for case in edgewalk.vectors(machine, unit="setup").manifest["suite"]["cases"][:6]]
    for name in ["machine", *names]:
        try:
            yield name, edgewalk.vectors(machine, unit=name, only=cases)
        except edgewalk.Error as error:
            assert "the machine" in str(error) or "unknown unit" in str(error), error


@pytest.mark.parametrize("keys", MACHINES)
def test_live_unit_gives_what_the_vectors_expect(tmp_path, keys):
    compared, seen = 0, 0
    for name, made in units(keys):
        manifest = made.manifest
        starts = {m["name"]: int(m["clear"], 16) for m in manifest["memories"]}
        made.write(tmp_path / name)
        words = {m["name"]: (tmp_path / name / m["start"]).read_text().split() for m in manifest["memories"] if m.get("start")}
        words = {memory: [int(word, 16) for word in of] for memory, of in words.items()}
        live = edgewalk.Live(
            name, edgewalk.Machine(keys={**SMALL, **keys}), constants=manifest["constants"], memories=words, clear=starts
        )
        assert live.takes == made.links[0]
        tokens = {link: iter(made.tokens(link).tolist()) for link in live.gives}
        given = made.tokens(live.takes)
        for place, token in enumerate(given.tolist()):
            live.give(dict(zip(given.dtype.names, token)))
            if place % 25:
                continue
            # As a simulation does: some of what comes is asked for while more is given.
            for link in live.gives:
                found = live.next(link)
                if found is not None:
                    assert tuple(found.values()) == next(tokens[link]), (name, link)
                    compared += 1
        for link in live.gives:
            while (found := live.next(link)) is not None:
                assert tuple(found.values()) == next(tokens[link]), (name, link)
                compared += 1
            assert next(tokens[link], None) is None, (name, link)
        assert set(live.rest().values()) == {0}
        seen += 1
    assert compared > 300 and seen >= 6


def test_live_unit_may_be_used_by_another_thread():
    made = edgewalk.vectors(edgewalk.Machine(keys=SMALL), unit="pixel")
    live, given, found = edgewalk.Live("pixel", edgewalk.Machine(keys=SMALL)), made.tokens("span"), []
    def feed():
        live.give(dict(zip(given.dtype.names, given.tolist()[0])))
        found.append(live.next(live.gives[0]))
    thread = threading.Thread(target=feed)
    thread.start()
    thread.join()
    assert [tuple(token.values()) for token in found] == made.tokens(live.gives[0]).tolist()[:1]


def test_live_unit_has_memories_of_its_own():
    machine = edgewalk.Machine(keys=SMALL)
    made = edgewalk.vectors(machine, unit="depth")
    frag = dict(zip(made.tokens("frag").dtype.names, made.tokens("frag").tolist()[0]))
    address = frag["frag_addr"]
    def written(**more):
        live = edgewalk.Live("depth", machine, **more)
        live.give(frag)
        assert live.rest() == {"rd": 1, "wr": int(more.get("clear", {}).get("depth") != 0 and "memories" not in more)}
        return live.next("rd")
    assert written() == written(clear={"depth": 255}) == written(clear={"depth": 0}) == {"rd_addr": address}
    assert written(memories={"depth": np.zeros(address + 1, int)}) == {"rd_addr": address}


def live(**more):
    return edgewalk.Live("pixel", edgewalk.Machine(keys=SMALL), **more)


WRONG = [
    (lambda: edgewalk.vectors(unit="pixl"), "unknown unit pixl; permitted: .*; nearest: pixel; or set the keys"),
    (lambda: edgewalk.vectors(unit="shade"), "unknown unit shade; permitted: "),
    (lambda: edgewalk.vectors(suite="hazard"), "unknown suite hazard; permitted: .*; nearest: hazards"),
    (lambda: edgewalk.vectors(suite="shade"), "unknown suite shade; permitted: "),
    (lambda: edgewalk.vectors(suite="depth_less", unit="span"), "unit span: the suite depth_less says nothing about it; permitted: machine, depth"),
    (lambda: edgewalk.vectors(only=["flat"]), "only: unknown case flat; permitted: "),
    (lambda: edgewalk.vectors(stalls="often"), "unknown stalls often; permitted: none, mixed, late"),
    (lambda: edgewalk.vectors(suite="random", count=0), "count: 0; permitted: an integer in 1 to 10000"),
    (lambda: edgewalk.vectors(suite="random", count=-1), "count: -1; permitted: an integer in 1 to 10000"),
    (lambda: edgewalk.vectors(suite="random", count=10**11), "count: 100000000000; permitted: an integer in 1 to 10000"),
    (lambda: edgewalk.vectors(seed=-1), "seed: -1; permitted: an integer in 0 to 18446744073709551615"),
    (lambda: edgewalk.vectors(seed=2**64), "seed: 18446744073709551616; permitted: an integer in 0 to 18446744073709551615"),
    (lambda: edgewalk.vectors(seed=0.5), "seed: 0.5; permitted: an integer in 0 to "),
    (lambda: edgewalk.vectors(suite="hazards", triangles=triangles(1)), "suite and triangles; permitted: one of the two"),
    (lambda: edgewalk.vectors(unit="pixel").tokens("fragg"), "unknown link fragg; permitted: span, frag; nearest: frag"),
    (lambda: edgewalk.vectors(unit="pixel").write("/proc"), "/proc: a folder with other files; permitted: a new or empty one"),
    (lambda: edgewalk.Live("pixl"), "unknown unit pixl"),
    (lambda: edgewalk.Live("depth", constants={"depth_fun": 1}), "unknown constant depth_fun; .*nearest: depth_func"),
    (lambda: edgewalk.Live("depth", constants={"depth_func": 8}), "depth_func: 8; permitted: an integer in 0 to 7"),
    (lambda: edgewalk.Live("depth", clear={"dept": 8}), "unknown memory dept; permitted: depth; nearest: depth"),
    (lambda: edgewalk.Live("depth", clear={"depth": -1}), "memory depth: -1; permitted: an integer in 0 to 16777215"),
    (lambda: edgewalk.Live("depth", memories={"depth": [1] * (1 << 20)}), "memory depth: 1048576 words; permitted: 524288"),
    (lambda: live().next("span"), "unknown link span; permitted: frag"),
    (lambda: live().give({"span_x": 1}), "token of span: no span_y; permitted: a value for each port"),
    (lambda: live().give({"span_q": 1}), "unknown port span_q; permitted: span_x"),
    (lambda: live().give({"span_x": 1 << 80}), "token of span: span_x: .*; permitted: an integer in -"),
    (lambda: live().give({"span_x": 0.5}), "token of span: span_x: 0.5; permitted: an integer in -"),
]


@pytest.mark.parametrize("case", range(len(WRONG)))
def test_bad_input_raises_the_modules_error(case):
    call, said = WRONG[case]
    with pytest.raises(edgewalk.Error) as raised:
        call()
    assert re.search(said, str(raised.value)), raised.value


def test_unit_that_runs_on_ends_with_ctrl_c():
    live = edgewalk.Live("pixel", edgewalk.Machine("small"))
    none = {port[0]: 0 for port in live.ports["span"]}
    for _ in range(2):
        live.give(none)
    signal.signal(signal.SIGALRM, lambda *_: (_ for _ in ()).throw(KeyboardInterrupt))
    signal.setitimer(signal.ITIMER_REAL, 0.3)
    with pytest.raises(KeyboardInterrupt):
        live.rest()
