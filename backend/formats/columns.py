"""From the columns a file happens to have to the rows of a ride, by our rules.

- A row without a believable time is dropped, and counted (`core.intake`).
- A break of hours makes two rides. A clock that jumps away and comes back makes none.
- Rows of one time that complete each other are one row: some head units write a row's parts one
  after the other. Rows of one time that differ are samples of their own, and stand evenly in it.
- Missing is missing: a maker's "no value" number (65535, 255) never becomes a value, nor does what
  no bike can do, nor a single sample far from both its neighbours (one flipped bit in an odometer
  makes 84 km of 2.9), nor positions that nobody could have reached (`positions`). All become null,
  never 0.
- A distance that begins anew goes on where it was (`counters`). Speeds that are all below 0 are
  those of a controller mounted the other way round, and turned.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import numpy.typing as npt

from backend.core.channels import ChannelSpec, Values
from backend.core.energy import KMH_PER_MS
from backend.core.intake import CLOCK_JUMPED, CLOCK_NOT_SET, NO_TIME, NO_VALUE, Intake
from backend.core.ride import RideRows
from backend.formats.counters import continue_counter
from backend.formats.fit_numbers import EPOCH_S
from backend.formats.outcome import ImportedRide
from backend.formats.positions import without_nowhere, without_unreachable

# Before it a clock was never set: FIT then counts from the device's start. Behind 2099 nothing is.
CLOCK_MIN_S = EPOCH_S + 0x10000000
LATEST_S = 4_102_444_800
# A break longer than this is between two rides: nobody rests so long within one.
BREAK_S = 6 * 3600
# Rows of one time lie within this, if no other time comes sooner.
TICK_US = 1_000_000
# Rows closer than this to equal spacing make a regular ride.
REGULAR_TOLERANCE_US = 1000
# A spike stands out by more than this many of its own resolution, too.
SPIKE_STEPS = 4
# Of a controller that is mounted the other way round, pushing it back is the rest.
TURNED_SHARE = 0.9

Seconds = npt.NDArray[np.float64]
Places = npt.NDArray[np.intp]


@dataclass(frozen=True)
class FieldRule:
    """How a field of a file becomes a channel.

    sources: names of the field, the best first. factor: file's unit -> channel's unit.
    lowest, highest: what a bike can do; beyond it the sample is missing. rate_max: how fast it can
    change, a second; a single sample that does so to and fro is missing. counts: it only grows.
    may_be_turned: as a whole it may have the other sign.
    """

    channel: ChannelSpec
    sources: tuple[str, ...]
    lowest: float
    highest: float
    factor: float = 1.0
    rate_max: float = np.inf
    counts: bool = False
    may_be_turned: bool = False


SEMICIRCLE_DEG = 180.0 / 2**31
LATITUDE, LONGITUDE = "latitude_deg", "longitude_deg"

FIT_FIELDS: tuple[FieldRule, ...] = (
    # 2 g, which no tyre holds.
    FieldRule(
        ChannelSpec("speed_kmh", "km/h", 0.0036),
        ("enhanced_speed", "speed"),
        0,
        117.9,
        KMH_PER_MS,
        70.0,
        may_be_turned=True,
    ),
    FieldRule(ChannelSpec("cadence_rpm", "rpm", 1.0), ("cadence",), 0, 254),
    FieldRule(ChannelSpec("rider_power_w", "W", 1.0), ("power",), 0, 4000),
    FieldRule(ChannelSpec("rider_torque_nm", "Nm", 0.01), ("rider_torque",), -320, 320),
    FieldRule(ChannelSpec("right_leg_pct", "%", 1.0), ("right_leg",), 0, 100),
    *(
        FieldRule(ChannelSpec(f"{name}_pct", "%", 0.5), (name,), 0, 100)
        for name in (
            "left_torque_effectiveness",
            "right_torque_effectiveness",
            "left_pedal_smoothness",
            "right_pedal_smoothness",
            "combined_pedal_smoothness",
        )
    ),
    FieldRule(ChannelSpec("motor_power_w", "W", 1.0), ("motor_power",), 0, 4000),
    FieldRule(ChannelSpec("motor_torque_nm", "Nm", 0.01), ("motor_torque",), -320, 320),
    FieldRule(
        ChannelSpec("motor_torque_demanded_nm", "Nm", 0.01), ("motor_torque_demanded",), -320, 320
    ),
    FieldRule(ChannelSpec("battery_current_a", "A", 0.01), ("battery_current",), -320, 320),
    FieldRule(
        ChannelSpec("motor_temperature_degc", "degC", 0.01), ("motor_temperature",), -60, 320
    ),
    FieldRule(ChannelSpec("motor_current_a", "A", 0.01), ("motor_current",), -320, 320),
    FieldRule(ChannelSpec("battery_voltage_v", "V", 0.01), ("battery_voltage",), 0, 120),
    FieldRule(ChannelSpec("battery_soc_pct", "%", 1.0), ("ebike_battery_level",), 0, 100),
    FieldRule(ChannelSpec("assist_mode", "", 1.0), ("ebike_assist_mode",), 0, 254),
    FieldRule(ChannelSpec("assist_level_pct", "%", 1.0), ("ebike_assist_level_percent",), 0, 254),
    FieldRule(ChannelSpec("range_km", "km", 1.0), ("ebike_travel_range",), 0, 1000),
    FieldRule(ChannelSpec("fuzzy_gain", "", 0.0001), ("fuzzy_gain",), 0, 3),
    FieldRule(ChannelSpec("heart_rate_bpm", "bpm", 1.0), ("heart_rate",), 1, 254),
    FieldRule(ChannelSpec("temperature_degc", "degC", 1.0), ("temperature",), -60, 120),
    FieldRule(
        ChannelSpec("altitude_m", "m", 0.2),
        ("enhanced_altitude", "altitude"),
        -500,
        6000,
        rate_max=50.0,
    ),
    FieldRule(ChannelSpec("grade_pct", "%", 0.01), ("grade",), -100, 100),
    FieldRule(
        ChannelSpec("distance_m", "m", 0.01, wide=True),
        ("distance",),
        0,
        2e7,
        rate_max=60.0,
        counts=True,
        may_be_turned=True,
    ),
    FieldRule(ChannelSpec(LATITUDE, "deg", SEMICIRCLE_DEG, wide=True), ("position_lat",), -90, 90),
    FieldRule(
        ChannelSpec(LONGITUDE, "deg", SEMICIRCLE_DEG, wide=True), ("position_long",), -180, 180
    ),
)


@dataclass
class Tally:
    """What is counted while one ride is made."""

    spread: int = 0
    moved: int = 0
    dropped: dict[str, int] = field(default_factory=dict)
    values: dict[str, int] = field(default_factory=dict)
    restarts: dict[str, int] = field(default_factory=dict)
    turned: list[str] = field(default_factory=list)

    def drop(self, reason: str, rows: int) -> None:
        """Count rows that are not in the ride."""
        if rows:
            self.dropped[reason] = self.dropped.get(reason, 0) + rows

    def leave_out(self, channel: str, samples: int) -> None:
        """Count samples that are missing from now on."""
        if samples:
            self.values[channel] = self.values.get(channel, 0) + samples


def rides_of_columns(
    time_s: Seconds,
    columns: Mapping[str, Values],
    fields: tuple[FieldRule, ...] = FIT_FIELDS,
    sport: str | None = None,
    unread: Mapping[str, int] | None = None,
) -> list[ImportedRide]:
    """Columns (n,) and Unix times (n,) -> rides in order of time; none without a time and a value.

    columns: by the file's field names, missing as NaN. unread: fields that are in no column. What
    is in no ride is counted with the first.
    """
    tally = Tally()
    read = {rule: values for rule in fields if (values := rule_values(rule, columns)) is not None}
    rides: list[tuple[ImportedRide, Tally, int]] = []
    for rows in blocks_of_time(time_s, tally):
        own = tally if not rides else Tally()
        samples = {rule: values[rows] for rule, values in read.items()}
        ride = ride_of_rows(rows, time_s[rows], samples, own, sport)
        if ride is None:
            tally.drop(NO_VALUE, len(rows))
            continue
        rides.append((ride, own, len(rows)))
    return [
        with_intake(ride, own, rows, unread if number == 0 else None)
        for number, (ride, own, rows) in enumerate(rides)
    ]


def with_intake(
    ride: ImportedRide, tally: Tally, rows: int, unread: Mapping[str, int] | None
) -> ImportedRide:
    """The ride with what became of the rows it was made of."""
    row_count = len(ride.rows.times_us)
    intake = Intake(
        rows_read=rows + sum(tally.dropped.values()),
        rows_kept=row_count,
        rows_joined=rows - row_count,
        rows_spread=tally.spread,
        rows_moved=tally.moved,
        rows_dropped=dict(tally.dropped),
        values_dropped=dict(tally.values),
        restarts=dict(tally.restarts),
        turned=tuple(tally.turned),
        fields_unread=dict(unread or {}),
    )
    return replace(ride, intake=intake)


def blocks_of_time(time_s: Seconds, tally: Tally) -> list[Places]:
    """Rows with believable times, a block for each ride, each in order of time."""
    plausible = np.isfinite(time_s) & (time_s < LATEST_S) & (time_s > EPOCH_S)
    tally.drop(NO_TIME, int((~plausible).sum()))
    is_set = plausible & (time_s >= CLOCK_MIN_S)
    if is_set.any():
        tally.drop(CLOCK_NOT_SET, int((plausible & ~is_set).sum()))
    rows = np.flatnonzero(is_set if is_set.any() else plausible)
    if not len(rows):
        return []
    order = rows[np.argsort(time_s[rows], kind="stable")]
    breaks = np.flatnonzero(np.diff(time_s[order]) > BREAK_S) + 1
    blocks = np.split(order, breaks)
    in_order = [block for block in blocks if not jumped_away(block, blocks)]
    tally.drop(CLOCK_JUMPED, len(rows) - sum(map(len, in_order)))
    return in_order


def jumped_away(block: Places, blocks: Sequence[Places]) -> bool:
    """Whether a block stands in the middle of a larger one in the file, though not in time."""
    first, last = block.min(), block.max()
    return any(
        len(other) > len(block) and other.min() < first and other.max() > last for other in blocks
    )


def ride_of_rows(
    rows: Places,
    time_s: Seconds,
    read: Mapping[FieldRule, Values],
    tally: Tally,
    sport: str | None,
) -> ImportedRide | None:
    """One block of rows, in order of time, as a ride; None when it has no value.

    rows: their places in the file. time_s: of each. read: values of each, cleaned on the way.
    """
    tally.moved = int((np.diff(rows) < 0).sum())
    unix_us = np.rint(time_s * 1e6).astype(np.int64)
    started_us = int(unix_us[0])
    times_us = unix_us - started_us
    for rule, values in read.items():
        if rule.may_be_turned and is_turned(values):
            np.negative(values, out=values)
            tally.turned.append(rule.channel.name)
    left_out = {rule: cleaned(rule, values) for rule, values in read.items()}
    starts = np.flatnonzero(np.concatenate(([True], np.diff(times_us) > 0)))
    if len(starts) < len(times_us):
        times_us, starts = spread_out(times_us, starts, read.values(), tally)
    times = times_us[starts]
    merged: dict[str, Values] = {}
    for rule, values in read.items():
        one = merged[rule.channel.name] = first_present(values, starts)
        spikes = without_spikes(rule, one, times)
        tally.leave_out(rule.channel.name, left_out[rule] + spikes)
        if rule.counts and (restarts := continue_counter(one, times / 1e6, rule.rate_max)):
            tally.restarts[rule.channel.name] = restarts
    if LATITUDE in merged and LONGITUDE in merged:
        nowhere = without_nowhere(merged[LATITUDE], merged[LONGITUDE])
        unreachable = without_unreachable(merged[LATITUDE], merged[LONGITUDE], times / 1e6)
        for name in (LATITUDE, LONGITUDE):
            tally.leave_out(name, nowhere + unreachable)
    channels = [rule.channel for rule in read if np.isfinite(merged[rule.channel.name]).any()]
    if not channels:
        return None
    counts = {channel.name: channel.to_counts(merged[channel.name]) for channel in channels}
    ride_rows = RideRows(tuple(channels), times, counts)
    return ImportedRide(
        started_us,
        regular_period_us(times),
        ride_rows,
        sport,
        start_known=started_us >= CLOCK_MIN_S * 1_000_000,
    )


def rule_values(rule: FieldRule, columns: Mapping[str, Values]) -> Values | None:
    """The rule's values (n,), from its best source row by row; None when no source is there."""
    sources = [columns[name] for name in rule.sources if name in columns]
    if not sources:
        return None
    values = np.array(sources[0], dtype=np.float64)
    for other in sources[1:]:
        values = np.where(np.isnan(values), other, values)
    values *= rule.factor
    return values


