"""The bench without a simulator: what it must pass, and each single fault that it must find."""

import re

import edgewalk
import pytest
from conftest import SMALL

from edgewalk_vectors import Bench, Directory, Fault, VectorsError
from edgewalk_vectors.bench import Held, parts

UNITS = ["machine", "setup", "edge", "span", "pixel", "depth"]


def played(directory, design, spoil=None, stop=None, absent=(), compare=None):
    """Runs a design; `spoil(cycle, outputs)` changes what it shows, and after `stop` it shows nothing."""
    bench = Bench(Directory(directory), absent, compare)
    going, cycle = True, 0
    while going:
        bench.drive()
        outputs = design.outputs(cycle)
        if spoil:
            spoil(cycle, outputs)
        if stop is not None and cycle > stop:
            outputs = dict.fromkeys(outputs, 0)
        going = bench.sample(outputs)
        design.clock(cycle)
        cycle += 1
    return bench.finish(), bench


def fails(vectors, player, spoil, said, unit="pixel", **more):
    of_unit, folder = vectors(unit)
    with pytest.raises(Fault) as raised:
        played(folder, player(of_unit), spoil, **more)
    assert re.search(said, str(raised.value)), raised.value


@pytest.mark.parametrize("unit", UNITS)
def test_design_that_does_as_ours_passes(vectors, player, unit):
    of_unit, folder = vectors(unit)
    checked, bench = played(folder, player(of_unit))
    assert checked == bench.expected == of_unit.expected == of_unit.manifest["expected"] > 50


def test_order_alone_counts_tokens_alone(vectors, player):
    of_unit, folder = vectors("pixel")
    status = {field["port"] for field in of_unit.manifest["status"]["fields"]}
    absent = status - {"frag_valid", "span_ready"}
    checked, _ = played(folder, player(of_unit), absent=absent, compare="order")
    assert checked == len(of_unit.tokens("frag"))
    with pytest.raises(VectorsError, match="absent; permitted with compare"):
        played(folder, player(of_unit), absent=absent)
    with pytest.raises(VectorsError, match="compare: 'time'; permitted: cycle, order"):
        played(folder, player(of_unit), compare="time")


def moves(vectors, unit, link, place):
    """The cycle in which a token moves."""
    return int(vectors(unit)[0].cycles(link)[place])


def at(when, change):
    def spoil(cycle, outputs):
        if cycle == when:
            change(outputs)

    return spoil


def flip(port, bit=0):
    def change(outputs):
        outputs[port] ^= 1 << bit

    return change


@pytest.mark.parametrize("port", ["frag_addr", "frag_z", "frag_r", "frag_g", "frag_b", "frag_fence"])
def test_wrong_bit_of_each_field_fails(vectors, player, port):
    for place in [0, -1]:
        said = f"frag: token \\d+, triangle \\d+, case \\w+, cycle \\d+: {port}: expected \\w+, found \\w+"
        fails(vectors, player, at(moves(vectors, "pixel", "frag", place), flip(port)), said)


def test_unknown_bits_fail(vectors, player):
    when = moves(vectors, "pixel", "frag", 5)
    fails(vectors, player, at(when, lambda o: o.update(frag_r=None)), "frag_r: expected \\w+, found unknown bits")
    # The token is right, and whether it is one is not known.
    spoil = at(when, lambda o: o.update(frag_valid=None))
    fails(vectors, player, spoil, "frag_valid: unknown bits", compare="order")


def cycles_of_a_held_value(of_unit):
    """Cycles between a triangle's first token and the entry of the next, in which no token moves."""
    tokens, cycles = of_unit.tokens("line"), of_unit.cycles("line").tolist()
    taken = of_unit.cycles("prim").tolist()
    first = next(c for token, c in zip(tokens, cycles) if token["line_fresh"])
    until = min(c for c in taken if c > first)
    return [c for c in range(first + 1, until) if c not in cycles]


@pytest.mark.parametrize("compare", ["cycle", "order"])
def test_held_value_that_changes_fails(vectors, player, compare):
    of_unit, folder = vectors("edge")
    assert [rule["channel"] for rule in of_unit.manifest["held"]] == ["line"]
    within = cycles_of_a_held_value(of_unit)
    port = of_unit.manifest["held"][0]["ports"][0]
    said = f"{port}: cycle {within[-1]}: changed before the next triangle was taken: \\w+, then \\w+"
    fails(vectors, player, at(within[-1], flip(port)), said, unit="edge", compare=compare)
    unknown = at(within[-1], lambda o: o.update({port: None}))
    fails(vectors, player, unknown, "then unknown bits", unit="edge", compare=compare)


def test_held_value_may_change_with_the_next_triangle(player, tmp_path):
    of_unit = edgewalk.vectors(edgewalk.Machine(keys=SMALL), unit="edge", suite="random", count=5, seed=3)
    of_unit.write(tmp_path / "v")
    (rule,) = of_unit.manifest["held"]
    assert len({tuple(token[port] for port in rule["ports"]) for token in of_unit.tokens("line")}) > 3
    last = {}

    def keep(cycle, outputs):
        """The player shows the values of the next line while none is offered."""
        if outputs["line_valid"]:
            last.update({port: outputs[port] for port in rule["ports"]})
        outputs.update(last)

    checked, bench = played(tmp_path / "v", player(of_unit), keep)
    assert checked == bench.expected


