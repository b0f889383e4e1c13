"""A ride log over the line, in virtual time: how much of the line it gets."""

from backend.device.ebl.operations.ride_logs import list_logs, receive_log
from backend.device.ebl.session.log_receiver import LogReceiver
from tests.fakes.bench_logs import unit_with_log
from tests.fakes.serial_wire import SerialWire
from tools.bench.figures import Figure

RATES = (115200, 1_000_000)
TURN_AROUNDS_S = (0.002, 0.018)
TARGETS = {0.0: 0.92, 0.01: 0.90, 0.05: 0.80}
SEEDS = range(5)
RIDE_S = 420.0
# A page of 512 bytes with its header, place, check value, stuffing and delimiters.
LIMIT = 512 / 531


def run() -> list[Figure]:
    """Share of the line for every rate, turn-around and loss; the mean over the seeds."""
    figures = []
    for rate in RATES:
        for turn_around_s in TURN_AROUNDS_S:
            for loss, target in TARGETS.items():
                shares = [share_of_line(rate, turn_around_s, loss, seed) for seed in SEEDS]
                mean = sum(shares) / len(shares)
                figures.append(
                    Figure(
                        f"ride log at {rate} bit/s, {turn_around_s * 1000:.0f} ms turn-around, "
                        f"{loss:.0%} of frames lost",
                        f"{mean:.1%} of the line (worst {min(shares):.1%})",
                        f">= {target:.0%}",
                        mean >= target,
                        f"{LIMIT * (1 - loss):.1%} is the limit",
                    )
                )
    return figures


def share_of_line(rate: int, turn_around_s: float, loss: float, seed: int) -> float:
    """Bytes of a seven-minute ride's log over what the line carries in the same time."""
    unit = unit_with_log(4096, 1 << 20)
    unit.inputs(speed_kmh=18.0)
    unit.advance_unread(RIDE_S)
    unit.inputs(speed_kmh=0.0)
    unit.advance_unread(21.0)
    unit.take_wire()
    wire = SerialWire(unit, rate, turn_around_s, seed=seed).connect()
    log = wire.ask(list_logs()).logs[0]
    receiver = LogReceiver(1, wire.now_s)
    wire.session.receive_log(receiver)
    began_s = wire.now_s
    wire.ask(receive_log(log, receiver, 0))
    wire.loss = loss
    wire.run_until(lambda: receiver.done)
    return log.length / (wire.now_s - began_s) / wire.bytes_per_s