def is_turned(values: Values) -> bool:
    """Whether nearly all of the numbers that are not 0 are below it."""
    signs = values[np.isfinite(values) & (values != 0)]
    return len(signs) > 0 and bool(np.mean(signs < 0) >= TURNED_SHARE)


def cleaned(rule: FieldRule, values: Values) -> int:
    """Take out of `values` what no bike can do; how many that were."""
    if rule.channel.name == LONGITUDE:
        # East of 180 degrees some files count on.
        beyond = (np.abs(values) > 180) & (np.abs(values) <= 360)
        values[beyond] -= np.copysign(360.0, values[beyond])
    impossible = np.isfinite(values) & ((values < rule.lowest) | (values > rule.highest))
    values[impossible | ~np.isfinite(values)] = np.nan
    return int(impossible.sum())


def without_spikes(rule: FieldRule, values: Values, times_us: npt.NDArray[np.int64]) -> int:
    """Take single samples out of `values` that leave both neighbours faster than can be.

    The neighbours agree with each other, so that nothing real looks like this. How many that were.
    """
    valid = np.flatnonzero(np.isfinite(values))
    if not np.isfinite(rule.rate_max) or len(valid) < 3:
        return 0
    seconds = times_us[valid] / 1e6
    least = SPIKE_STEPS * rule.channel.scale
    with_rate = rule.rate_max * np.diff(seconds) + least
    steps = np.diff(values[valid])
    across = np.abs(values[valid][2:] - values[valid][:-2])
    fast = np.abs(steps) > with_rate
    back = np.signbit(steps[:-1]) != np.signbit(steps[1:])
    spikes = fast[:-1] & fast[1:] & back & (across <= with_rate[:-1] + with_rate[1:])
    # The first and the last have one neighbour each, which the next one beyond bears out.
    ends = np.array([fast[0] and not fast[1], fast[-1] and not fast[-2]])
    inner = valid[1:-1][spikes]
    outer = valid[[0, -1]][ends]
    values[inner] = np.nan
    values[outer] = np.nan
    return len(inner) + len(outer)


