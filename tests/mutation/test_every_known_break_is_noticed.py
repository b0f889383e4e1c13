"""Goal: the tests are worth something: every known way to break the codec and the transaction is
noticed by the quick tests named for it.

Method: breaks.toml applied one by one to a copy of the sources, the C compiled anew, the named
tests run until the first fails. `make test` plants those that are marked `always` there, one in
ten; `make prove` all. `make mutate` prints the list.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests import counts
from tests.fakes.built_once import built_once
from tests.mutation.workshop import FAILED, PASSED, Break, Workshop, breaks

pytestmark = [pytest.mark.slow]

ROOT = Path(__file__).resolve().parents[2]
PLANTED = [one for one in breaks() if one.always or counts.proving()]


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    if shutil.which("cc") is None:
        pytest.skip("no C compiler on this machine")
    made = built_once(tmp_path_factory, "workshop", lambda folder: Workshop(folder).set_up())
    own = tmp_path_factory.mktemp("own") / "workshop"
    return Workshop(shutil.copytree(made, own))


@pytest.mark.large_count
@pytest.mark.parametrize("named", sorted({name for one in PLANTED for name in one.caught_by}))
def test_the_unbroken_copy_passes_in_time(workshop: Workshop, named: str) -> None:
    done = workshop.tests((named,))

    assert done.returncode == PASSED, done.stdout + done.stderr


@pytest.mark.large_count
@pytest.mark.parametrize("one", PLANTED, ids=lambda one: one.name)
def test_a_known_break_is_noticed(workshop: Workshop, one: Break) -> None:
    done = workshop.broken(one)

    who = one.caught_by or ("the simulation",)
    assert done.returncode == FAILED, f"{who} did not notice:\n{done.stdout}{done.stderr}"


@pytest.mark.parametrize("one", breaks(), ids=lambda one: one.name)
def test_what_a_break_names_is_there(one: Break) -> None:
    assert (ROOT / one.file).read_text(encoding="utf-8").count(one.find) == 1
    assert [name for name in one.caught_by if not (ROOT / name.partition("::")[0]).exists()] == []


def test_there_are_twenty_of_them_and_a_tenth_is_always_planted() -> None:
    assert len({one.name for one in breaks()}) >= 20
    assert len([one for one in breaks() if one.always]) >= len(breaks()) // 10
