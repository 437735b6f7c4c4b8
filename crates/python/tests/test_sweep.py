"""`sweep` beside the program. Run by tests/python."""

import csv
import json
import math
import re

import pytest

import edgewalk
from test_edgewalk import file_of, program, triangles

VARY = {"interpolator.adders": [1, 2, 4], "formats.z_fraction": "6..8"}


def test_rows_are_those_of_the_program(tmp_path):
    path = file_of(tmp_path, triangles(20))
    vary = ["--vary", "interpolator.adders=1,2,4", "--vary", "formats.z_fraction=6..8"]
    options = ["--stalls", "none", "--stalls", "fixed:rd=2", "--objective", "cycles", "--objective", "z_error"]
    done = program(tmp_path, "sweep", str(path), *vary, *options, "--out", "s")
    assert done.returncode == 0, done.stderr
    more = {"stalls": ["none", "fixed:rd=2"], "objectives": ["cycles", "z_error"], "store": tmp_path / "rows.jsonl"}
    found = edgewalk.sweep(path, VARY, **more)

    def plain(row):
        return {name: value for name, value in row.items() if name != "seconds"}

    lines = (tmp_path / "s/runs.jsonl").read_text().splitlines()
    theirs = {row["key"]: plain(row) for row in map(json.loads, lines)}
    rows = found.rows
    assert len(rows) == len(theirs) == 18
    assert {row["key"]: plain(row) for row in rows} == theirs
    table = found.table
    with open(tmp_path / "s/runs.csv") as file:
        sheet = list(csv.DictReader(file))
    assert list(table.dtype.names) == list(sheet[0])
    compared = 0
    for name in sheet[0]:
        for value, cell in zip(table[name].tolist(), (row[name] for row in sheet)):
            if name == "seconds":
                continue
            if isinstance(value, str):
                assert value == cell, name
            elif math.isnan(value):
                assert cell == "", name
            else:
                assert value == float(cell), name
                compared += 1
    assert compared > 500 and table["cycles"].dtype == "int64" and (table["front"] >= 1).all()
    for name in more["objectives"]:
        best = found.best[name]
        kept = (tmp_path / f"s/best_{name}.toml").read_text()
        assert edgewalk.Machine.from_toml(kept).with_keys({"screen.width": 64, "screen.height": 48}).hash == best["machine"]
    # Rows of the file are not drawn again.
    text = (tmp_path / "rows.jsonl").read_text()
    assert edgewalk.sweep(path, VARY, **more).rows == rows and (tmp_path / "rows.jsonl").read_text() == text


def test_values_of_any_kind_are_varied(tmp_path):
    path = file_of(tmp_path, triangles(3), "")
    machine = edgewalk.Machine(keys={"interpolator.adders": 2})
    found = edgewalk.sweep([path], {"memory.hazard": ["forward", "drain"], "fifo.span": range(1, 3)}, machine, sample=3, seed=5)
    assert len(found.rows) == 3 and {row["keys"]["interpolator.adders"] for row in found.rows} == {2}
    assert {row["keys"]["memory.hazard"] for row in found.rows} == {"forward", "drain"}


def test_keys_of_a_varied_unit_are_kept(tmp_path):
    path = file_of(tmp_path, triangles(3), "")
    machine = edgewalk.Machine(keys={"blend.kt_bits": 4})
    found = edgewalk.sweep(path, {"blend.kind": ["interpolated"]}, machine)
    assert [row["keys"]["blend.kt_bits"] for row in found.rows] == [4]


def test_inputs_have_weights(tmp_path):
    path = str(file_of(tmp_path, triangles(20)))
    weights = {path: 100.0}
    sums = {}
    found = edgewalk.sweep(["sphere", path], VARY, weights=weights, objectives=["cycles"])
    for row in found.rows:
        cycles = row["report"]["cycles"]["total"] * weights.get(row["input"], 1.0)
        keys = tuple(row["keys"][name] for name in VARY)
        sums[keys] = sums.get(keys, 0.0) + cycles
    best = tuple(found.best["cycles"]["keys"][name] for name in VARY)
    assert len(sums) == 9 and sums[best] == min(sums.values())


WRONG = [
    (lambda: edgewalk.sweep("sphere", {"interpolator.adder": [1]}), "^vary interpolator.adder.*interpolator.adders"),
    (lambda: edgewalk.sweep("sphere", {"interpolator.adders": [0]}), "^vary interpolator.adders.*0"),
    (lambda: edgewalk.sweep("spher", VARY), "spher"),
    (lambda: edgewalk.sweep([], VARY), "no input"),
    (lambda: edgewalk.sweep(3, VARY), "inputs: .*; permitted: names of scenes, and paths of files"),
    (lambda: edgewalk.sweep("sphere", VARY, stalls=["often"]), "^stalls often"),
    (lambda: edgewalk.sweep("sphere", VARY, weights={"spher": 2.0}), "^weight spher=2: .*sphere"),
    (lambda: edgewalk.sweep("sphere", VARY, judge_inputs="wost"), "^judge-inputs wost"),
    (lambda: edgewalk.sweep("sphere", VARY, bound=0.1), "^bound 0.1: permitted: above 0.5 LSB"),
    (lambda: edgewalk.sweep("sphere", VARY, objectives=["cycle"]), "cycle.*cycles"),
    (lambda: edgewalk.sweep("sphere", VARY, sample=0), "^sample 0"),
    (lambda: edgewalk.sweep("sphere", VARY, sample=-1), "^sample: -1; permitted: an integer in 0 to 4294967295"),
    (lambda: edgewalk.sweep("sphere", VARY, sample=2, seed=-1), "^seed: -1; permitted: an integer in 0 to "),
    (lambda: edgewalk.sweep("sphere", VARY, store="/none/rows.jsonl"), "/none/rows.jsonl"),
]


@pytest.mark.parametrize("case", range(len(WRONG)))
def test_bad_input_raises_the_modules_error(case):
    call, said = WRONG[case]
    with pytest.raises(edgewalk.Error) as raised:
        call()
    assert re.search(said, str(raised.value)), raised.value
