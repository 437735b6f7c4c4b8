"""The module `edgewalk` beside the program: EDGEWALK names the program. Run by tests/python."""

import json
import os
import re
import subprocess
from pathlib import Path
from types import MappingProxyType

import numpy as np
import pytest

import edgewalk

ROOT = Path(__file__).parents[3]
SCREEN = {"screen.width": 64, "screen.height": 48}
HEADER = "depth lequal\nclear 0 0 0.25"
ENGINES = ["golden", "scanline", "fast", "model", "rtl"]
# A wheel with the feature jit is built where EDGEWALK_JIT is set.
JIT = bool(os.environ.get("EDGEWALK_JIT"))


def triangles(count=40):
    values = np.random.default_rng(7).random((count, 3, 7))
    values[..., 0] *= 64
    values[..., 1] *= 48
    values[..., 6] = 0
    return values


def program(folder, *arguments):
    return subprocess.run([os.environ["EDGEWALK"], *arguments], cwd=folder, capture_output=True, text=True)


def file_of(folder, values, header=HEADER):
    lines = ["T " + " ".join(repr(float(v)) for v in triangle.ravel()) for triangle in values]
    path = folder / "own.tri"
    path.write_text("\n".join(["size 64 48", header, *lines]) + "\n")
    return path


@pytest.mark.parametrize("engine", ENGINES + ["jit"] * JIT)
@pytest.mark.parametrize("keys", [{}, {"formats.z_bits": 32, "formats.color_bits": 16}, {"interpolator.adders": 1}])
def test_arrays_are_those_of_the_program(tmp_path, engine, keys):
    values = triangles()
    path = file_of(tmp_path, values)
    settings = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
    done = program(tmp_path, "raster", str(path), "--engine", engine, "--out", "r", *settings)
    assert done.returncode == 0, done.stderr
    report = json.loads((tmp_path / "r/report.json").read_text())
    machine = edgewalk.Machine(keys={**SCREEN, **keys})
    for drawn in (
        edgewalk.raster(values, machine, engine=engine, header=HEADER),
        edgewalk.raster(path, edgewalk.Machine(keys=keys), engine=engine),
    ):
        names = ["coverage", "writes", "id", "z", "rgb"] + ["lit"] * (engine in ("golden", "scanline"))
        for name in names:
            expected, found = np.load(tmp_path / f"r/{name}.npy"), getattr(drawn, name)
            assert found.dtype == expected.dtype and found.shape == expected.shape, name
            assert np.array_equal(found, expected), name
        assert (drawn.coverage > 0).sum() > 1000
        if engine in ("golden", "scanline"):
            assert drawn.z_lsb is None and drawn.rgb_lsb is None and drawn.cycles is None
            continue
        depth, color = 2**machine.depth_bits - 1, 2**machine.color_bits - 1
        assert drawn.z_lsb.dtype == np.uint64 and np.array_equal(drawn.z_lsb / depth, drawn.z)
        assert drawn.rgb_lsb.shape == (48, 64, 3) and np.array_equal(drawn.rgb_lsb / color, drawn.rgb)
        cycles = drawn.cycles
        assert cycles["total"] == sum(count for name, count in cycles.items() if name != "total")
        assert f'"total": {cycles["total"]}' in json.dumps(report)


def test_machines_are_those_of_the_program(tmp_path):
    keys = {"memory.hazard": "drain", "interpolator.adders": 2}
    for name, _ in edgewalk.presets():
        settings = [w for key, value in keys.items() for w in ("--set", f"{key}={value}")]
        done = program(tmp_path, "config", "print", "--machine", name, *settings)
        machine = edgewalk.Machine(name, keys)
        assert machine.to_toml() in done.stdout, done.stderr
        assert edgewalk.Machine.from_toml(machine.to_toml()).hash == machine.hash
        assert edgewalk.Machine(name).with_keys(keys).hash == machine.hash
    assert len(edgewalk.presets()) >= 7