@pytest.mark.parametrize("by_cycle, taken_with, faults", [
    (True, None, 1),     # compared by cycle: the second triangle, taken ahead, ends nothing
    (False, None, 0),    # compared by order: it may be the one whose values are shown
    (True, "prim_ends", 2),  # a token of `prim` without prim_ends ends nothing
])
def test_what_ends_a_held_value(by_cycle, taken_with, faults):
    rule = {"channel": "line", "ports": ["inc_z"], "fresh": "line_fresh", "taken": "prim", "taken_with": taken_with}
    held = Held(rule, (), by_cycle)
    prim, line = {"prim_ends": 0}, {"line_fresh": 1}
    moves = [{"prim": prim}, {"prim": prim}, {"line": line}, {}, {"prim": prim}, {}]
    for cycle, (moved, value) in enumerate(zip(moves, [0, 0, 1, 2, 2, 3])):
        held.sample(cycle, {"inc_z": value}, moved)
    assert len(held.faults) == faults, held.faults


def test_token_that_changes_while_it_waits_fails(vectors, player):
    of_unit, _ = vectors("pixel")
    frag, status = of_unit.cycles("frag"), of_unit.status
    # The last cycle in which a token waits.
    waits = [int(c) - 1 for c in frag if int(c) - 1 not in set(frag.tolist())]
    shown = {}
    for row, after in zip(status, [*status["cycle"][1:], of_unit.total_cycles]):
        shown.update((c, int(row["frag_valid"])) for c in range(int(row["cycle"]), int(after)))
    when = next(c for c in waits if shown.get(c) == 1)
    said = "frag: cycle \\d+: the token changed, or valid fell, before it was taken"
    fails(vectors, player, at(when, flip("frag_b")), said)
    fails(vectors, player, at(when, lambda o: o.update(frag_valid=0)), said, compare="order")


def test_missing_tokens_fail(vectors, player):
    for compare in ["cycle", "order"]:
        stop = moves(vectors, "pixel", "frag", -2)
        fails(vectors, player, None, "never came, the first of 1\n", stop=stop, compare=compare)


def test_token_too_many_fails(vectors, player):
    of_unit, folder = vectors("pixel")
    end = of_unit.total_cycles + 2
    spoil = at(end, lambda o: o.update(frag_valid=1))
    ready = Bench(Directory(folder)).patterns["frag"]
    while ready[end % len(ready)] == 0:
        end += 1
    spoil = at(end, lambda o: o.update(frag_valid=1))
    fails(vectors, player, spoil, f"one more than the {len(of_unit.tokens('frag'))} expected", compare="order")


def test_other_cycle_fails(vectors, player):
    of_unit, folder = vectors("pixel")
    moved, ready = set(of_unit.cycles("frag").tolist()), Bench(Directory(folder)).patterns["frag"]
    when = next(c for c in sorted(moved) if c + 1 not in moved and ready[(c + 1) % len(ready)] == 1)
    late = {}

    def spoil(cycle, outputs):
        if cycle == when:
            late.update(outputs)
            outputs["frag_valid"] = 0
        elif cycle == when + 1:
            outputs.update(late)

    fails(vectors, player, spoil, f"frag: token \\d+, .*, cycle {when + 1}: expected in cycle {when}")


def test_status_port_that_differs_fails(vectors, player):
    fails(vectors, player, at(40, flip("active")), "status: change \\d+, cycle 40: expected")
    fails(vectors, player, at(40, lambda o: o.update(active=None)), "status: change \\d+, cycle 40: ")


def test_port_counts_only_while_its_guard_is_1(vectors, player):
    of_unit, folder = vectors("pixel")
    during = of_unit.manifest["status"]["during"]
    port, guard = next(iter(during.items()))
    changed = []

    def spoil(cycle, outputs):
        if outputs[guard] == 0:
            outputs[port] = None if cycle % 2 else 1
            changed.append(cycle)

    checked, bench = played(folder, player(of_unit), spoil)
    assert checked == bench.expected and len(changed) > 10
    fails(vectors, player, lambda cycle, o: o.update({port: o[port] ^ o[guard]}), "status: change")


def test_directory_of_nothing_fails(vectors, player):
    of_unit, folder = vectors("pixel")
    bench = Bench(Directory(folder))
    for sink in bench.sinks:
        sink.wanted = []
    bench.changes, bench.expected = [], 0
    with pytest.raises(Fault, match="nothing was compared"):
        bench.finish()


def test_run_ends_when_nothing_happens(vectors, player):
    of_unit, folder = vectors("pixel")
    limits = Bench(Directory(folder)).limits
    with pytest.raises(Fault):
        played(folder, player(of_unit), stop=10)
    _, bench = played(folder, player(of_unit))
    last = max(int(of_unit.cycles("frag")[-1]), int(of_unit.status["cycle"][-1]))
    assert last == int(of_unit.status["cycle"][-1]) > int(of_unit.cycles("frag")[-1])
    assert bench.cycle == last + 1 + limits["idle"] + 1


