"""Replaying a ride: its inputs through the unit's own law, with another table or other modes.

The configuration the unit had at each moment of the ride is the starting point, so that only what
was changed differs. The loop is open: speed and legs are as recorded, whatever the motor would have
changed of them. So what is compared first is work for a kilometre: the same kilometres either way,
while work alone grows with how long the road took. The recorded motor and the replayed one are told
side by side. How well a replay without any change matches the record says how far the answer can be
trusted.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from backend import law
from backend.core._generated import INPUT_FLAGS
from backend.core.channels import ChannelSpec, Values
from backend.core.energy import DELIVERED, KMH_PER_MS, RADIANS_PER_S_PER_RPM, SECONDS_PER_HOUR
from backend.core.ride import Ride, largest
from backend.errors import InvalidRequest
from backend.rides.settings_in_force import ConfigOf, Stretch, source_of, stretches
from backend.rides.traces.trace import trace
from backend.store import RideReader
from backend.tuning.preview import Preview

# The law steps every 10 ms; a ride sampled far slower than that is not what the law saw.
PERIOD_US_MAX = 100_000
NEEDED = ("speed_kmh", "cadence_rpm", "assist_mode")
TORQUES = ("rider_torque_raw", "rider_torque_nm")
OPTIONAL = (
    "motor_speed_rpm",
    "battery_voltage_v",
    "battery_current_a",
    "motor_temperature_degc",
    "controller_temperature_degc",
    "torque_age_ms",
)
SENSOR_DEGC = "sensor_temperature_degc"
"""What raw readings are corrected by; torques that were recorded are, by the unit."""
FLAGS = "input_flags"
LIMITS = "limit_flags"
COMPARED = (
    ChannelSpec("motor_torque_nm", "Nm", 0.0001),
    ChannelSpec("motor_torque_demanded_nm", "Nm", 0.0001),
    ChannelSpec("assist_ratio", "", 0.0002),
    ChannelSpec("fuzzy_gain", "", 0.00005),
)
REPLAYED = "replayed_"
OPEN_LOOP = (
    "Open loop: speed and legs as recorded. With more help the bike would have been faster and the"
    " ride shorter; this tells what the motor would have given at the speeds that were ridden."
)
DISTANCE_KM_MIN = 0.01
SERIES_PIXELS = 1200
WARM_UP_S = 600.0
MEMORY_S = 5.0
"""After it the law has forgotten strokes and ramps, but not a market's mean power of a minute."""


class RideReplay:
    """Replays one ride at a time; holds nothing of it."""

    def __init__(self, preview: Preview, config_of: ConfigOf) -> None:
        self._preview = preview
        self._config_of = config_of

    def __call__(
        self,
        reader: RideReader,
        fuzzy_table: Mapping[str, Any] | None = None,
        assist_modes: Mapping[str, Any] | None = None,
        second_table: Mapping[str, Any] | None = None,
        parameters: Mapping[str, Any] | None = None,
    ) -> dict[str, Any]:
        """The comparison as in the API. fuzzy_table and the rest: as of `changed_config`.

        Raises InvalidRequest for a ride that lacks what the law needs, or settings it refuses.
        """
        ride = reader.ride
        columns = read_columns(reader)
        step_s = (ride.period_us or 0) / 1e6
        parts = stretches(self._config_of, ride)
        inputs = law_inputs(columns)

        def of(part: Stretch) -> law.Replay:
            start, stop = part.rows(reader)
            rows = remembered_rows(reader, start, stop)
            read = {
                name: values if np.ndim(values) == 0 else np.asarray(values)[rows]
                for name, values in inputs.items()
            }
            changes = fuzzy_table, assist_modes, step_s, second_table, parameters
            first = len(rows) - (stop - start)
            return self._preview.replay(part.config, read, *changes, first=first)

        replayed = law.joined([of(part) for part in parts])
        new_nm = np.asarray(replayed.motor_torque_nm, np.float64)
        # What was only asked of a motor is not compared with what it gives.
        delivered = ride.motor_torque_meaning == DELIVERED
        recorded_nm = columns.get("motor_torque_nm") if delivered else None
        recorded_wh = work_wh(recorded_nm, columns.get("motor_speed_rpm"), step_s)
        distance_km = float(np.nansum(columns["speed_kmh"])) * step_s / SECONDS_PER_HOUR
        return {
            "ride_id": ride.id,
            "mode": "open_loop",
            "meaning": OPEN_LOOP,
            "config_source": source_of(parts),
            "engine": law.ENGINE,
            "inputs_missing": inputs_missing(columns),
            "rows": len(new_nm),
            "motor_torque_meaning": ride.motor_torque_meaning,
            "wh_per_km": per_km(recorded_wh, replayed.motor_work_wh, distance_km),
            "distance_km": distance_km,
            "duration_s": len(new_nm) * step_s,
            "range_km": None,
            "motor_work_wh": compared(recorded_wh, replayed.motor_work_wh),
            "motor_torque_nm_max": compared(largest(recorded_nm), replayed.motor_torque_nm_max),
            **moving_figures(
                columns["speed_kmh"] / KMH_PER_MS > law.STANDING_MS,
                (recorded_wh, recorded_nm),
                (replayed.motor_work_wh, new_nm),
                step_s,
            ),
            "motor_torque_nm_difference_max": difference_max(recorded_nm, new_nm),
            "limit_shares": replayed.limit_shares,
            "limit_shares_recorded": recorded_shares(columns.get(LIMITS)),
            "series": series(reader, columns, replayed_columns(replayed)),
        }


