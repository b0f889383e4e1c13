"""`spindle calibrate wheel`, `pulses`, `cadence` and `climb`: the bike's other numbers."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Any

from backend.cli.client import print_json
from backend.cli.device import read_json, server_of
from backend.errors import RequestRefused


def add_wheel_arguments(command: ArgumentParser) -> None:
    """What `wheel` takes."""
    words = "metres of each roll, two or more"
    command.add_argument("--rolled", type=float, nargs="+", metavar="M", help=words)
    command.add_argument("--turns", type=float, default=1.0, help="of the wheel in a roll (1)")
    words = "metres that tape and marks may be off (0.003)"
    command.add_argument("--tape-limit", type=float, default=0.003, metavar="M", help=words)
    command.add_argument("--ride", type=int, metavar="N", help="whose speed is of the wheel")
    words = "the ride that has the positions (the same)"
    command.add_argument("--track", type=int, metavar="N", help=words)
    words = "a part of the ride, seconds since its start"
    command.add_argument("--window", type=float, nargs=2, metavar=("FROM", "TO"), help=words)
    words = "metres that the ride's device counts with; as it is kept if absent"
    command.add_argument("--told", type=float, metavar="M", help=words)
    command.add_argument("--unit", help="to be told beside")


def add_pulses_arguments(command: ArgumentParser) -> None:
    """What `pulses` takes."""
    add_cadence_arguments(command)
    words = "of the wheel by hand, counted"
    command.add_argument("--turns", type=float, required=True, metavar="N", help=words)


def add_cadence_arguments(command: ArgumentParser) -> None:
    """What `cadence` takes."""
    command.add_argument("ride", type=int)
    words = "a part of the ride, seconds since its start"
    command.add_argument("--window", type=float, nargs=2, metavar=("FROM", "TO"), help=words)


def add_climb_arguments(command: ArgumentParser) -> None:
    """What `climb` takes."""
    command.add_argument("file", type=Path, help="JSON, as in docs/calibration.md")


def wheel(options: Namespace) -> int:
    """The circumference; 1 where the unit's differs by more than the uncertainty."""
    if (options.rolled is None) == (options.ride is None):
        raise RequestRefused("Say either what was rolled (--rolled) or which ride (--ride).")
    server = server_of(options)
    asked: dict[str, Any] = {}
    if options.unit is not None:
        asked["device_id"] = server.device_id(options.unit)
    if options.rolled is not None:
        asked |= {"distances_m": options.rolled, "turns": options.turns}
        asked["tape_limit_m"] = options.tape_limit
        answer = server.ask("POST", "/calibration/wheel/roll-out", json=asked)
    else:
        asked |= window_of(options) | {"track_ride_id": options.track}
        asked["told_circumference_m"] = options.told
        answer = server.ask("POST", "/calibration/wheel/track", json=asked)
    print_json(answer) if options.json else print_wheel(answer)
    return 0 if answer["beside"] is None or answer["beside"]["agrees"] else 1


def pulses(options: Namespace) -> int:
    """The speed sensor's pulses in a turn of its wheel; 1 where the unit counts with others."""
    asked = window_of(options) | {"turns": options.turns}
    answer = server_of(options).ask("POST", "/calibration/wheel/pulses", json=asked)
    found = answer["pulses"]
    if options.json:
        print_json(answer)
    else:
        said = "agrees" if found["agrees"] else "DIFFERS"
        none = " It is no whole number: turns miscounted, or a magnet that is missed."
        sure = "" if found["whole"] else none
        print(
            f"{found['counted']:.2f} pulses a turn ± {found['expanded']:.2f} (k = 2): the unit "
            f"made {answer['told_turns']:.2f} turns of {answer['turns']:g}. It counts with "
            f"{found['kept']} and {said}.{sure}"
        )
    return 0 if found["agrees"] else 1


def window_of(options: Namespace) -> dict[str, Any]:
    """A ride, and a part of it where one is said."""
    part = dict(zip(("from_s", "to_s"), options.window or (), strict=False))
    return {"ride_id": options.ride, **part}


