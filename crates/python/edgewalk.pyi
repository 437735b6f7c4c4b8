"""A cycle-level, bit-accurate model of scan-line triangle hardware.

Arrays have row 0 on top. H and W are the lines and columns of the screen. `triangles` is an array (N, 3, 7) with
x, y in pixels and z, r, g, b, kt in 0 to 1 of each vertex, drawn on the machine's screen; or the path of a triangle
file, whose size replaces the screen's. `header` is further lines before the triangles of an array, as in a triangle
file: "depth lequal\\nclear 0 0 0.2".
"""

from os import PathLike
from typing import Any, Dict, Iterable, List, Literal, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Triangles = Union[ArrayLike, str, "PathLike[str]"]
Value = Union[int, str, bool]

class Error(ValueError):
    """Bad input, with the message that the program prints: what was found, what is permitted, the nearest name."""

def presets() -> List[Tuple[str, str]]:
    """Names and descriptions of the presets."""

class Machine:
    """A checked machine that never changes: a preset, with keys as `edgewalk config print` lists them."""

    def __init__(self, preset: str = "default", keys: Optional[Mapping[str, Value]] = None) -> None: ...
    @staticmethod
    def from_toml(text: str, keys: Optional[Mapping[str, Value]] = None) -> Machine:
        """The machine of a machine file's text."""
    def with_keys(self, keys: Mapping[str, Value]) -> Machine:
        """Another machine, with these keys changed."""
    def to_toml(self) -> str:
        """The machine as a file, every key with its meaning."""
    @property
    def hash(self) -> str:
        """Twelve hex digits that stand for this machine."""
    @property
    def width(self) -> int:
        """Columns of the screen."""
    @property
    def height(self) -> int:
        """Lines of the screen."""
    @property
    def depth_bits(self) -> int:
        """Bits of a stored depth."""
    @property
    def color_bits(self) -> int:
        """Bits of a stored colour."""

class Picture:
    """What an engine drew."""

    @property
    def coverage(self) -> NDArray[np.uint32]:
        """(H, W): triangles over the pixel, depth test off."""
    @property
    def writes(self) -> NDArray[np.uint32]:
        """(H, W): writes to the pixel."""
    @property
    def id(self) -> NDArray[np.int32]:
        """(H, W): place of the triangle last written, -1 none."""
    @property
    def z(self) -> NDArray[np.float64]:
        """(H, W): depth in 0 to 1."""
    @property
    def rgb(self) -> NDArray[np.float64]:
        """(H, W, 3): colour in 0 to 1."""
    @property
    def z_lsb(self) -> Optional[NDArray[np.uint64]]:
        """(H, W): depth as the machine stores it, LSB; None of golden, which does not quantise."""
    @property
    def rgb_lsb(self) -> Optional[NDArray[np.uint64]]:
        """(H, W, 3): colour as the machine stores it, LSB; None of golden."""
    @property
    def lit(self) -> Optional[NDArray[np.uint8]]:
        """(H, W): 0 nothing written, 1 in shadow, 2 lit; None of a machine without SHADOW."""
    @property
    def extra(self) -> List[NDArray[Any]]:
        """Channels of the user's own, (H, W) each, LSB: int64, of golden float64."""
    @property
    def cycles(self) -> Optional[Dict[str, int]]:
        """Cycles by cause, and their "total"; None of golden."""

def raster(
    triangles: Triangles,
    machine: Optional[Machine] = None,
    *,
    engine: Literal["golden", "scanline", "fast", "model", "rtl", "jit"] = "fast",
    header: str = "",
) -> Picture:
    """Draws triangles with an engine, as `edgewalk raster` does.

    `jit` is the netlist as native code. It needs a module that was built with the feature jit.
    """

class Judgement:
    """What a picture came to, pixel by pixel. `str()` of it is what the program prints."""

    @property
    def passed(self) -> bool:
        """Whether pixels were covered and none is wrong."""
    @property
    def wrong(self) -> int:
        """Pixels that are wrong."""
    @property
    def covered(self) -> int:
        """Pixels that the reference covers."""
    @property
    def causes(self) -> Dict[str, int]:
        """Pixels by cause."""
    @property
    def map(self) -> NDArray[np.uint8]:
        """(H, W): place of the pixel's cause in `causes`, 255 where it agrees."""
    def lines_of(self, cause: str) -> str:
        """The first pixels of a cause, a line each."""

def judge(
    triangles: Triangles,
    machine: Optional[Machine] = None,
    *,
    z: Optional[ArrayLike] = None,
    rgb: Optional[ArrayLike] = None,
    coverage: Optional[ArrayLike] = None,
    id: Optional[ArrayLike] = None,
    lit: Optional[ArrayLike] = None,
    header: str = "",
    against: Literal["golden", "machine"] = "golden",
    rule: Optional[Literal["top-left", "top-right", "bottom-left", "bottom-right", "textbook"]] = None,
    depth_lsb: Optional[float] = None,
    color_lsb: Optional[float] = None,
) -> Judgement:
    """Judges arrays of another rasterizer beside golden's picture or the machine's, as `edgewalk judge` does.

    Depths and colours are floats in 0 to 1, or unsigned integers in LSB. Tolerances are in LSB; without them the
    proved bound of the machine holds.
    """

Stalls = Literal["none", "mixed", "late"]

def suites(machine: Optional[Machine] = None) -> List[Tuple[str, str]]:
    """Names and descriptions of the suites that say something about the machine."""

