"""What can be proven of every ride with a configuration, against the law of its market.

The unit's C is a pipeline that ends at the market's step, so most of a proof is its structure: no
step after the law raises the torque, and what a step bounds stays bounded. The rest is bounds over
every cell of the tables, not over their points alone (corner_bounds), and what filters, ramps and
counters can remember, in control steps. Float32 rounding is within every bound. The constants below
are those of `sim_device/firmware/control`; tests compare them, and ride its C against the claims.

The steps see readings. Whether a reading is true or late, and whether the motor gives what it is
told, no proof about the law can say: NOT_COVERED names it.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from backend.core.canonical_json import sha256_of
from backend.core.energy import KMH_PER_MS
from backend.core.fuzzy_table import FuzzyTable
from backend.errors import InvalidRequest
from backend.law.corner_bounds import gain_most
from backend.law.limit_proof import Cell, Claim, LimitProof
from backend.law.market import market_words
from sim_device.firmware.python import law
from sim_device.firmware.python import market as unit

METHOD = 1
"""Counts up with every change of what is claimed or how it is proven."""

STEP_S = law.STEP_S
MEAN_S, HEADROOM = 60.0, 10.0
"""market_limit.c: continuous power is a mean of a minute; how far above it a moment may lie."""
RATING_S, RATING_SHARE = 1800.0, 1.05
"""A rating test takes half an hour (EN 60034-1, S2 30 min), and 5 % are accepted."""
HALF_SECONDS, HALF_SECOND_S, PUSH_NM = 3, 0.5, 1.0
"""cutoffs.c: how long a push counts, and the least that is one."""
HOLD_S, LOST_NM_PER_S = 0.05, 400.0
"""ramps.c: how long a reading is held, and how fast torque falls without one."""
BATTERY_V = 36.0
"""battery_power.c: with the current's limit the most power the motor may be given."""
ROUNDED = 1.0 + 2e-6
"""A few roundings of float32 in a row."""
SUMMED = 1.0 + 1e-3
"""The mean of power, rounded 180,000 times in half an hour."""
PART_SUMMED = 1.0 + 4e-4
"""half_turn.c: a part of a turn, summed from up to 6000 readings."""


@dataclass(frozen=True, slots=True)
class _Known:
    """A configuration as the claims need it. crank_nm, gain: the most; helping: the modes that are
    not off."""

    config: Mapping[str, Any]
    profile: unit.MarketProfile
    market: str
    cutoff_kmh: float
    helping: tuple[int, ...]
    cells: tuple[Cell, ...]
    gain: float | None
    crank_nm: float

    @property
    def ratio(self) -> float:
        """What the modes ask for at most, on the average of the torque."""
        averaged = PART_SUMMED if self.config["torque_filter"] == "half_turn" else ROUNDED
        return max(cell.ratio_most for cell in self.cells) * averaged


def prove_limits(config: Mapping[str, Any], firmware_version: str) -> LimitProof:
    """The limit proof of a configuration, without when it was made.

    config: the unit's parameters by registry name; those that are missing have the law's defaults.
    firmware_version: of the C in this process. Raises InvalidRequest for what the law refuses.
    """
    known = _known({**law.law_defaults(), **config})
    body = LimitProof(
        sha256="",
        config_sha256=hashlib.sha256(law.law_image(known.config)).hexdigest(),
        table_sha256=hashlib.sha256(law.law_image(known.config, tables_only=True)).hexdigest(),
        market=known.market,
        market_sha256=sha256_of(asdict(known.profile)),
        firmware_version=firmware_version,
        method=METHOD,
        claims=tuple(_claims(known)),
        cells=known.cells,
    ).body()
    claims = tuple(Claim(**claim) for claim in body["claims"])
    cells = tuple(Cell(**cell) for cell in body["cells"])
    return LimitProof(sha256_of(body), **{**body, "claims": claims, "cells": cells})


def _known(config: dict[str, Any]) -> _Known:
    try:
        law.native_config(config)
    except law.LawRefused as refused:
        raise InvalidRequest(f"There is nothing to prove: {refused}") from refused
    market = config["market"]
    cutoff_kmh = unit.cutoff_that_holds_kmh(
        market, config["assist_cutoff_kmh"], config["assist_cutoff_extra_kmh"]
    )
    helping = tuple(slot for slot, kind in enumerate(config["mode_laws"]) if kind != "off")
    share = max((config["mode_torque_pct"][slot] for slot in helping), default=0) / 100.0
    gains = {which: gain_most(FuzzyTable.from_parameters(config, which)) for which in _used(config)}
    return _Known(
        config=config,
        profile=unit.market_profile(market),
        market=market,
        cutoff_kmh=cutoff_kmh,
        helping=helping,
        cells=tuple(_cells(config, market, cutoff_kmh, helping, gains)),
        gain=max((max(rows) for rows in gains.values()), default=None),
        crank_nm=config["motor_torque_nm_max"] * share * config["gear_ratio"] * ROUNDED,
    )


