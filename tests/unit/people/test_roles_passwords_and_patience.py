"""Goal: roles are sets of permissions, passwords follow NIST SP 800-63B, and wrong ones wait.

Method: the sets compared; passwords of the standard's own kinds; a throttle with a clock of ours.
"""

from __future__ import annotations

import pytest

from backend.core.author import SignedInName, proof_of, tidy_author
from backend.core.person import ROLES, Permission
from backend.people.passwords import COMMON, PASSWORD_LENGTH_MAX, PASSWORD_LENGTH_MIN, fault_of
from backend.people.throttle import FORGET_S, KEYS_MAX, WAIT_MAX_S, Throttle


def test_each_role_has_all_of_the_one_before_it_and_an_admin_everything() -> None:
    rider, dealer, engineer, admin = ROLES.values()

    assert rider < dealer < engineer < admin
    assert admin == frozenset(Permission)


def test_a_rider_has_no_permission_that_goes_beyond_what_is_theirs() -> None:
    """Bikes, rides and files can be somebody's; units, the library and the server cannot."""
    of_the_workshop = {"see_bikes", "change_bikes", "calibrate", "see_library", "change_library"}

    assert not ROLES["rider"] & (of_the_workshop | {"see_server", "back_up", "manage_people"})


@pytest.mark.parametrize(
    "password",
    [
        "correct horse battery staple",
        "eine lange Nacht",
        "骑行骑行扭矩传感",
        "zq8!kdwp",
        " a b c d ",
    ],
)
def test_any_long_enough_password_is_taken_whatever_it_is_made_of(password: str) -> None:
    assert fault_of(password, "Anna") is None


@pytest.mark.parametrize(
    ("password", "code"),
    [
        ("seven77", "too_short"),
        ("PASSWORD1", "too_common"),
        ("12345678", "too_common"),
        ("pass\uff57ord", "too_common"),  # A full-width letter looks the same and is the same.
        ("aaaaaaaaaaaa", "too_common"),
        ("anna müller", "is_the_name"),
        ("x" * PASSWORD_LENGTH_MAX + "yz", "too_long"),
    ],
)
def test_a_password_that_is_guessed_first_is_not_taken(password: str, code: str) -> None:
    fault = fault_of(password, "Anna Müller")

    assert fault is not None
    assert fault[0] == code


def test_the_list_of_common_ones_holds_only_what_is_long_enough() -> None:
    assert min(len(word) for word in COMMON) >= PASSWORD_LENGTH_MIN
    assert all(word == word.casefold() for word in COMMON)


def test_some_wrong_passwords_are_free_and_each_after_them_waits_twice_as_long() -> None:
    throttle = Throttle(free=3)
    now_s, waits = 0.0, []
    for _ in range(8):
        throttle.count("anna", now_s)
        waits.append(throttle.wait_s("anna", now_s))
        now_s += waits[-1]

    assert waits == [0, 0, 1, 2, 4, 8, 16, 32]


def test_no_wait_is_longer_than_a_quarter_of_an_hour() -> None:
    throttle = Throttle(free=1)
    for turn in range(100):
        throttle.count("anna", float(turn))

    assert throttle.wait_s("anna", 99.0) == WAIT_MAX_S == 900.0


def test_the_right_password_forgets_the_wrong_ones_of_its_name_alone() -> None:
    throttle = Throttle(free=1)
    throttle.count("anna", 0.0)
    throttle.count("bruno", 0.0)

    throttle.forget("anna")

    assert throttle.wait_s("anna", 0.0) == 0.0
    assert throttle.wait_s("bruno", 0.0) == 1.0


def test_a_right_one_does_not_clear_its_address_of_the_wrong_ones_before() -> None:
    throttle = Throttle(free=3)
    for _ in range(3):
        throttle.count("10.0.0.9", 0.0)
    throttle.take_back("10.0.0.9")
    throttle.count("10.0.0.9", 1.0)

    assert throttle.wait_s("10.0.0.9", 1.0) == 1.0


def test_who_was_left_alone_for_an_hour_begins_anew() -> None:
    throttle = Throttle(free=1)
    for turn in range(10):
        throttle.count("anna", float(turn))

    assert throttle.wait_s("anna", 9.0) > 500.0
    throttle.count("anna", 10.0 + FORGET_S)
    assert throttle.wait_s("anna", 10.0 + FORGET_S) == 1.0


def test_strangers_cannot_fill_the_memory_with_names() -> None:
    throttle = Throttle(free=1)
    for number in range(KEYS_MAX + 1):
        throttle.count(f"name {number}", 0.0)

    assert throttle.wait_s("name 0", 0.0) == 0.0
    assert throttle.wait_s(f"name {KEYS_MAX}", 0.0) == 1.0


def test_an_author_carries_how_it_is_known() -> None:
    assert proof_of(SignedInName("Anna")) == "signed_in"
    assert proof_of("Anna") == "stated"
    assert proof_of(tidy_author("")) is None
