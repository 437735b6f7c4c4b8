"""my_pixel.v beside the live model: random spans, and a consumer that often waits."""

import random

import cocotb
import edgewalk
from cocotb.clock import Clock
from cocotb.triggers import FallingEdge, RisingEdge
from edgewalk_vectors import Scoreboard

PORTS = {
    "clk": "aclk", "rst": "!aresetn",
    "span_*": "s_*", "inc_*": "step_*",
    "span_x": "s_column", "span_y": "s_line", "span_count": "s_pixels", "span_leftward": "s_left", "span_fresh": "s_first",
    "frag_valid": "m_valid", "frag_ready": "m_ready",
    "frag_addr": "m_data[18:0]", "frag_z": "m_data[42:19]", "frag_r": "m_data[50:43]",
    "frag_g": "m_data[58:51]", "frag_b": "m_data[66:59]", "frag_fence": "m_data[67]",
}


async def consume(dut):
    while True:
        await RisingEdge(dut.aclk)
        dut.m_ready.value = int(random.random() < 0.7)


@cocotb.test()
async def random_spans(dut):
    random.seed(1)
    board = Scoreboard(dut, "pixel", edgewalk.Machine(), ports=PORTS)
    dut.aresetn.value, dut.s_valid.value, dut.m_ready.value = 0, 0, 0
    cocotb.start_soon(Clock(dut.aclk, 10, "ns").start())
    for _ in range(3):
        await RisingEdge(dut.aclk)
    dut.aresetn.value = 1
    board.start()
    cocotb.start_soon(consume(dut))
    for number in range(60):
        dut.s_column.value = random.randrange(-20, 650) & 0x7FFF
        dut.s_line.value, dut.s_pixels.value = random.randrange(480), random.randrange(1, 40)
        dut.s_left.value, dut.s_fence.value = random.randrange(2), random.randrange(2)
        dut.s_first.value = int(number == 0 or random.random() < 0.5)
        for channel, bits in [("z", 38), ("r", 22), ("g", 22), ("b", 22)]:
            getattr(dut, f"s_{channel}").value = random.getrandbits(bits)
            getattr(dut, f"step_{channel}").value = random.getrandbits(bits)
        dut.s_valid.value = 1
        await taken(dut)
        dut.s_valid.value = 0
    for _ in range(200):
        await RisingEdge(dut.aclk)
    board.finish()


async def taken(dut):
    """Until the span that is offered has been taken: its ready is seen before the clock's edge."""
    while True:
        await FallingEdge(dut.aclk)
        ready = dut.s_ready.value == 1
        await RisingEdge(dut.aclk)
        if ready:
            return