def read_columns(reader: RideReader, start: int = 0, stop: int | None = None) -> dict[str, Values]:
    """The channels the law needs and the ones it is compared on, (n,) each, missing as NaN.

    Rows [start, stop), the whole ride without them. Raises InvalidRequest if the ride lacks one, or
    is sampled too slowly.
    """
    offered = {channel.name for channel in reader.ride.channels}
    torque = next((name for name in TORQUES if name in offered), TORQUES[0])
    missing = [name for name in (*NEEDED, torque) if name not in offered]
    if missing:
        raise InvalidRequest(
            f"Ride {reader.ride.id} cannot be replayed: it has no {', '.join(missing)}. Rides "
            "recorded from a unit have them, files of head units do not.",
            code="missing_channel",
        )
    if reader.period_us is None or reader.period_us > PERIOD_US_MAX:
        raise InvalidRequest(
            f"Ride {reader.ride.id} cannot be replayed: its samples are too far apart; the law "
            f"needs one at least every {PERIOD_US_MAX // 1000} ms.",
            code="too_slow",
        )
    names = [
        *NEEDED,
        torque,
        *OPTIONAL,
        SENSOR_DEGC,
        FLAGS,
        LIMITS,
        *(channel.name for channel in COMPARED),
    ]
    spans = [span.rows(reader.period_us) for span in reader.ride.filled]
    read = reader.values(names, start, stop)
    return {name: held_between_samples(values, spans, start) for name, values in read.items()}


def held_between_samples(values: Values, spans: Sequence[tuple[int, int]], first: int) -> Values:
    """Values (n,) in which a log's sample holds until the next, as in a ride of the log alone.

    spans: the log's rows of the ride. first: the ride's row that values[0] is of.
    """
    for begin, end in spans:
        start, stop = max(begin - first, 0), max(end - first, 0)
        valid = np.flatnonzero(np.isfinite(values[start:stop]))
        if len(valid):
            latest = np.searchsorted(valid, np.arange(len(values[start:stop])), side="right") - 1
            values[start:stop] = values[start + valid[np.maximum(latest, 0)]]
    return values


def warm_up_row(ride: Ride, row: int) -> int:
    """Where the law starts from rest so that it remembers what it did at this row."""
    period_s = (ride.period_us or 1) / 1e6
    begins = [round(gap.to_s / period_s) for gap in ride.gaps]
    segment = max((begin for begin in begins if begin <= row), default=0)
    return max(segment, row - round(WARM_UP_S / period_s), 0)


def remembered_rows(reader: RideReader, start: int, stop: int) -> npt.NDArray[np.intp]:
    """Rows [start, stop) after those that the law remembers at their beginning, (n,).

    Where these begin on the way, what was before them nobody recorded: rows after that place stand
    for it, the nearest last.
    """
    before = warm_up_row(reader.ride, start)
    ahead = before + round(MEMORY_S * 1e6 / (reader.period_us or 1))
    mirrored = np.arange(min(ahead, reader.row_count - 1), before, -1)
    return np.concatenate((mirrored, np.arange(before, stop)))


def inputs_missing(columns: Mapping[str, Values]) -> list[str]:
    """The channels of the law's inputs that a ride has not one sample of.

    What stands for them is the law's business: backend.law.replay.
    """
    recorded = {name for name, values in columns.items() if np.isfinite(values).any()}
    return [name for name in (*OPTIONAL, FLAGS) if name not in recorded]


def law_inputs(columns: Mapping[str, Values]) -> dict[str, npt.ArrayLike]:
    """The law's inputs by its own names.

    A sample without a mode gets slot 0, one without a torque or its age no assist, one without
    flags nothing pressed and no fault.
    """
    inputs: dict[str, npt.ArrayLike] = {
        name: columns[name] for name in ("speed_kmh", "cadence_rpm", *OPTIONAL) if name in columns
    }
    if "rider_torque_raw" in columns:
        inputs["torque_raw_counts"] = columns["rider_torque_raw"]
        inputs[SENSOR_DEGC] = columns.get(SENSOR_DEGC, np.nan)
    else:
        inputs["rider_torque_nm"] = columns["rider_torque_nm"]
    inputs["mode"] = np.nan_to_num(columns["assist_mode"]).astype(np.uint8)
    if FLAGS in columns:
        flags = np.nan_to_num(columns[FLAGS]).astype(np.uint16)
        inputs |= {name: flags & flag != 0 for name, flag in INPUT_FLAGS.items()}
    return inputs


