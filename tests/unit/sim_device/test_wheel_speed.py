"""Goal: the number that every cut-off rests on is made of pulses, and of nothing else.

Method: pulses of a wheel that is known exactly, to the unit's own C, looked at every 10 ms as the
control step does. Numbers are kinematics: 25 km/h are 6.944 m/s, and a wheel of 2.0735 m with 36
pulses gives one each 57.6 mm.
"""

from collections.abc import Callable, Iterable

import numpy as np
import pytest
from sim_device.firmware.python._native import ffi, lib

CIRCUMFERENCE_M = 2.073451
STEP_US = 10_000
KMH_PER_MS = 3.6
BOUNDS_KMH = 0.005


class Wheel:
    """The unit's reading of pulses at given times in microseconds."""

    def __init__(self, pulses_per_turn: int = 36, count: int = 0, now_us: int = 0) -> None:
        self.state = ffi.new("wheel_speed *")
        lib.wheel_speed_init(self.state)
        self.pulse_m = np.float32(CIRCUMFERENCE_M / pulses_per_turn)
        self.count = count
        self.now_us = now_us
        self.way_m = 0.0
        lib.wheel_speed_pulses(self.state, self.pulse_m, count, 0)

    def looks(self, times_us: Iterable[float], until_us: int) -> list[tuple[int, float]]:
        """What it reads in each control step until then: (time, km/h)."""
        waiting = [round(t) for t in times_us]
        latest = self.now_us
        seen = []
        while self.now_us < until_us:
            self.now_us += STEP_US
            while waiting and waiting[0] <= self.now_us:
                latest = waiting.pop(0)
                self.count = (self.count + 1) % 2**32
            self.way_m += lib.wheel_speed_pulses(self.state, self.pulse_m, self.count, latest)
            seen.append((self.now_us, self.kmh(self.now_us)))
        return seen

    def kmh(self, now_us: int) -> float:
        return float(lib.wheel_speed_kmh(self.state, self.pulse_m, now_us))

    def times(self, speed_kmh: float, from_us: int, until_us: int) -> list[float]:
        """Of the pulses of a wheel at one speed."""
        period_us = float(self.pulse_m) * KMH_PER_MS / speed_kmh * 1e6
        return list(np.arange(from_us, until_us, period_us))


@pytest.mark.parametrize("pulses", [1, 6, 36, 100])
@pytest.mark.parametrize("speed_kmh", [4.0, 12.0, 25.0, 45.0])
def test_an_even_wheel_reads_its_speed(pulses: int, speed_kmh: float) -> None:
    wheel = Wheel(pulses)

    seen = wheel.looks(wheel.times(speed_kmh, 0, 6_000_000), 6_000_000)

    late = [kmh for t, kmh in seen if t > 4_000_000]
    assert late == pytest.approx([speed_kmh] * len(late), abs=BOUNDS_KMH)


def test_the_reading_scales_with_the_circumference_that_the_unit_has() -> None:
    wheel = Wheel()
    times = wheel.times(25.0, 0, 2_000_000)
    wheel.pulse_m = np.float32(wheel.pulse_m * 0.96)

    assert wheel.looks(times, 2_000_000)[-1][1] == pytest.approx(24.0, abs=BOUNDS_KMH)


def test_nothing_is_known_before_two_pulses() -> None:
    wheel = Wheel(1)

    assert [kmh for _, kmh in wheel.looks([500_000], 1_000_000)] == [0.0] * 100


def test_while_no_pulse_comes_it_never_reads_more_than_one_would_give_now() -> None:
    wheel = Wheel()
    wheel.looks(wheel.times(25.0, 0, 1_000_000), 1_000_000)
    last_us = max(wheel.times(25.0, 0, 1_000_000))

    for now_us, kmh in wheel.looks([], 2_900_000):
        given_now = float(wheel.pulse_m) / ((now_us - last_us) * 1e-6) * KMH_PER_MS
        assert 0.0 < kmh <= given_now * 1.001


def test_it_is_zero_two_seconds_after_the_last_pulse() -> None:
    wheel = Wheel()
    wheel.looks(wheel.times(25.0, 0, 1_000_000), 1_000_000)
    last_us = max(wheel.times(25.0, 0, 1_000_000))

    assert wheel.kmh(round(last_us) + 1_999_000) > 0.0
    assert wheel.kmh(round(last_us) + 2_000_001) == 0.0
    assert wheel.kmh(round(last_us) + 3_600_000_000) == 0.0


