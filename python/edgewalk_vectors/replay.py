"""The bench of a directory as a test of cocotb, 1.9 or 2."""

from .bench import Bench
from .directory import Directory
from .pins import Pins, Wiring


def replay(directory, ports=None, compare=None):
    """The test that replays a directory of vectors: `test = replay("out/v/hazards_pixel")`.

    `ports` says which ports of the design stand for those of the unit, where they have other names: see `Wiring`. With
    `compare="order"` values and order of the tokens count, with `"cycle"` their cycles and the status ports too; without it
    what the directory says.
    """
    import cocotb
    from cocotb.triggers import Timer

    vectors = Directory(directory)
    wiring = Wiring.of_manifest(vectors.manifest, ports)

    async def run(dut):
        first, bench = (Bench(vectors, wiring.absent, compare, shy) for shy in (True, False))
        inputs = first.drive()
        pins = Pins(dut, wiring, inputs, first.outputs)
        pins.clock.value = 0
        pins.tie_off()

        async def edge():
            """The rising edge; inputs change behind it."""
            pins.clock.value = 1
            await Timer(5, "ns")
            pins.clock.value = 0

        async def play(bench, ends):
            """A reset, and the cycles of a bench until its end, or until `ends` says so."""
            pins.set_reset(True)
            pins.drive(dict.fromkeys(inputs, 0))
            for _ in range(wiring.reset_cycles):
                await Timer(5, "ns")
                await edge()
            pins.set_reset(False)
            going = True
            while going and not ends():
                pins.drive(bench.drive())
                await Timer(5, "ns")
                going = bench.sample(pins.sample())
                await edge()

        # The second reset comes in the midst of the first run, in which no ready comes before its valid: where a token waits.
        await play(first, first.may_end)
        bench.stuck, bench.early = first.silent(), first.found_early()
        await play(bench, lambda: False)
        checked = bench.finish()
        dut._log.info("checked %d / %d", checked, bench.expected)

    run.__name__ = run.__qualname__ = vectors.path.name.replace("-", "_")
    return cocotb.test()(run)
