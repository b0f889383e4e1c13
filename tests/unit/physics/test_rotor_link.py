"""Goal: of the words between spindle and housing none is lost unnoticed (A17), few lie.

Method: link and receiver alone. Rates from thesis_checks I-21 and I-30 and the binomial law.
"""

import math
from typing import Any

import pytest
from sim_device.firmware.python._native import ffi, lib

WORDS_PER_S = 500
BURST = {"burst_share": 1.0, "burst_bit_error_rate": 0.5, "burst_words": 4.0}


class Link:
    def __init__(self, seed: int = 1, **changes: float) -> None:
        bike = ffi.new("physics_config *")
        lib.physics_default(bike)
        self.config: Any = ffi.new("rotor_link_config *", bike.link)
        for name, value in changes.items():
            setattr(self.config, name, value)
        self.state: Any = ffi.new("rotor_link_state *")
        lib.rotor_link_reset(self.state, 20)
        lib.rotor_link_seed(self.state, seed)
        self.receiver: Any = ffi.new("rotor_receiver *")
        lib.rotor_receiver_init(self.receiver, 20)
        self.angle_deg = 0.0

    def run(self, words: int, counts: int = 2448, lost: int = 0, turn_per_s: float = 1.0) -> None:
        for _ in range(words):
            self.angle_deg = (self.angle_deg + 360.0 * turn_per_s / WORDS_PER_S) % 360.0
            lib.rotor_link_exchange(self.config, self.state, counts, 21, self.angle_deg, lost)
            state = self.state
            lib.rotor_receiver_exchange(self.receiver, state.present, state.word)

    @property
    def undetected(self) -> int:
        return int(self.state.words_damaged) - int(self.receiver.words_bad)


def test_a_word_carries_torque_temperature_sequence_and_check() -> None:
    word = lib.rotor_link_word(-2, -7, 9)

    assert word >> 16 == 0xFFFE
    assert word >> 8 & 0xFF == 0xF9
    assert word >> 4 & 0xF == 9
    assert lib.rotor_word_is_sound(word)


@pytest.mark.parametrize("silence", [0x00000000, 0xFFFFFFFF])
def test_a_dead_line_is_no_word(silence: int) -> None:
    assert not lib.rotor_word_is_sound(silence)


def test_every_single_wrong_bit_is_noticed() -> None:
    word = lib.rotor_link_word(2448, 21, 5)

    assert not any(lib.rotor_word_is_sound(word ^ 1 << bit) for bit in range(32))


def test_of_random_words_one_in_sixteen_passes_the_check() -> None:
    passed = sum(lib.rotor_word_is_sound((k * 2654435761) & 0xFFFFFFFF) for k in range(32_000))

    assert passed / 32_000 == pytest.approx(1 / 16, rel=0.05)


def test_500_words_a_second_are_100_readings_10_ms_apart() -> None:
    link = Link()
    ages = []

    for _ in range(50):
        link.run(1)
        ages.append(link.receiver.age_ms)

    assert ages[4::5] == [2] * 10
    assert max(ages[5:]) == 10
    assert link.receiver.torque_raw_counts == 2448
    assert link.receiver.temperature_degc == 21


def test_a17_without_bit_errors_no_word_of_two_hours_is_lost() -> None:
    # 3.6 million words: the whole ride is scenario field_ride; here a tenth of it.
    link = Link()

    link.run(360_000)

    assert link.state.words_damaged == 0
    assert (link.receiver.words_bad, link.receiver.words_lost) == (0, 0)
    assert link.receiver.words_good == 360_000


@pytest.mark.slow
def test_a17_one_bit_in_a_hundred_thousand_spoils_sixteen_words_in_a_hundred_seconds() -> None:
    # p = 1 - (1 - 1e-5)^32 of 500 words: 0.16 a second, +- 20 % over 1,200 s.
    link = Link(bit_error_rate=1e-5)

    link.run(600_000)

    bad_per_s = link.receiver.words_bad / 1200
    assert bad_per_s == pytest.approx(0.16, rel=0.20)
    # Nearly all have one wrong bit, which the check never misses.
    assert link.receiver.words_bad >= link.state.words_damaged * 15 / 16


def test_the_gaps_between_errors_follow_the_rate() -> None:
    link = Link(3, bit_error_rate=1e-3)

    link.run(100_000)

    expected = 100_000 * -math.expm1(32 * math.log1p(-1e-3))
    assert link.state.words_damaged == pytest.approx(expected, rel=0.05)


def test_bursts_come_once_a_turn_and_the_check_catches_fifteen_in_sixteen() -> None:
    link = Link(5, **BURST)

    link.run(250_000)

    turns = 250_000 / WORDS_PER_S
    assert link.state.words_damaged / turns == pytest.approx(4.0, rel=0.15)
    # The sequence number catches most of what the check lets pass.
    assert 0 <= link.undetected <= link.state.words_damaged / 16


def test_the_median_hides_a_word_that_lied() -> None:
    link = Link()
    link.run(5)

    forged = lib.rotor_link_word(30_000, 21, int(link.receiver.sequence))
    lib.rotor_receiver_exchange(link.receiver, 1, forged)
    link.run(4)

    assert link.receiver.torque_raw_counts == 2448


def test_below_the_coupling_threshold_the_rotor_is_silent_and_the_reading_grows_old() -> None:
    link = Link()
    link.run(10)

    link.config.coupling = 0.2
    link.run(50)
    silent_age_ms = link.receiver.age_ms
    link.config.coupling = 1.0
    link.run(30)

    assert 90 <= silent_age_ms <= 110
    # One word was still on its way; the rotor needs 20 ms to start again.
    assert link.receiver.words_lost == pytest.approx(49 + 10, abs=2)
    assert link.receiver.age_ms <= 10
    assert link.receiver.words_bad <= 1


def test_a_rotor_that_started_anew_costs_one_word() -> None:
    link = Link()
    link.run(12)

    link.run(20, lost=1)
    link.run(100)

    assert link.receiver.words_bad <= 1
    assert link.receiver.torque_raw_counts == 2448


def test_a_reading_is_told_as_it_came_however_warm_the_sensor() -> None:
    link = Link()

    link.run(10, counts=2451)
    assert (link.receiver.torque_raw_counts, link.receiver.temperature_degc) == (2451, 21)

    link.run(10, counts=32767)
    assert link.receiver.torque_raw_counts == 32767
