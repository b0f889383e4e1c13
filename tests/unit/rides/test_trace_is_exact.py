"""Goal: a trace shows the exact extremes of every bin, at any zoom, and never joins over a gap.

Method: numpy over the whole raw array is the oracle, for random windows and widths; one planted
sample must be seen at every zoom. The ride is held by a plain reader, without the store.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from backend.core.breaks import Mask, find_breaks
from backend.core.channels import MISSING_INT16, MISSING_INT32, ChannelSpec, Counts, Values
from backend.core.energy import sample_seconds
from backend.core.pyramid import STEPS, Level, first_level
from backend.errors import InvalidRequest
from backend.rides.traces.figure import figure
from backend.rides.traces.trace import Trace, trace

TORQUE = ChannelSpec("rider_torque_nm", "Nm", 0.01)
DISTANCE = ChannelSpec("distance_m", "m", 0.01, wide=True)
PERIOD_US = 10_000
ROWS = 300_000


class PlainReader:
    """A ride in memory, with or without a pyramid."""

    def __init__(
        self, counts: dict[ChannelSpec, Counts], times_us: npt.NDArray[np.int64] | None = None
    ) -> None:
        self._counts = {channel.name: values for channel, values in counts.items()}
        self._times = times_us
        self.offered: Sequence[ChannelSpec] = tuple(counts)
        self.row_count = len(next(iter(counts.values())))
        self.period_us = PERIOD_US if times_us is None else None

    def times_us(self, start: int, stop: int) -> npt.NDArray[np.int64]:
        if self._times is None:
            return np.arange(start, stop, dtype=np.int64) * PERIOD_US
        return self._times[start:stop]

    def counts(self, names: Sequence[str], start: int, stop: int) -> dict[str, Counts]:
        return {name: self._counts[name][start:stop] for name in names}

    def values(self, names: Sequence[str]) -> dict[str, Values]:
        known = {channel.name: channel for channel in self.offered}
        return {n: known[n].to_values(self._counts[n]) for n in names if n in known}

    def row_seconds(self) -> Values:
        return sample_seconds(self.times_us(0, self.row_count), self.breaks())

    def breaks(self) -> Mask:
        return find_breaks({}, self.times_us(0, self.row_count))

    def level(self, rows_per_bin: int) -> Level | None:
        steps = [step for step in STEPS if step <= rows_per_bin]
        if not steps:
            return None
        pairs = {name: first_level(values, steps[-1]) for name, values in self._counts.items()}
        return Level(
            steps[-1],
            tuple(self.offered),
            {name: pair[0] for name, pair in pairs.items()},
            {name: pair[1] for name, pair in pairs.items()},
        )


def ridden_counts() -> Counts:
    rng = np.random.default_rng(7)
    counts = np.cumsum(rng.integers(-9, 10, ROWS)).astype(np.int16)
    counts[40_000:40_700] = MISSING_INT16
    counts[rng.integers(0, ROWS, 2_000)] = MISSING_INT16
    return counts


COUNTS = ridden_counts()
RIDE = PlainReader({TORQUE: COUNTS})


def oracle(counts: Counts, missing: int) -> tuple[int, int]:
    there = counts[counts != missing]
    return (int(there.min()), int(there.max())) if len(there) else (missing, missing)


def rows_of_bins(shown: Trace) -> list[tuple[int, int]]:
    first = np.rint(shown.t_first_s * 1e6 / PERIOD_US).astype(int)
    last = np.rint(shown.t_last_s * 1e6 / PERIOD_US).astype(int)
    return list(zip(first.tolist(), (last + 1).tolist(), strict=True))


@settings(max_examples=120, deadline=None)
@given(
    ends=st.tuples(st.integers(0, ROWS), st.integers(0, ROWS)).map(sorted),
    pixels=st.integers(1, 3000),
)
@pytest.mark.slow
def test_every_bin_has_exactly_the_extremes_of_its_rows(ends: list[int], pixels: int) -> None:
    from_s, to_s = (end * PERIOD_US / 1e6 for end in ends)

    shown = trace(RIDE, None, from_s, to_s, pixels)

    bins = rows_of_bins(shown)
    found = list(
        zip(shown.minimum[TORQUE.name].tolist(), shown.maximum[TORQUE.name].tolist(), strict=True)
    )
    assert found == [oracle(COUNTS[first:stop], MISSING_INT16) for first, stop in bins]


@settings(max_examples=120, deadline=None)
@given(
    ends=st.tuples(st.integers(0, ROWS - 1), st.integers(0, ROWS - 1)).map(sorted),
    pixels=st.integers(1, 3000),
)
def test_the_bins_cover_the_window_once_and_fit_the_screen(ends: list[int], pixels: int) -> None:
    start, last = ends

    shown = trace(RIDE, None, start * PERIOD_US / 1e6, last * PERIOD_US / 1e6, pixels)

    bins = rows_of_bins(shown)
    per_bin = max(stop - first for first, stop in bins)
    assert bins[0][0] <= start < bins[0][0] + per_bin
    assert bins[-1][1] - per_bin <= last < bins[-1][1]
    assert all(left[1] == right[0] for left, right in pairwise(bins))
    assert len(bins) <= pixels + 1
    assert shown.rows == bins[-1][1] - bins[0][0]


@pytest.mark.parametrize("pixels", [1, 10, 300, 1000, 2000, 5000])
def test_one_planted_sample_is_seen_at_every_zoom(pixels: int) -> None:
    counts = np.zeros(ROWS, np.int16)
    counts[123_457] = 9_500
    ride = PlainReader({TORQUE: counts})

    for width_s in (1.0, 30.0, 300.0, 3000.0):
        shown = trace(ride, None, 1234.57 - width_s / 2, 1234.57 + width_s / 2, pixels)

        peak = int(np.argmax(shown.maximum[TORQUE.name]))
        assert shown.maximum[TORQUE.name][peak] == 9_500
        assert shown.t_first_s[peak] <= 1234.57 <= shown.t_last_s[peak]


def test_a_window_of_few_rows_shows_each_of_them() -> None:
    shown = trace(RIDE, None, 10.0, 15.0, 1000)

    assert shown.kind == "rows"
    assert shown.t_first_s.tolist() == pytest.approx(np.arange(1000, 1501) / 100)
    assert shown.minimum[TORQUE.name].tolist() == COUNTS[1000:1501].tolist()


def test_a_lost_stretch_is_missing_at_every_zoom_it_is_wider_than() -> None:
    for pixels in (2000, 500):
        shown = trace(RIDE, None, 390.0, 420.0, pixels)

        middle = int(np.searchsorted(shown.t_first_s, 403.5)) - 1
        assert shown.minimum[TORQUE.name][middle] == MISSING_INT16
        assert shown.maximum[TORQUE.name][middle] == MISSING_INT16


def irregular_ride() -> tuple[PlainReader, npt.NDArray[np.int64], Counts]:
    """A head unit's ride: rows 1 to 6 s apart, and a pause of half an hour."""
    rng = np.random.default_rng(3)
    spacing_us = rng.integers(1, 7, 9_000) * 1_000_000
    spacing_us[4_000] = 1_800_000_000
    times = np.cumsum(spacing_us) - spacing_us[0]
    counts = rng.integers(-30_000, 30_000, 9_000).astype(np.int32)
    return PlainReader({DISTANCE: counts}, times), times, counts