def spread_out(
    times_us: npt.NDArray[np.int64],
    starts: Places,
    read: Iterable[Values],
    tally: Tally,
) -> tuple[npt.NDArray[np.int64], Places]:
    """Give rows of one time that differ times of their own; times and beginnings of rows now."""
    differ = np.zeros(len(starts), dtype=bool)
    for values in read:
        valid = np.isfinite(values)
        highest = np.maximum.reduceat(np.where(valid, values, -np.inf), starts)
        lowest = np.minimum.reduceat(np.where(valid, values, np.inf), starts)
        differ |= highest > lowest
    sizes = np.diff(np.append(starts, len(times_us)))
    if not differ.any():
        return times_us, starts
    firsts = times_us[starts]
    room_us = np.minimum(np.diff(firsts, append=firsts[-1] + TICK_US), TICK_US)
    group = np.repeat(np.arange(len(starts)), sizes)
    place = np.arange(len(times_us)) - starts[group]
    moved = np.where(differ[group], place * (room_us // sizes)[group], 0)
    times = times_us + moved
    tally.spread += int(sizes[differ].sum())
    return times, np.flatnonzero(np.concatenate(([True], np.diff(times) > 0)))


def first_present(values: Values, starts: Places) -> Values:
    """The first sample that is there in each group of rows beginning at `starts`; a copy."""
    if len(starts) == len(values):
        return values.copy()
    index = np.where(np.isfinite(values), np.arange(len(values)), len(values))
    first = np.minimum.reduceat(index, starts)
    return np.append(values, np.nan)[first]


def regular_period_us(times_us: npt.NDArray[np.int64]) -> int | None:
    """The spacing when every row keeps to it, else None."""
    if len(times_us) < 2:
        return None
    period_us = round(float(times_us[-1]) / (len(times_us) - 1))
    expected = np.arange(len(times_us), dtype=np.int64) * period_us
    regular = period_us > 0 and bool(np.abs(times_us - expected).max() <= REGULAR_TOLERANCE_US)
    return period_us if regular else None