def _used(config: Mapping[str, Any]) -> set[str]:
    """The tables that a fuzzy mode follows."""
    modes = zip(config["mode_laws"], config["mode_tables"], strict=True)
    return {"second" if second else "first" for kind, second in modes if kind == "fuzzy"}


def _cells(
    config: Mapping[str, Any],
    market: str,
    cutoff_kmh: float,
    helping: tuple[int, ...],
    gains: Mapping[str, tuple[float, ...]],
) -> Iterator[Cell]:
    """Assist asked between neighbouring speed points, up to the cut-off."""
    inner = config["fuzzy_speed_points_kmh"][1:-1]
    edges = [0.0, *(edge for edge in inner if edge < cutoff_kmh), cutoff_kmh]
    allowed = unit.market_ratios(market, edges)
    asked = np.zeros((len(edges) - 1, 5))
    for slot in helping:
        if config["mode_laws"][slot] == "fuzzy":
            which = "second" if config["mode_tables"][slot] else "first"
            rows = np.array(gains[which][: len(asked)])
            asked[:, slot] = config["mode_ratios"][slot] * (1.0 + rows)
        else:
            # It never rises with speed, in float32 neither: its most is where the cell begins.
            asked[:, slot] = law.steady_ratios(config, slot, edges[:-1])
    for row, (start, end) in enumerate(pairwise(edges)):
        ratio = None if allowed is None else float(allowed[row + 1])
        yield Cell(start, end, float(asked[row].max()) * ROUNDED, ratio)


def _claims(known: _Known) -> Iterator[Claim]:
    yield from _speed_claims(known)
    yield from _ratio_claims(known)
    yield from _power_claims(known)
    yield from _ending_claims(known)
    yield _rise_claim(known)


def _speed_claims(known: _Known) -> Iterator[Claim]:
    profile, config = known.profile, known.config
    market = market_words(known.market)
    yield Claim(
        "cutoff",
        f"At {known.cutoff_kmh:.4g} km/h and above, also between the points of a table, the motor"
        f" gives nothing; {market} allows assist up to {profile.cutoff_kmh:.4g} km/h.",
        "km/h",
        known.cutoff_kmh,
        profile.cutoff_kmh,
        False,
        "structure",
        {"market": known.market},
    )
    band_kmh = max(config["assist_cutoff_band_kmh"], profile.band_kmh or 0.0)
    yield Claim(
        "band",
        f"What is asked falls to nothing over the last {band_kmh:.4g} km/h below that.",
        "km/h",
        band_kmh,
        profile.band_kmh,
        True,
        "structure",
        {},
    )
    walks = config["walk_speed_kmh"] > 0.0 and profile.walk_kmh > 0.0 and bool(known.helping)
    walk_kmh = profile.walk_kmh if walks else None
    words = f"pushes only below {walk_kmh:.4g} km/h" if walk_kmh else "never pushes"
    yield Claim(
        "walk",
        f"Without pedalling the motor {words}.",
        "km/h",
        walk_kmh,
        profile.walk_kmh,
        False,
        "structure",
        {},
    )


def _ratio_claims(known: _Known) -> Iterator[Claim]:
    if known.gain is not None:
        yield Claim(
            "gain",
            f"Between the points of the tables the gain is at most {known.gain:.4g}.",
            "1",
            known.gain,
            None,
            False,
            "interval",
            {},
        )
    yield Claim(
        "ratio",
        f"The motor's torque at the crank is at most {known.ratio:.4g} times the hardest push since"
        " the unit was switched on, walk assist apart.",
        "1",
        known.ratio,
        None,
        False,
        "interval",
        {},
    )
    if not known.profile.ratio_falls:
        return
    over = [cell for cell in known.cells if cell.ratio_most > (cell.allowed_ratio or 0.0)]
    from_kmh = over[0].from_kmh if over else known.cutoff_kmh
    words = (
        f"; from {from_kmh:.4g} km/h on the modes may ask for more, and the last step cuts it"
        if over
        else ""
    )
    yield Claim(
        "market_ratio",
        "In every control step the torque at the crank is at most what"
        f" {market_words(known.market)} allows for the push of that moment, twice and falling with"
        f" the speed{words}.",
        "1",
        2.0,
        2.0,
        False,
        "structure",
        {"market": known.market, "from_kmh": from_kmh},
    )