@pytest.mark.parametrize("pixels", [10_000, 1000, 77, 1])
@pytest.mark.slow
def test_irregular_rows_are_binned_by_time_and_cut_at_pauses(pixels: int) -> None:
    ride, times, counts = irregular_ride()

    shown = trace(ride, pixels=pixels)

    low = shown.minimum[DISTANCE.name]
    breaks = np.flatnonzero(low == MISSING_INT32)
    assert len(breaks) == 1
    assert times[3_999] < shown.t_first_s[breaks[0]] * 1e6 < times[4_000]
    for index in np.flatnonzero(low != MISSING_INT32):
        inside = (times >= shown.t_first_s[index] * 1e6 - 0.5) & (
            times <= shown.t_last_s[index] * 1e6 + 0.5
        )
        assert low[index] == counts[inside].min()
        assert shown.maximum[DISTANCE.name][index] == counts[inside].max()


def test_the_binary_form_is_what_its_description_says() -> None:
    rng = np.random.default_rng(5)
    wide = rng.integers(-(10**9), 10**9, 20_000).astype(np.int32)
    narrow = rng.integers(-999, 999, 20_000).astype(np.int16)
    shown = trace(PlainReader({DISTANCE: wide, TORQUE: narrow}), pixels=333)

    blob = shown.to_bytes()

    assert blob[:4] == b"SPV1"
    (length,) = struct.unpack_from("<I", blob, 4)
    assert (8 + length) % 8 == 0
    header = json.loads(blob[8 : 8 + length])
    body = 8 + length

    def array(dtype: str, offset: int) -> list[float]:
        kind = np.dtype(dtype).newbyteorder("<")
        assert offset % 8 == 0
        values: list[float] = np.frombuffer(blob, kind, header["bins"], body + offset).tolist()
        return values

    assert array("float64", header["t_first_s"]["offset"]) == shown.t_first_s.tolist()
    assert array("float64", header["t_last_s"]["offset"]) == shown.t_last_s.tolist()
    for entry in header["channels"]:
        low = array(entry["dtype"], entry["min_offset"])
        assert low == shown.minimum[entry["name"]].tolist()
        high = array(entry["dtype"], entry["max_offset"])
        assert high == shown.maximum[entry["name"]].tolist()
    assert [entry["missing"] for entry in header["channels"]] == [MISSING_INT32, MISSING_INT16]


