"""A configuration write with its read-back over the line, in virtual time, against what the line
itself takes for the same bytes and turn-arounds one after the other, with a step of the simulated
line for each way. Requests under way together make it a little less."""

from backend.device.ebl.operations.config_transaction import read_config, write_config
from firmware_protocol._generated import IMAGE_LENGTH
from tests.fakes.bench_unit import BenchUnit
from tests.fakes.serial_wire import STEP_S, SerialWire
from tools.bench.figures import Figure

RATES = (115200, 1_000_000)
TURN_AROUNDS_S = (0.002, 0.018)
# BEGIN, SET, VALIDATE, COMMIT, then CFG_INFO and the image: each waits for the one before.
ROUND_TRIPS = 6


def run() -> list[Figure]:
    """One figure for every rate and turn-around."""
    return [write(rate, turn_s) for rate in RATES for turn_s in TURN_AROUNDS_S]


def write(rate: int, turn_around_s: float) -> Figure:
    """Every number of the fuzzy table changed, committed, and the whole image read back."""
    unit = BenchUnit()
    wire = SerialWire(unit, rate, turn_around_s).connect()
    base = wire.ask(read_config())
    rules = base.parameters["fuzzy_rules"]
    changes = {"fuzzy_rules": [list(reversed(row)) for row in rules], "fuzzy_table_name": "bench"}
    wire.run(2.0)
    before = (wire.up.carried, wire.down.carried)
    began_s = wire.now_s
    wire.ask(write_config(base, changes))
    took_s = wire.now_s - began_s
    carried = wire.up.carried - before[0] + wire.down.carried - before[1]
    limit_s = carried / wire.bytes_per_s + ROUND_TRIPS * turn_around_s
    # The simulated line moves in steps of a millisecond: each way of a round trip waits for one.
    allowed_s = limit_s + 2 * ROUND_TRIPS * STEP_S
    return Figure(
        f"configuration write with read-back at {rate} bit/s, "
        f"{turn_around_s * 1000:.0f} ms turn-around",
        f"{took_s * 1000:.0f} ms",
        f"<= {allowed_s * 1000:.0f} ms",
        took_s <= allowed_s,
        f"{limit_s * 1000:.0f} ms if nothing overlapped: {carried} bytes for an image of "
        f"{IMAGE_LENGTH}, {ROUND_TRIPS} round trips",
    )