def cadence(options: Namespace) -> int:
    """The cadence against the crank's turns; 1 where they differ."""
    asked = window_of(options)
    answer = server_of(options).ask("POST", "/calibration/cadence", json=asked)
    if options.json:
        print_json(answer)
    else:
        said = "agrees" if answer["agrees"] else "DIFFERS"
        print(
            f"{answer['told_rpm']:.2f} rpm told {said}: {answer['error_rpm']:+.2f} rpm from "
            f"{answer['turns']:.1f} turns in {answer['duration_s']:.1f} s, "
            f"± {answer['expanded_rpm']:.2f} rpm (k = 2)."
        )
    return 0 if answer["agrees"] else 1


def climb(options: Namespace) -> int:
    """The torque gain by a climb; 1 where it differs from the calibration."""
    asked = read_json(options.file)
    answer = server_of(options).ask("POST", "/calibration/climb", json=asked)
    print_json(answer) if options.json else print_climb(answer)
    return 0 if answer["balance"]["agrees"] else 1


def print_wheel(answer: dict[str, Any]) -> None:
    """The circumference, and the unit's beside it."""
    found, beside = answer["measured"], answer["beside"]
    way = f"{answer['distance_m']:.2f} m in {answer['turns']:.1f} turns"
    print(
        f"{found['circumference_m']:.4f} m ± {found['expanded_m']:.4f} m "
        f"(k = {found['coverage']:.2f}): {way}."
    )
    if answer["noise_m"] is not None:
        print(f"The positions are {answer['noise_m']:.1f} m off (k = 1).")
    if beside is None:
        return
    said = "agrees" if beside["agrees"] else "DIFFERS"
    print(
        f"The unit counts with {beside['kept_m']:.4f} m and {said}: measured "
        f"{beside['difference_pct']:+.2f} %."
    )
    if beside["in_band"] is not None:
        may = "may be written" if beside["in_band"] else "needs the maker's token"
        free = f"{beside['free_min_m']:.4f} to {beside['free_max_m']:.4f} m"
        print(f"The measured value {may}: free are {free}.")
    if beside["cut_off"] is not None:
        limit = beside["cut_off"]
        print(
            f"Assist that ends at {limit['limit_kmh']:g} km/h by the unit ends at "
            f"{limit['true_kmh']:.2f} ± {limit['expanded_kmh']:.2f} km/h."
        )


def print_climb(answer: dict[str, Any]) -> None:
    """What the climb says, and what leaves it open."""
    found, road = answer["balance"], answer["resistance"]
    print(f"{found['sentence'].capitalize()} (k = 2); En {found['en']:.2f}.")
    print(f"  {answer['rise_m']:.1f} m in {answer['duration_s']:.0f} s")
    typical = ", both typical ones: no coast-down" if road["source"] == "typical" else ""
    print(f"  rolling {road['rolling_n']:.2f} N, air {road['air_ns2_m2']:.3f} N s2/m2{typical}")
    print(f"  the legs gave {found['crank_energy_j']:.0f} J by the sensor; the climb took")
    for name, energy_j in found["needed"].items():
        print(f"    {name.removesuffix('_j'):12} {energy_j:.0f} J")
    print(f"  {calibration_text(answer['calibrated'])}; what leaves the ratio open (k = 1):")
    for name, part in sorted(found["contributions"].items(), key=lambda one: -one[1]):
        print(f"  {name:12} {100 * part:.2f} %")


def calibration_text(calibrated: dict[str, Any]) -> str:
    """How well the calibration knows the torque, and who says so."""
    share = f"± {100 * calibrated['expanded_share']:.2f} % of the torque (k = 2)"
    if calibrated["source"] == "given":
        return f"the calibration: {share}, as said"
    if calibrated["source"] == "unknown":
        return "the calibration: no certificate, so that only the climb's uncertainty counts"
    of = calibrated["certificate"]
    return f"the calibration: {share}, by certificate {of['sha256'][:16]} of {of['written_at']}"