def test_missing_is_null_in_json_and_never_zero() -> None:
    shown = trace(RIDE, None, 400.0, 406.9, 1000).to_json()

    text = json.dumps(shown)
    channels = json.loads(text)["channels"]
    assert channels[0]["min"] == [None] * 691


def test_an_unknown_channel_is_refused_with_the_ones_there_are() -> None:
    with pytest.raises(InvalidRequest, match="rider_torque_nm"):
        trace(RIDE, ["heart_rate_bpm"])
    with pytest.raises(InvalidRequest):
        trace(RIDE, None, 5.0, 4.0)
    with pytest.raises(InvalidRequest):
        trace(RIDE, None, float("nan"))
    with pytest.raises(InvalidRequest):
        trace(RIDE, pixels=0)


@pytest.mark.parametrize(
    ("question", "field", "code"),
    [
        ({"names": ["heart_rate_bpm"]}, "channels", "unknown_channel"),
        ({"pixels": 0}, "px", "out_of_range"),
        ({"from_s": 2.0, "to_s": 1.0}, "to_s", "empty_window"),
        ({"from_s": 1e9}, "from_s", "empty_window"),
    ],
)
def test_a_refused_question_names_its_field(
    question: dict[str, Any], field: str, code: str
) -> None:
    with pytest.raises(InvalidRequest) as caught:
        trace(RIDE, **question)

    assert [(fault.field, fault.code) for fault in caught.value.fields] == [(field, code)]


def test_a_ride_without_rows_has_an_empty_trace() -> None:
    empty = PlainReader({TORQUE: np.empty(0, np.int16)})

    assert trace(empty).to_json()["bins"] == 0


@pytest.mark.slow
def test_the_figure_draws_every_extreme_and_leaves_gaps_open() -> None:
    drawn = figure(RIDE, None, 1500)

    (curve,) = drawn.data
    assert curve.name == "rider_torque_nm"
    assert None in curve.y
    assert curve.connectgaps is False
    assert drawn.layout.meta["shown"].endswith("(min/max)")
    assert isinstance(drawn.to_plotly_json()["data"][0]["y"], list | tuple), "no base64"


@pytest.mark.slow
def test_the_figures_titles_are_in_the_language_that_is_asked_for() -> None:
    english, chinese = (figure(RIDE, None, 500, language) for language in ("en", "zh"))

    assert english.layout.yaxis.title.text == "Torque at the crank (Nm)"
    assert chinese.layout.yaxis.title.text == "曲柄力矩 (Nm)"
    assert chinese.layout.xaxis.title.text == "时间 (s)"
    # What programs go by stays.
    assert [curve.name for curve in chinese.data] == [curve.name for curve in english.data]
