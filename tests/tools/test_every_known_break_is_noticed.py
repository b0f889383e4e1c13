"""Goal: the tests are worth something: every known way to break the codec and the transaction is
noticed by the quick tests named for it.

Method: breaks.toml applied one by one to a copy of the sources, the C compiled anew, the named
tests run until the first fails. `make prove` plants all, and sees that the named tests pass in time
in a copy that is not broken; `make mutate` prints the list. `make test` sees that an entry still
fits the sources.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from tests.fakes.built_once import built_once
from tools.mutation.workshop import FAILED, PASSED, Break, Workshop, breaks

pytestmark = [pytest.mark.slow]

ROOT = Path(__file__).resolve().parents[2]
NAMED = sorted({name for one in breaks() for name in one.caught_by})


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    if shutil.which("cc") is None:
        pytest.fail("There is no C compiler, which `make setup` asks for.")
    made = built_once(tmp_path_factory, "workshop", lambda folder: Workshop(folder).set_up())
    own = tmp_path_factory.mktemp("own") / "workshop"
    return Workshop(shutil.copytree(made, own))


@pytest.mark.long
@pytest.mark.parametrize("named", NAMED)
def test_the_unbroken_copy_passes_in_time(workshop: Workshop, named: str) -> None:
    done = workshop.tests((named,))

    assert done.returncode == PASSED, done.stdout + done.stderr


@pytest.mark.long
@pytest.mark.parametrize("one", breaks(), ids=lambda one: one.name)
def test_a_known_break_is_noticed(workshop: Workshop, one: Break) -> None:
    done = workshop.broken(one)

    who = one.caught_by or ("the simulation",)
    assert done.returncode == FAILED, f"{who} did not notice:\n{done.stdout}{done.stderr}"


@pytest.mark.parametrize("one", breaks(), ids=lambda one: one.name)
def test_what_a_break_names_is_there(one: Break) -> None:
    assert (ROOT / one.file).read_text(encoding="utf-8").count(one.find) == 1
    assert [name for name in one.caught_by if not (ROOT / name.partition("::")[0]).exists()] == []


def test_there_are_fifty_of_them_in_both_languages() -> None:
    assert len({one.name for one in breaks()}) >= 50
    assert {Path(one.file).suffix for one in breaks()} == {".c", ".py"}