def test_judge_finds_what_the_program_finds(tmp_path):
    values, machine = triangles(), edgewalk.Machine(keys=SCREEN)
    drawn = edgewalk.raster(values, machine)
    given = {"z": drawn.z, "rgb": drawn.rgb, "coverage": drawn.coverage, "id": drawn.id}
    judged = edgewalk.judge(values, machine, **given, against="machine", header="")
    assert judged.passed and judged.wrong == 0 and judged.covered == (drawn.coverage > 0).sum()
    assert (judged.map == 255).all()
    assert edgewalk.judge(values, machine, z=drawn.z_lsb, rgb=drawn.rgb_lsb).passed
    corner = np.zeros((1, 3, 7))
    corner[0, :, :2] = [[10.5, 10.5], [40.5, 10.5], [10.5, 40.5]]  # 59 centres on left and top edge, 29 on the other
    coverage = edgewalk.raster(corner, machine).coverage
    assert edgewalk.judge(corner, machine, coverage=coverage).passed
    flipped = edgewalk.judge(corner, machine, coverage=coverage, rule="bottom-right")
    counts = [flipped.causes[f"covered {word} often"] for word in ("more", "less")]
    assert not flipped.passed and counts == [59, 29] and flipped.wrong == 88
    assert "(10, 39) covered more often: 1 for 0" in flipped.lines_of("covered more often")
    z = drawn.z.copy()
    covered = np.argwhere(drawn.coverage == 1)
    row, column = covered[len(covered) // 2]
    z[row, column] += 0.25
    judged = edgewalk.judge(values, machine, z=z, rgb=drawn.rgb)
    assert not judged.passed and judged.wrong == 1
    assert np.argwhere(judged.map != 255).tolist() == [[row, column]]
    path = file_of(tmp_path, values, "")
    (tmp_path / "out").mkdir()
    np.save(tmp_path / "out/z.npy", z)
    np.save(tmp_path / "out/rgb.npy", drawn.rgb)
    done = program(tmp_path, "judge", str(path), "out")
    assert done.returncode == 1 and str(judged) in done.stdout, done.stdout


def test_judge_takes_polygons_whole():
    path, polygons = ROOT / "docs/scenes/depth.tri", 0
    for engine, against in [("golden", "golden"), ("fast", "golden"), ("fast", "machine")]:
        drawn = edgewalk.raster(path, engine=engine)
        given = {"z": drawn.z, "rgb": drawn.rgb, "coverage": drawn.coverage, "id": drawn.id}
        judged = edgewalk.judge(path, **given, against=against)
        assert judged.passed, str(judged)
        polygons += (drawn.id == 2).sum()
    assert polygons > 0


NAN = triangles(1)
NAN[0, 0, 0] = np.nan
DEEP = np.zeros((3, 7))
DEEP[1, 2] = 5
LINE = "S 1 1 0.5 1 0 0 0  9 9 0.5 1 0 0 0"
WRONG = [
    (lambda: edgewalk.Machine("smal"), "unknown preset smal; permitted: .*nearest: small"),
    (lambda: edgewalk.Machine(keys={"screen.widht": 3}), "screen.widht = 3: .*screen.width"),
    (lambda: edgewalk.Machine(keys={"screen.width": 0}), "screen.width = 0: "),
    (lambda: edgewalk.Machine.from_toml("[screen"), "line 1"),
    (lambda: edgewalk.raster(triangles(), engine="gold"), "engine: \"gold\"; permitted: golden, scanline"),
    (lambda: edgewalk.raster(np.zeros((2, 3, 6))), r"its shape is \[2, 3, 6\]; permitted: "),
    (lambda: edgewalk.raster(np.zeros(())), "triangles: its shape is "),
    (lambda: edgewalk.raster(np.array("text")), "triangles: its type is "),
    (lambda: edgewalk.raster(NAN), r"^triangles\[0\]: vertex 0, x: `NaN`: permitted: "),
    (lambda: edgewalk.raster(triangles(3) + DEEP, header="depth less\ndepth_write 1\n"),
     r"^triangles\[0\]: vertex 1, z: "),
    (lambda: edgewalk.raster(triangles(1), header=LINE),
     r"^lines: .*; give a machine.with_keys\(\{\"polygon.lines\": \"yes\"\}\), or draw with engine=\"golden\"$"),
    (lambda: edgewalk.raster("none.tri"), "none.tri"),
    (lambda: edgewalk.raster(triangles(), header="depth les"), "^header:1: depth: "),
    (lambda: edgewalk.judge(triangles()), "no array; permitted: "),
    (lambda: edgewalk.judge(triangles(), lit=np.zeros((480, 640), int), against="machine"), "no array can be compared: "),
    (lambda: edgewalk.judge(triangles(), z=np.zeros((3, 3))), r"z: its shape is \[3, 3\]; permitted: \[480, 640\]"),
    (lambda: edgewalk.judge(triangles(), z=np.full((480, 640), 2**24, np.uint32)), "z: 16777216 is more than "),
    (lambda: edgewalk.judge(triangles(), z=np.zeros((480, 640), int)), "z: its type is int64; permitted: "),
    (lambda: edgewalk.judge(triangles(), lit=np.full((480, 640), 256)), r"lit: 256 in pixel \(0, 0\); permitted: 0 for "),
    (lambda: edgewalk.judge(triangles(), id=np.full((480, 640), 2**32 - 1, np.uint32)), "id: 4294967295 in .*permitted: -1 for "),
    (lambda: edgewalk.judge(triangles(), z=np.full((480, 640), np.nan)), r"z: NaN in pixel \(0, 0\); permitted: floats in 0 to 1"),
    (lambda: edgewalk.judge(triangles(), id=np.zeros((480, 640))), "id: its type is float64; permitted: "),
    (lambda: edgewalk.judge(triangles(), z=np.zeros((480, 640)), rule="left"), "rule: \"left\"; permitted: "),
    (lambda: edgewalk.judge(triangles(), z=np.zeros((480, 640)), depth_lsb=-1.0),
     "^depth_lsb: -1; permitted: a number of 0 or more, LSB$"),
    (lambda: edgewalk.judge(triangles(), z=np.zeros((480, 640)), against="me"), "against: \"me\"; permitted: "),
]


@pytest.mark.skipif(JIT, reason="the module has the engine jit")
def test_engine_that_is_not_built_in_says_so():
    with pytest.raises(edgewalk.Error, match="without the feature jit; permitted: golden, .*features jit"):
        edgewalk.raster(triangles(1), engine="jit")


@pytest.mark.parametrize("case", range(len(WRONG)))
def test_bad_input_raises_the_modules_error(case):
    call, said = WRONG[case]
    with pytest.raises(edgewalk.Error) as raised:
        call()
    assert re.search(said, str(raised.value)), raised.value
    assert isinstance(raised.value, ValueError)


def test_advice_to_draw_with_golden_is_in_pythons_words(tmp_path):
    path = tmp_path / "lights.tri"
    path.write_text(
        "size 8 8\nmode phong\nview 0 0 1\nsun 0 0 1 0.5\nsun 0 1 1 0.2\nsun 1 0 1 0.2\nmaterial 0.1 0.5 0 1\n"
        "T 1 1 0.5 1 1 1 0  7 1 0.5 1 1 1 0  1 5 0.5 1 1 1 0\nN 0 0 1 0 0 1 0 0 1\n"
    )
    machine = edgewalk.Machine(keys={"shade.kind": "phong", "shade.lights": 2})
    with pytest.raises(edgewalk.Error, match='^3 lights: .*; leave lights out, or draw with engine="golden"$'):
        edgewalk.raster(path, machine, engine="fast")
    assert edgewalk.raster(path, machine, engine="golden").coverage.any()


def test_stubs_name_what_the_module_has():
    stub = (ROOT / "crates/python/edgewalk.pyi").read_text()
    for name in ["Machine", "Picture", "Judgement", "Vectors", "Live", "Sweep"]:
        body = stub.split(f"class {name}:")[1].split("\nclass ")[0].split("\ndef ")[0]
        stubs = set(re.findall(r"    def (\w+)\(", body)) - {"__init__"}
        found = {member for member in vars(getattr(edgewalk, name)) if not member.startswith("__")}
        assert stubs == found, name
    functions = set(re.findall(r"^def (\w+)\(", stub, re.M))
    module = {name for name, value in vars(edgewalk).items() if callable(value) and name[0].islower()}
    assert functions == module >= {"presets", "raster", "judge", "vectors", "sweep"}
    installed = Path(edgewalk.__file__).parent
    assert (installed / "py.typed").exists() and (installed / "__init__.pyi").exists()


@pytest.mark.parametrize("page", ["own_rtl.md", "tutorial/your_rtl.md"])
def test_the_example_of_the_page_runs(tmp_path, monkeypatch, capsys, page):
    page = (ROOT / "docs" / page).read_text()
    example = page.split("From Python\n")[1].split("```python\n")[1].split("```")[0]
    assert len(example.splitlines()) <= 15
    monkeypatch.chdir(tmp_path)
    exec(example, {})
    printed = capsys.readouterr().out.split("\n")
    said = re.findall(r"# prints (.*)", example)
    assert said and all(line in printed for line in said), printed


def test_judge_reads_colours_as_the_machine_stores_them():
    machine = edgewalk.Machine("small", {**SCREEN, "formats.color_bits": 8, "dither.bits": 5})
    drawn = edgewalk.raster(triangles(), machine)
    assert machine.color_bits == 5 and drawn.rgb_lsb.max() in (30, 31)
    for rgb in [drawn.rgb, drawn.rgb_lsb]:
        for against in ["machine", "golden"]:
            judged = edgewalk.judge(triangles(), machine, rgb=rgb, against=against)
            assert judged.wrong == 0, (against, str(judged))


def test_header_beside_a_file_is_refused(tmp_path):
    path, machine = file_of(tmp_path, triangles()), edgewalk.Machine("small")
    for call in [lambda **of: edgewalk.raster(path, machine, **of), lambda **of: edgewalk.vectors(machine, triangles=path, **of)]:
        call()
        with pytest.raises(edgewalk.Error, match="header: given with the file .*own.tri; permitted: with an array"):
            call(header="depth off")


def test_any_mapping_is_taken_and_bools_are_yes_or_no():
    words = {"polygon.edges": 8, "polygon.lines": "yes"}
    machine = edgewalk.Machine("default", words)
    assert machine.hash == edgewalk.Machine("default", MappingProxyType({**words, "polygon.lines": True})).hash
    assert machine.hash == edgewalk.Machine("default").with_keys(MappingProxyType(words)).hash
    assert machine.hash != edgewalk.Machine("default", {**words, "polygon.lines": False}).hash
    swept = edgewalk.sweep("sphere", MappingProxyType({"polygon.lines": [True, False]}), edgewalk.Machine("polygon", SCREEN))
    assert len(swept.rows) == 2