def test_a_count_and_a_clock_that_wrap_change_nothing() -> None:
    plain, wrapping = Wheel(), Wheel(count=2**32 - 20)

    one = plain.looks(plain.times(20.0, 0, 1_000_000), 1_000_000)
    other = wrapping.looks(wrapping.times(20.0, 0, 1_000_000), 1_000_000)

    assert one == other
    assert plain.way_m == wrapping.way_m


def test_a_bounce_is_no_pulse_and_no_way() -> None:
    wheel = Wheel(6)
    times = wheel.times(15.0, 0, 3_000_000)
    bounced = sorted([*times, times[20] + 700.0])

    seen = wheel.looks(bounced, 3_000_000)

    late = [kmh for t, kmh in seen if t > 1_000_000]
    # Looked at together with its pulse it makes two of one, until the next: too fast, never slow.
    assert min(late) >= 15.0 - 0.02
    assert sum(kmh > 15.5 for kmh in late) <= 9
    assert wheel.way_m == pytest.approx(15.0 / KMH_PER_MS * 3.0, abs=2 * float(wheel.pulse_m))


def test_pulses_that_keep_coming_too_fast_are_told_and_not_taken_for_bounces() -> None:
    wheel = Wheel()
    wheel.looks(wheel.times(20.0, 0, 1_000_000), 1_000_000)

    disturbed = wheel.looks(list(np.arange(1_000_100, 1_200_000, 100.0)), 1_200_000)

    # 10 kHz are 576 m/s; what is over 150 km/h is SPEED_SENSOR.
    assert all(kmh > 150.0 for _, kmh in disturbed[1:])
    # In the first look they might be bounces, and the pulse that is due has not been seen.
    assert all(kmh > 12.0 for _, kmh in disturbed)


@pytest.mark.parametrize(("pulses", "dip_s"), [(36, 0.02), (6, 0.06)])
def test_a_missed_pulse_is_added_where_no_brake_explains_the_gap(pulses: int, dip_s: float) -> None:
    wheel = Wheel(pulses)
    times = wheel.times(25.0, 0, 3_000_000)
    missed = len(times) // 2

    seen = wheel.looks([t for k, t in enumerate(times) if k != missed], 3_000_000)

    low = [kmh for t, kmh in seen if t > 1_000_000 and kmh < 25.0 - 0.05]
    assert len(low) * STEP_US <= dip_s * 1e6
    assert all(kmh >= 12.4 for kmh in low)
    assert wheel.way_m == pytest.approx(25.0 / KMH_PER_MS * 3.0, abs=2 * float(wheel.pulse_m))


def test_a_braking_wheel_is_believed() -> None:
    # 8 m/s2, from 25 km/h to rest.
    wheel = Wheel()
    way = np.arange(0, 60) * float(wheel.pulse_m)
    v0 = 25.0 / KMH_PER_MS
    stops_m = v0**2 / 16.0
    times = wheel.times(25.0, 0, 1_000_000)
    braked = list((v0 - np.sqrt(v0**2 - 16.0 * way[way < stops_m])) / 8.0)
    begin = times[-1]

    seen = wheel.looks([*times, *(begin + t * 1e6 for t in braked[1:])], 2_500_000)

    for t, kmh in seen:
        since_s = (t - begin) * 1e-6
        if 0.0 < since_s < 0.8:
            true_kmh = max(0.0, (v0 - 8.0 * since_s) * KMH_PER_MS)
            assert kmh <= true_kmh + 8.0 * 0.07 * KMH_PER_MS + 0.6


def at_an_even_gain(gain_ms2: float) -> Callable[[float], float]:
    """Way in metres -> time in seconds, from rest."""
    return lambda way_m: float(np.sqrt(2.0 * way_m / gain_ms2))


@pytest.mark.parametrize(("pulses", "late_kmh"), [(36, 0.25), (6, 0.38), (1, 2.1)])
def test_lateness_of_a_bike_that_gains_a_metre_per_second_each_second(
    pulses: int, late_kmh: float
) -> None:
    # Half the window, or half the way between two pulses where that is longer, then the pulse that
    # is awaited and a control step: 0.045, 0.105 and 0.58 s at 20 km/h.
    wheel = Wheel(pulses)
    time_of = at_an_even_gain(1.0)
    times = [time_of(k * float(wheel.pulse_m)) * 1e6 for k in range(1, 60 * pulses)]

    seen = wheel.looks(times, 7_500_000)

    late = [t * 1e-6 * KMH_PER_MS - kmh for t, kmh in seen if t > 5_500_000]
    assert max(late) < late_kmh
    assert min(late) > -0.02
