"""A directory of test vectors, read and checked."""

import hashlib
import json
from pathlib import Path

FORMAT, VERSION = "edgewalk-vectors", 5


class VectorsError(Exception):
    """A directory that cannot be replayed."""


class Directory:
    """The manifest of a directory and its files of numbers.

    `manifest` is the parsed `manifest.json`.
    """

    def __init__(self, path):
        self.path = Path(path).resolve()
        try:
            self.manifest = json.loads((self.path / "manifest.json").read_text())
        except (OSError, ValueError) as error:
            raise VectorsError(f"{self.path}: manifest.json: {error}") from error
        found = (self.manifest.get("format"), self.manifest.get("format_version"))
        if found != (FORMAT, VERSION):
            raise VectorsError(f"{self.path}: format {found[0]} {found[1]}; permitted: {FORMAT} {VERSION}")
        inside = list((self.manifest.get("dut") or {}).get("memories", {}))
        if inside:
            raise VectorsError(
                f"{self.path}: the memory {inside[0]} is inside the design; permitted: memories that the bench keeps; "
                "make icarus fills it"
            )
        for entry in self.manifest["files"]:
            self._check(entry)

    def _check(self, entry):
        try:
            data = (self.path / entry["name"]).read_bytes()
        except OSError as error:
            raise VectorsError(f"{self.path}: {error}") from error
        if hashlib.sha256(data).hexdigest() != entry["sha256"]:
            raise VectorsError(f"{self.path}: {entry['name']} is not the file that the manifest describes")

    def numbers(self, name, base=16):
        """The numbers of a file, one a line."""
        return [int(line, base) for line in (self.path / name).read_text().split()]

    def steps(self, name):
        """The numbers of a file in steps: each line is added to the sum of those before, modulo 2^32."""
        total, numbers = 0, []
        for step in self.numbers(name):
            total = (total + step) & 0xFFFFFFFF
            numbers.append(total)
        return numbers

    @property
    def module(self):
        """The design's top module."""
        dut = self.manifest.get("dut")
        return dut["top"] if dut else self.manifest["module"]

    @property
    def sources(self):
        """The design's files."""
        dut = self.manifest.get("dut")
        if dut:
            return [Path(name) for name in dut["files"]]
        names = [entry["name"] for entry in self.manifest["files"]]
        return [self.path / name for name in names if name.startswith("hdl/") and name.endswith(".v")]

    def case_of(self, triangle):
        """The name of the case that a triangle belongs to."""
        cases = self.manifest["suite"]["cases"]
        return next((c["name"] for c in cases if c["first"] <= triangle < c["first"] + c["count"]), "?")
