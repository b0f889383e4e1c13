"""Scenario `field_ride`: the thesis' two hours in the park, logged over the serial line (5.5).

Torque and speed come as a telemetry stream like a laptop's; rows are counted by the times they
carry, so that a lost one shows, and the rotor link's words by sequence and check (I-10, I-30).
"""

from typing import Any

from firmware_protocol._generated import (
    CHANNELS,
    HelloRequest,
    StrRenewRequest,
    StrSubscribeRequest,
)
from firmware_protocol.codec import Stream, decode
from firmware_protocol.framing import FrameDecoder
from sim_device.configure import Exchange
from sim_device.firmware.python.unit import finite_or_none
from sim_device.lockstep import LockstepUnit
from sim_device.scenario_file import ScenarioFile

CONTROL_HZ = 100
LOGGED = ("rider_torque_nm", "speed_kmh")
STREAM_ID = 1
BATCH = 10
LEASE_S = 250
PIECE_S = 5
RENEW_EVERY_S = 200
S_PER_H = 3600
US_PER_S = 1_000_000


def field_ride(scenario: ScenarioFile, settings: dict[str, Any]) -> dict[str, Any]:
    """Rows expected, logged and lost, words of the rotor link, and what the ride came to."""
    seconds = round(settings["hours"] * S_PER_H)
    unit = LockstepUnit(settings["seed"], name=scenario.name, scenario=scenario)
    link = {
        "bit_error_rate": settings["bit_error_rate"],
        "burst_share": settings["burst_share"],
    }
    unit.simulation_set({"faults": link})
    rows = _log(unit, seconds, settings["log_hz"])
    seen = unit.observe()
    expected = seconds * settings["log_hz"]
    noticed = int(seen["words_bad"])
    return {
        "rows_expected": expected,
        "rows_logged": rows,
        "rows_lost": expected - rows,
        "words": int(seen["link_exchanges"]),
        "words_good": int(seen["words_good"]),
        "words_bad": noticed,
        "words_lost": int(seen["words_lost"]),
        "words_damaged": int(seen["words_damaged"]),
        "distance_m": seen["distance_m"],
        "climb_m": seen["height_m"],
        "energy_balance_error_pct": finite_or_none(seen["energy_balance_error_pct"]),
        "energy_consistent": bool(seen["energy_consistent"]),
    }


def _log(unit: LockstepUnit, seconds: int, log_hz: int) -> int:
    """Rides and logs; how many of the rows that were due came, each counted once."""
    period_us = US_PER_S // log_hz
    line = _subscribe(unit, log_hz)
    decoder = FrameDecoder()
    came = bytearray(seconds * log_hz)
    last_us, since_first_us = None, 0
    # A second more brings the last rows out of the unit's frame.
    for second in range(0, seconds + PIECE_S, PIECE_S):
        if second % RENEW_EVERY_S == 0:
            line.tell(StrRenewRequest(stream_id=STREAM_ID, lease_s=LEASE_S))
        unit.advance(PIECE_S)
        for frame in decoder.feed(unit.receive()):
            rows = decode(frame)
            if not isinstance(rows, Stream) or rows.stream_id != STREAM_ID:
                continue
            # The frame's clock has 32 bits and goes round in 72 minutes.
            since_first_us += 0 if last_us is None else (rows.t0_us - last_us) % 2**32
            last_us = rows.t0_us
            at = (since_first_us + period_us // 2) // period_us
            for row in range(at, min(at + len(rows.values), len(came))):
                came[row] = 1
    return sum(came)


def _subscribe(unit: LockstepUnit, log_hz: int) -> Exchange:
    exchange = Exchange(unit.unit)
    exchange.ask(
        HelloRequest(major_min=1, major_max=1, host_flags=0, host_mtu=544, host_nonce=bytes(8))
    )
    ids = {channel.name: channel.id for channel in CHANNELS}
    exchange.ask(
        StrSubscribeRequest(
            stream_id=STREAM_ID,
            divider=CONTROL_HZ // log_hz,
            batch=BATCH,
            encoding=0,
            lease_s=LEASE_S,
            channel_ids=bytes(ids[name] for name in LOGGED),
        )
    )
    return exchange
