"""Goal: choices as versions up to 0.2 spelled them are taken, mean the same, and are told as today.

Method: the small honest unit behind a real thread, with a revision log in memory; requests and
revisions by the registry's own names, as those versions had them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import pytest

from backend.tuning.service import Tuning
from backend.units.service import Devices
from firmware_protocol.parameters import default_config, unpack_image
from tests.fakes.revisions import MemoryRevisions
from tests.fakes.unit import FakeUnit
from tests.fakes.unit_link import UnitOpener

OLD_WORDS = {"mode_laws": ["OFF", "FIXED", "FIXED", "FUZZY", "FUZZY"], "market": "EU_EPAC"}


@dataclass
class Bench:
    unit: FakeUnit
    tuning: Tuning
    revisions: MemoryRevisions
    id: str
    key: str


@pytest.fixture
def bench() -> Iterator[Bench]:
    unit, revisions = FakeUnit(), MemoryRevisions()
    devices = Devices(opener=lambda url: UnitOpener(unit, url))
    device = devices.add("socket://bench:1")
    yield Bench(unit, Tuning(devices, revisions), revisions, device.id, devices.unit_key(device.id))
    devices.close()


def test_the_spelling_of_older_versions_is_no_change(bench: Bench) -> None:
    change = bench.tuning.write_config(bench.id, OLD_WORDS)

    assert (change.changed, change.generation, unpack_image(bench.unit.image)) == (
        (),
        7,
        default_config(),
    )


def test_a_change_in_the_old_spelling_is_told_and_kept_in_that_of_today(bench: Bench) -> None:
    change = bench.tuning.write_config(bench.id, {"fuzzy_inference": "WEIGHTED_AVERAGE"})

    newest = bench.revisions.kept[bench.key][-1]
    assert [one.new for one in change.changed] == ["weighted_average"]
    assert change.parameters["fuzzy_inference"] == "weighted_average"
    assert newest.changed[0]["new"] == newest.parameters["fuzzy_inference"] == "weighted_average"


def test_a_revision_of_an_older_version_is_told_as_choices_are_spelled_today(bench: Bench) -> None:
    changed = [{"name": "mode_laws", "old": None, "new": OLD_WORDS["mode_laws"]}]
    bench.revisions.append(bench.key, default_config() | OLD_WORDS, changed)

    (told,) = bench.tuning.revisions(bench.id)

    laws = ["off", "fixed", "fixed", "fuzzy", "fuzzy"]
    assert told.changed == [{"name": "mode_laws", "old": None, "new": laws}]
    assert told.parameters == default_config()


def test_a_trial_begun_by_an_older_version_is_kept(bench: Bench) -> None:
    bench.tuning.write_config(bench.id, {"pedal_stop_ms": 200}, confirm_s=60)
    log = bench.revisions.kept[bench.key]
    log[-1] = replace(log[-1], parameters={**log[-1].parameters, **OLD_WORDS})

    assert bench.tuning.confirm_config(bench.id).state == "committed"
