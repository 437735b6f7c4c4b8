"""Builds the design of a directory with a simulator and replays the directory into it."""

import importlib
import os
import shutil
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from .directory import Directory, VectorsError

# The variable by which the test in the simulator learns its directory.
VARIABLE = "EDGEWALK_VECTORS"


def runner(simulator):
    """cocotb's runner, which has another name in each of its versions."""
    for module in ["cocotb_tools.runner", "cocotb.runner"]:
        try:
            return importlib.import_module(module).get_runner(simulator)
        except ImportError:
            continue
    raise VectorsError("cocotb is not installed; try: pip install cocotb")


def run(directory, simulator="icarus", results=None, module="edgewalk_vectors.in_simulator"):
    """Replays a directory with `icarus` or `verilator`; true if everything expected came, and nothing else.

    `results` is a file for the results in JUnit's form. `module` is another module of tests for the design of the directory:
    then all of them must pass.
    """
    vectors = Directory(directory)
    own = vectors.manifest.get("dut") or {"include": [], "parameters": {}, "files": []}
    newer = any(str(name).endswith(".sv") for name in own["files"])
    options = {"icarus": ["-g2012" if newer else "-g2001"], "verilator": ["-Wno-fatal", "--timescale", "1ns/1ps"]}
    with tempfile.TemporaryDirectory() as work:
        try:
            build = runner(simulator)
            build.build(
                sources=vectors.sources,
                includes=own["include"],
                parameters=own["parameters"],
                hdl_toplevel=vectors.module,
                build_args=options.get(simulator, []),
                build_dir=work,
                timescale=("1ns", "1ps"),
                always=True,
            )
        except (RuntimeError, SystemExit) as error:  # cocotb 2, cocotb 1.9
            raise VectorsError(f"{simulator} does not build the design, or is not installed; see above: {error}") from error
        found = build.test(
            hdl_toplevel=vectors.module,
            test_module=module,
            build_dir=work,
            extra_env={VARIABLE: os.fspath(vectors.path)},
            results_xml=os.fspath(Path(work) / "results.xml"),
        )
        if results:
            shutil.copy(found, results)
        cases = list(ElementTree.parse(found).iter("testcase"))
        failed = [case for case in cases if case.find("failure") is not None or case.find("error") is not None]
        return bool(cases) and not failed
