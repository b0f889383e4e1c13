"""Goal: a ride's card tells its speed and its ends as they were, and invents none.

Method: rides whose answers follow from how they are made; no output of the code is copied here.
"""

from __future__ import annotations

import numpy as np
import pytest

from backend.core.channels import Values
from backend.core.ride_card import LINE_POINTS, ends_of, line_kmh, speed_line
from backend.core.sphere import great_circle_m


def seconds(count: int) -> Values:
    return np.arange(count, dtype=np.float64)


def test_a_line_is_the_mean_of_equal_times() -> None:
    speed = np.repeat([10.0, 30.0], 320)

    line = line_kmh(speed_line(seconds(640), speed))

    assert line == (10.0,) * 32 + (30.0,) * 32


def test_a_pause_is_a_hole_in_the_line_and_no_standstill() -> None:
    times_s = np.concatenate([seconds(320), seconds(320) + 640.0])

    line = line_kmh(speed_line(times_s, np.full(640, 20.0)))

    assert len(line) == LINE_POINTS
    assert line[:21] == (20.0,) * 21
    assert line[22:42] == (None,) * 20


def test_no_speed_has_no_line() -> None:
    assert speed_line(seconds(9), None) == b""
    assert speed_line(seconds(9), np.full(9, np.nan)) == b""


def test_distance_on_the_globe_is_a_quarter_to_the_pole() -> None:
    (metres,) = great_circle_m(0.0, 0.0, np.array([90.0]), np.array([0.0]))

    assert metres == pytest.approx(np.pi / 2 * 6_371_008.8)


def test_a_loop_comes_back_and_a_walk_round_the_house_is_none() -> None:
    angle = np.linspace(0.0, 2 * np.pi, 400)
    far = ends_of(53.0 + 0.02 * np.cos(angle), -6.0 + 0.02 * np.sin(angle))
    near = ends_of(53.0 + 0.001 * np.cos(angle), -6.0 + 0.001 * np.sin(angle))
    away = ends_of(np.linspace(53.0, 53.1, 400), np.full(400, -6.0))

    assert far[1] is True
    assert near[1] is False
    assert away[1] is False
    assert ends_of(np.full(3, np.nan), np.full(3, np.nan)) == (None, None)