class Vectors:
    """What moves at the ports of a unit of the model over a suite: stimuli and expected results."""

    @property
    def name(self) -> str:
        """Suite and unit: the name of the directory that `edgewalk vectors` writes."""
    @property
    def links(self) -> List[str]:
        """Names of the links: those into the unit, then those out of it."""
    @property
    def expected(self) -> int:
        """Tokens and changes of the status ports that a bench compares."""
    @property
    def total_cycles(self) -> int:
        """Cycles until nothing more happens."""
    @property
    def status(self) -> NDArray[Any]:
        """(N,), structured: changes of the status ports. Fields: `cycle` (uint64), then the ports."""
    @property
    def manifest(self) -> Dict[str, Any]:
        """`manifest.json` of the directory: channels, formats, stalls, memories, limits, coverage."""
    def tokens(self, link: str) -> NDArray[Any]:
        """(N,), structured: the tokens of a link in order, a field for each port, in the port's LSB.

        int64 where a port is signed, uint64 else; Python's integers where it has more than 64 bits.
        """
    def cycles(self, link: str) -> NDArray[np.uint64]:
        """(N,): the cycle in which each token of a link moves, 0 the first without reset."""
    def triangles(self, link: str) -> Optional[NDArray[np.uint32]]:
        """(N,): number of the triangle that each token of a link belongs to; None where a link does not know."""
    def write(self, directory: Union[str, "PathLike[str]"], *, tables: bool = False) -> None:
        """Writes the directory that the program writes, with a bench for Icarus and Verilator.

        The directory is new, empty, or one of vectors, which is replaced. `tables` adds tables for people, *.csv.
        """

def vectors(
    machine: Optional[Machine] = None,
    *,
    unit: str = "machine",
    suite: Optional[str] = None,
    triangles: Optional[Triangles] = None,
    header: str = "",
    only: List[str] = ...,
    stalls: Optional[Stalls] = None,
    seed: int = 1,
    count: int = 100,
) -> Vectors:
    """Runs a unit of the model over a suite, as `edgewalk vectors` does; `suite` is "hazards" if left out.

    With `triangles` these are the suite. `only` names cases of it. `count` is the number of triangles of
    `random`, 1 to 10000; `seed` is 0 to 2**64 - 1.
    """

class Live:
    """A unit of the model beside a running simulation: it is fed token by token, and gives what a design ought to give.

    Values and order are those of any design of the unit, whatever its timing. `constants` are inputs that hold one
    value, as `depth_func`; those left out are the ones of a frame without blending whose nearest fragment wins.
    `memories` has the first words of the memories behind the unit, `clear` all their other words; without it every bit
    is 1. One thread at a time may use it.
    """

    def __init__(
        self,
        unit: str,
        machine: Optional[Machine] = None,
        *,
        constants: Optional[Mapping[str, int]] = None,
        memories: Optional[Mapping[str, ArrayLike]] = None,
        clear: Optional[Mapping[str, int]] = None,
    ) -> None: ...
    @property
    def takes(self) -> str:
        """Name of the link whose tokens are given."""
    @property
    def gives(self) -> List[str]:
        """Names of the links whose tokens come."""
    @property
    def ports(self) -> Dict[str, List[Tuple[str, int, bool]]]:
        """For each link its ports: name, bits, whether it is two's complement."""
    def give(self, token: Mapping[str, int]) -> None:
        """Gives the unit a token: a value for each port of `takes`, as its bits or with its sign.

        A token that breaks the unit's rules, as a span of no columns, may keep the unit busy for ever: Ctrl-C ends `next`
        and `rest`.
        """
    def next(self, link: str) -> Optional[Dict[str, int]]:
        """The next token of a link of `gives`, with its sign; None if what was given so far makes no more."""
    def rest(self) -> Dict[str, int]:
        """For each link of `gives`: the number of tokens left over."""

class Sweep:
    """Many machines on the same inputs, each with a row."""

    @property
    def rows(self) -> List[Dict[str, Any]]:
        """The rows in the order of the points, as the lines of the program's `runs.jsonl` (docs/json.md)."""
    @property
    def table(self) -> NDArray[Any]:
        """(N,), structured: the rows with the columns of the program's `runs.csv`.

        int64 where all of a column are integers; float64 where numbers are missing, nan in their place; else text.
        """
    @property
    def best(self) -> Dict[str, Optional[Dict[str, Any]]]:
        """For each objective the first row of the best machine; None where its value is not known of any."""

def sweep(
    inputs: Union[str, "PathLike[str]", List[Union[str, "PathLike[str]"]]],
    vary: Mapping[str, Union[str, Iterable[Value]]],
    machine: Optional[Machine] = None,
    *,
    shading: Optional[str] = None,
    stalls: List[str] = ...,
    judge: str = "worst",
    judge_inputs: str = "sum",
    weights: Optional[Mapping[str, float]] = None,
    sample: Optional[int] = None,
    seed: int = 1,
    bound: Optional[float] = None,
    objectives: List[str] = ...,
    store: Union[str, "PathLike[str]", None] = None,
) -> Sweep:
    """Draws inputs on many machines, as `edgewalk sweep` does without synthesis.

    `inputs` are names of scenes and paths of files. `vary` has the values of each varied key: an iterable, or a text as
    "6..14". `weights` has factors of inputs in the sum of cycles and bytes, at most 1e9. `bound` is in LSB. `store` is a file of rows: new ones are appended, and those in it are not drawn again.
    """