def test_memories_answer_as_ours_do(vectors, player):
    """Words that DEPTH reads come from what was written before: else its own words would differ."""
    of_unit, folder = vectors("depth")
    bench, design = Bench(Directory(folder)), player(of_unit)
    going, cycle, read = True, 0, []
    while going:
        inputs = bench.drive()
        outputs = design.outputs(cycle)
        if cycle in design.moves["data"]:
            read.append((inputs["data_valid"], inputs["data_z"]))
        going = bench.sample(outputs)
        design.clock(cycle)
        cycle += 1
    bench.finish()
    assert read == [(1, int(z)) for z in of_unit.tokens("data")["data_z"]]
    assert len({z for _, z in read}) > 5


@pytest.mark.parametrize("what", ["manifest", "frag.exp.mem", "format", "missing"])
def test_changed_directory_is_refused(vectors, tmp_path, what):
    vectors("pixel")[0].write(tmp_path / "v")
    file = tmp_path / "v" / ("frag.exp.mem" if what in ("frag.exp.mem", "missing") else "manifest.json")
    text = file.read_text()
    if what == "missing":
        file.unlink()
    else:
        old, new = {"manifest": ("{", "["), "format": ("edgewalk-vectors", "other")}.get(what, ("0", "1"))
        file.write_text(text.replace(old, new, 1))
    with pytest.raises(VectorsError, match="manifest.json|is not the file that|No such file|permitted: edgewalk"):
        Directory(tmp_path / "v")


def shy_run(directory, design, spoil=None):
    """The first run of `replay`: whether no ready came before its valid, and the channels that stayed silent."""
    bench, seen, early, cycle = Bench(Directory(directory), shy=True), set(), [], 0
    going = True
    while going and not bench.may_end():
        inputs = bench.drive()
        outputs = design.outputs(cycle)
        if spoil:
            spoil(cycle, outputs)
        early += [sink.name for sink in bench.sinks if inputs[f"{sink.name}_ready"] and sink.name not in seen]
        going = bench.sample(outputs)
        seen |= {sink.name for sink in bench.sinks if outputs[f"{sink.name}_valid"]}
        design.clock(cycle)
        cycle += 1
    return early, bench.silent()


@pytest.mark.parametrize("unit", UNITS)
def test_first_run_takes_only_what_waits(vectors, player, unit):
    of_unit, folder = vectors(unit)
    assert shy_run(folder, player(of_unit)) == ([], [])


def eager_run(folder, spoil):
    """The first run of a design that offers its tokens at once: the bench behind it, and how many cycles it took."""
    bench, cycle = Bench(Directory(folder), shy=True), 0
    going = True
    while going and not bench.may_end():
        inputs, outputs = bench.drive(), dict.fromkeys(bench.outputs, 0)
        outputs.update({f"{name}_ready": 1 for name in bench.sources})
        for sink in bench.sinks:
            outputs[f"{sink.name}_valid"] = int(sink.came < len(sink.wanted))
            outputs.update(parts(sink.fields, sink.wanted[min(sink.came, len(sink.wanted) - 1)]))
        spoil(cycle, outputs)
        going = bench.sample(outputs)
        cycle += 1
    waiting = {sink.name: inputs[f"{sink.name}_ready"] for sink in bench.sinks}
    return bench, cycle, waiting


def test_first_run_ends_where_a_second_token_waits(vectors):
    bench, cycle, waiting = eager_run(vectors("depth")[1], lambda cycle, outputs: None)
    assert bench.found_early() == bench.silent() == [] and 2 < cycle < 200
    assert waiting == {"rd": 0, "wr": 0} and all(sink.came for sink in bench.sinks)


@pytest.mark.parametrize("change, said", [
    ({"wr_valid": None}, "wr: wr_valid was unknown in the first run: does the reset reach wr_valid?"),
    ({"wr_addr": 0x2a5}, "wr: a token of the first run is not the next one: does the reset reach wr_valid?"),
])
def test_valid_that_no_reset_reaches_fails(vectors, change, said):
    folder = vectors("depth")[1]
    early = eager_run(folder, lambda cycle, outputs: outputs.update(change))[0].found_early()
    assert early == [said]
    bench = Bench(Directory(folder))
    bench.early = early
    with pytest.raises(Fault, match=re.escape(said)):
        bench.finish()


def test_valid_that_waits_for_ready_fails(vectors, player):
    of_unit, folder = vectors("pixel")
    early, silent = shy_run(folder, player(of_unit), lambda cycle, o: o.update(frag_valid=0))
    assert (early, silent) == ([], ["frag"])
    bench, design, going, cycle = Bench(Directory(folder)), player(of_unit), True, 0
    bench.stuck = silent
    while going:
        bench.drive()
        going = bench.sample(design.outputs(cycle))
        design.clock(cycle)
        cycle += 1
    with pytest.raises(Fault, match="frag: frag_valid waits for frag_ready, which it must not"):
        bench.finish()