def _power_claims(known: _Known) -> Iterator[Claim]:
    config, profile = known.config, known.profile
    yield Claim(
        "torque",
        f"The motor's torque at the crank is at most {known.crank_nm:.4g} Nm.",
        "Nm",
        known.crank_nm,
        None,
        False,
        "structure",
        {},
    )
    fastest_rad_s = config["motor_speed_rpm_max"] * math.pi / 30.0
    peak_w = min(
        BATTERY_V * config["battery_current_a_max"],
        known.crank_nm / config["gear_ratio"] * fastest_rad_s,
        profile.peak_w or math.inf,
        (1.0 + HEADROOM) * (profile.continuous_w or math.inf),
    )
    peak_w *= ROUNDED if peak_w != profile.peak_w else 1.0
    yield Claim(
        "power_peak",
        f"At no moment the motor is told more than {peak_w:.4g} W at its shaft.",
        "W",
        peak_w,
        profile.peak_w,
        False,
        "structure",
        {},
    )
    if profile.continuous_w is None:
        return
    mean_w = min(peak_w, profile.continuous_w * (1.0 + MEAN_S / RATING_S) * SUMMED)
    yield Claim(
        "power_continuous",
        f"Over any half hour the motor is told {mean_w:.4g} W at its shaft in the mean at most;"
        f" rated are {profile.continuous_w:.4g} W, and 5 % more are accepted.",
        "W",
        mean_w,
        RATING_SHARE * profile.continuous_w,
        False,
        "recursion",
        {"rated_w": profile.continuous_w},
    )


def _ending_claims(known: _Known) -> Iterator[Claim]:
    """How long assist lasts after what should end it, from the control step that reads it."""
    config, profile = known.config, known.profile
    stop_s = min(float(np.float32(config["pedal_stop_ms"] / 1000.0)), profile.pedal_stop_s)
    steps = int(np.float32(stop_s) / np.float32(STEP_S) + np.float32(0.5))
    outlives_s = max(steps - 1, 0) * STEP_S
    way_m = outlives_s * known.cutoff_kmh / KMH_PER_MS
    yield Claim(
        "pedal_stop",
        f"Assist outlives the first reading without forward pedalling by {outlives_s:.3g} s at"
        f" most: {way_m:.3g} m at the cut-off speed.",
        "s",
        outlives_s,
        profile.pedal_stop_s,
        False,
        "recursion",
        {"way_m": way_m},
    )
    push_nm = max(config["pedal_torque_nm_min"], PUSH_NM)
    push_s = (HALF_SECONDS * _steps_within(HALF_SECOND_S) - 1) * STEP_S
    yield Claim(
        "push_stop",
        f"Assist outlives the last push of {push_nm:.3g} Nm by {push_s:.3g} s at most, whatever"
        " filter and ramp still hold.",
        "s",
        push_s,
        None,
        False,
        "recursion",
        {"push_nm": push_nm},
    )
    yield Claim(
        "cut",
        "At the cut-off speed, on a brake, a fault or an empty battery the torque is zero in the"
        f" control step that reads it: {STEP_S:g} s at most.",
        "s",
        STEP_S,
        None,
        False,
        "structure",
        {},
    )
    falls = [
        min(config["assist_ramp_down_nm_per_s"], config["mode_ramp_down_nm_per_s"][slot])
        for slot in known.helping
    ]
    slowest = max(min(falls, default=LOST_NM_PER_S), LOST_NM_PER_S)
    lost_s = HOLD_S + (math.ceil(known.crank_nm / (slowest * STEP_S)) + 1) * STEP_S
    yield Claim(
        "lost_reading",
        f"Without a new torque reading the torque is zero after {lost_s:.3g} s at most.",
        "s",
        lost_s,
        None,
        False,
        "recursion",
        {},
    )


def _steps_within(duration_s: float) -> int:
    """Control steps whose count in seconds, in float32, is not above this."""
    steps = round(duration_s / STEP_S)
    longer = np.float32(steps) * np.float32(STEP_S) > np.float32(duration_s)
    return steps - 1 if longer else steps


def _rise_claim(known: _Known) -> Claim:
    config = known.config
    rises = [
        min(config["assist_ramp_up_nm_per_s"], config["mode_ramp_up_nm_per_s"][slot])
        for slot in known.helping
    ]
    # The torque before is rounded three times on its way through the gears.
    rise = max(rises, default=0.0) * ROUNDED + known.crank_nm * 4e-7 / STEP_S
    return Claim(
        "rise",
        f"The torque at the crank rises by at most {rise:.4g} Nm a second.",
        "Nm/s",
        rise,
        None,
        False,
        "recursion",
        {},
    )
