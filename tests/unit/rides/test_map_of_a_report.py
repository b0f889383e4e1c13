"""Goal: the map of a report is true to the ground: shape, scale, kilometres, modes and gaps.

Method: tracks whose lengths are known by the earth's circumference (40,030 km at 6371 km radius).
"""

from __future__ import annotations

import re

import numpy as np
import pytest

from backend.core.ride_events import RideEvent
from backend.rides.report.track_map import (
    LOOKS,
    UNKNOWN,
    laid_out,
    rounded_down,
    rounded_up,
    segments_of,
    track_map,
)
from backend.rides.report.words import EN, ZH
from backend.rides.traces.track import Track

KM_DEG = 360.0 / 40_030.0


def to_the_north(km: float, latitude_deg: float = 48.0) -> Track:
    """A straight way, a point every 10 m and every second."""
    steps = np.arange(round(100 * km) + 1, dtype=np.float64)
    return Track(
        t_s=steps,
        moving_s=None,
        distance_m=10.0 * steps,
        latitude_deg=latitude_deg + steps * KM_DEG / 100.0,
        longitude_deg=np.full(len(steps), 11.5),
    )


def test_a_square_of_ground_is_a_square_north_up() -> None:
    # At 60 degrees a degree of longitude is half as long as one of latitude.
    corners = [(60.0, 10.0), (60.01, 10.0), (60.01, 10.02), (60.0, 10.02)]
    latitudes, longitudes = (np.array(side) for side in zip(*corners, strict=True))

    drawn = laid_out(Track(np.arange(4.0), None, None, latitudes, longitudes))

    assert drawn is not None
    assert drawn.y[1] < drawn.y[0]
    assert (drawn.x[2] - drawn.x[1]) / (drawn.y[0] - drawn.y[1]) == pytest.approx(1.0, rel=1e-3)
    # 0.01 degree is 1112 m.
    assert drawn.m_per_px * (drawn.y[0] - drawn.y[1]) == pytest.approx(1112.0, abs=0.5)


def test_the_scale_and_the_marks_are_round_lengths_of_the_way() -> None:
    track = to_the_north(6.0)
    drawn = laid_out(track)
    assert drawn is not None
    text = track_map(track, (), {}, EN)

    marks = re.findall(r'<circle cx="\S+" cy="(\S+)".*?middle">([\d.]+)</text>', text)
    assert [told for _, told in marks] == ["1", "2", "3", "4", "5"]
    for y, told in marks:
        way_m = (drawn.y[0] - float(y)) * drawn.m_per_px
        assert way_m == pytest.approx(1000.0 * float(told), abs=drawn.m_per_px)
    scale_px = float(re.findall(r"m0 4h(\S+)m", text)[0])
    assert ">2 km<" in text
    assert scale_px * drawn.m_per_px == pytest.approx(2000.0, rel=1e-2)


def test_modes_are_told_by_dash_and_width_and_change_where_they_changed() -> None:
    track = to_the_north(1.0)
    drawn = laid_out(track)
    assert drawn is not None
    events = (RideEvent(25.5, "assist_mode", 3), RideEvent(75.0, "assist_mode", 1))

    pieces = segments_of(drawn, [(25.5, 3), (75.0, 1)])

    assert [mode for mode, _ in pieces] == [None, 3, 1]
    share = (drawn.y[0] - pieces[0][1][-1][1]) / (drawn.y[0] - drawn.y[-1])
    assert share == pytest.approx(0.255)
    # One goes on where the other ends.
    assert pieces[0][1][-1] == pieces[1][1][0]
    assert len({(dash, width) for _, dash, width in (*LOOKS, UNKNOWN)}) >= len(LOOKS)
    text = track_map(track, events, {3: "<b>sport"}, ZH)
    assert f'stroke-dasharray="{LOOKS[1][1]}"' in text
    assert "&lt;b&gt;sport" in text
    assert "模式 1" in text
    assert "起点" in text


def test_no_line_is_drawn_over_a_gap() -> None:
    track = to_the_north(1.0)
    track.latitude_deg[40:60] = np.nan  # type: ignore[index]
    drawn = laid_out(track)
    assert drawn is not None

    # Also not where the mode changed within it.
    pieces = segments_of(drawn, [(50.0, 2)])

    assert [(mode, len(spots)) for mode, spots in pieces] == [(None, 40), (2, 41)]
    assert drawn.at(50.0) is None


def test_a_ride_over_the_antimeridian_is_as_long_as_elsewhere() -> None:
    steps = np.linspace(-0.01, 0.01, 21)
    there, here = (
        laid_out(
            Track(np.arange(21.0), None, None, np.zeros(21), (middle + steps + 180) % 360 - 180)
        )
        for middle in (180.0, 0.0)
    )

    assert there is not None
    assert here is not None
    assert there.m_per_px == pytest.approx(here.m_per_px)


def test_without_positions_there_is_no_map() -> None:
    nowhere = Track(np.arange(3.0), None, None, None, None)
    once = Track(np.arange(3.0), None, None, np.array([1.0, np.nan, np.nan]), np.full(3, 2.0))

    assert track_map(nowhere, (), {}, EN) == track_map(once, (), {}, EN) == ""


def test_lengths_are_rounded_to_one_two_or_five() -> None:
    assert [rounded_up(km) for km in (0.9, 1.0, 1.1, 3.0, 7.0)] == [1.0, 1.0, 2.0, 5.0, 10.0]
    assert [rounded_down(m) for m in (999.0, 1000.0, 70.0, 0.3)] == [500.0, 1000.0, 50.0, 0.2]