def replayed_columns(replayed: object) -> dict[str, Values]:
    """The replay's answers for the compared channels, as float64 (n,)."""
    return {
        channel.name: np.asarray(getattr(replayed, channel.name), np.float64)
        for channel in COMPARED
    }


def compared(recorded: float | None, replayed: float) -> dict[str, float | None]:
    """The two figures and what the change makes of it."""
    difference = None if recorded is None else replayed - recorded
    return {"recorded": recorded, "replayed": replayed, "difference": difference}


def per_km(
    recorded_wh: float | None, replayed_wh: float, distance_km: float
) -> dict[str, float | None] | None:
    """The two works for a kilometre; None for a ride that went next to nowhere."""
    if distance_km < DISTANCE_KM_MIN:
        return None
    recorded = None if recorded_wh is None else recorded_wh / distance_km
    return compared(recorded, replayed_wh / distance_km)


def moving_figures(
    moving: npt.NDArray[np.bool_],
    recorded: tuple[float | None, Values | None],
    replayed: tuple[float, Values],
    step_s: float,
) -> dict[str, Any]:
    """Mean power and ripple of the motor while the bike moves (n,), as a twin's ride tells them;
    None where it never does. recorded, replayed: work in Wh, and torque at the shaft (n,)."""
    if not moving.any():
        return {"motor_power_w_mean": None, "ripple_nm_per_s": None}

    def power_w(work_wh: float) -> float:
        return law.power_w_mean(work_wh * SECONDS_PER_HOUR, moving, step_s)

    def ripple(torque_nm: Values) -> float:
        return law.ripple_nm_per_s(torque_nm, moving, step_s)

    (then_wh, then_nm), (now_wh, now_nm) = recorded, replayed
    return {
        "motor_power_w_mean": compared(
            None if then_wh is None else power_w(then_wh), power_w(now_wh)
        ),
        "ripple_nm_per_s": compared(None if then_nm is None else ripple(then_nm), ripple(now_nm)),
    }


def work_wh(torque_nm: Values | None, speed_rpm: Values | None, step_s: float) -> float | None:
    """Work at the motor's shaft over the samples that are there, Wh."""
    if torque_nm is None or speed_rpm is None:
        return None
    power_w = torque_nm * speed_rpm * RADIANS_PER_S_PER_RPM
    return float(np.nansum(power_w)) * step_s / SECONDS_PER_HOUR


def difference_max(recorded: Values | None, replayed: Values) -> float | None:
    """The largest difference of any one sample, None where nothing was recorded."""
    return None if recorded is None else largest(np.abs(replayed - recorded))


def recorded_shares(flags: Values | None) -> dict[str, float] | None:
    """Part of the recorded samples in which each limit was at work; None where none was recorded.

    flags: (n,), missing as NaN.
    """
    if flags is None or not np.isfinite(flags).any():
        return None
    return law.limit_shares(flags[np.isfinite(flags)].astype(np.uint16))


class ReplayedReader:
    """Recorded and replayed channels beside one another, as a view reads a ride."""

    def __init__(self, period_us: int, channels: Mapping[ChannelSpec, Values]) -> None:
        self.period_us: int | None = period_us
        self.row_count = len(next(iter(channels.values())))
        self.offered = tuple(channels)
        self._values = {spec.name: values for spec, values in channels.items()}
        self._counts = {spec.name: spec.to_counts(values) for spec, values in channels.items()}

    def times_us(self, start: int, stop: int) -> npt.NDArray[np.int64]:
        """Times of rows [start, stop)."""
        return np.arange(start, stop, dtype=np.int64) * (self.period_us or 1)

    def counts(self, names: Any, start: int, stop: int) -> Any:
        """Counts of rows [start, stop)."""
        return {name: self._counts[name][start:stop] for name in names}

    def values(self, names: Sequence[str]) -> dict[str, Values]:
        """Values of those of the channels that are here."""
        return {name: self._values[name] for name in names if name in self._values}

    def row_seconds(self) -> Values:
        """Each row holds for a period."""
        return np.full(self.row_count, (self.period_us or 1) / 1e6)

    def breaks(self) -> npt.NDArray[np.bool_]:
        """There are none."""
        return np.zeros(max(self.row_count - 1, 0), np.bool_)

    def level(self, rows_per_bin: int) -> None:
        """There is no pyramid: the rows are at hand."""


def series(
    reader: RideReader, columns: Mapping[str, Values], replayed: Mapping[str, Values]
) -> dict[str, object]:
    """Recorded and replayed traces at a plot's width."""
    channels: dict[ChannelSpec, Values] = {}
    for spec in COMPARED:
        if spec.name in columns:
            channels[spec] = columns[spec.name]
        channels[ChannelSpec(REPLAYED + spec.name, spec.unit, spec.scale)] = replayed[spec.name]
    other = ReplayedReader(reader.period_us or 1, channels)
    return trace(other, pixels=SERIES_PIXELS).to_json()
