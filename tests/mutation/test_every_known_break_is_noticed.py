"""Goal: the tests are worth something: every known way to break the codec and the transaction is
noticed by the quick tests named for it.

Method: breaks.toml applied one by one to a copy of the sources, the C compiled anew, the named
tests run until the first fails. About 70 s; `make mutate` prints the list.
"""

from __future__ import annotations

import shutil

import pytest

from tests.mutation.workshop import FAILED, PASSED, Break, Workshop, breaks

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    if shutil.which("cc") is None:
        pytest.skip("no C compiler on this machine")
    return Workshop(tmp_path_factory.mktemp("workshop"))


def test_the_unbroken_copy_passes(workshop: Workshop) -> None:
    named = tuple(sorted({file for one in breaks() for file in one.caught_by}))

    done = workshop.tests(named)

    assert done.returncode == PASSED, done.stdout + done.stderr


@pytest.mark.parametrize("one", breaks(), ids=lambda one: one.name)
def test_a_known_break_is_noticed(workshop: Workshop, one: Break) -> None:
    done = workshop.broken(one)

    who = one.caught_by or ("the simulation",)
    assert done.returncode == FAILED, f"{who} did not notice:\n{done.stdout}{done.stderr}"


def test_there_are_twenty_of_them() -> None:
    assert len({one.name for one in breaks()}) >= 20
