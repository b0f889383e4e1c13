"""Goal: what became of a change is asked until the unit tells, or its time is over.

Method: devices by script, whose link looks whole while it dies.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import cast

import pytest

from backend.device.unit import Unit
from backend.errors import LinkError, NoAnswer, NotFound, OtherUnit, SpindleError
from backend.units import outcome
from backend.units.outcome import find_outcome
from backend.units.service import Devices

SILENT = NoAnswer("silent")
FOUND = "found"


class ScriptedDevices:
    """Every look takes the next of the script: an error or a result."""

    def __init__(self, *script: SpindleError | str) -> None:
        self._script: Iterator[SpindleError | str] = iter(script)

    def wait_connected(self, device_id: str, timeout_s: float) -> bool:
        return True

    def own(self, device_id: str, meant: str) -> tuple[str, ScriptedDevices]:
        return meant, self

    def look(self, unit: Unit) -> str:
        step = next(self._script)
        if isinstance(step, SpindleError):
            raise step
        return step


class RemovedDevices(ScriptedDevices):
    """Somebody removed the device meanwhile."""

    def wait_connected(self, device_id: str, timeout_s: float) -> bool:
        raise NotFound("There is no device.")


class ReplacedDevices(ScriptedDevices):
    """Another unit came onto the connection meanwhile."""

    def own(self, device_id: str, meant: str) -> tuple[str, ScriptedDevices]:
        raise OtherUnit("B is there.")


def ask(devices: ScriptedDevices) -> str:
    return find_outcome(cast(Devices, devices), "bike", "ebl:A", devices.look, NoAnswer("lost"))


@pytest.fixture(autouse=True)
def no_pause(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(outcome, "PAUSE_S", 0.0)


def test_a_link_that_fails_at_once_many_times_does_not_use_the_time_up() -> None:
    gone = LinkError("gone")

    assert ask(ScriptedDevices(SILENT, gone, SILENT, SILENT, gone, SILENT, FOUND)) == FOUND


def test_what_is_not_found_out_in_its_time_is_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(outcome, "OUTCOME_WAIT_S", 0.0)

    with pytest.raises(NoAnswer) as told:
        ask(ScriptedDevices(SILENT))

    assert told.value.outcome == "unknown"


def test_a_device_that_was_removed_meanwhile_leaves_the_change_unknown() -> None:
    with pytest.raises(NoAnswer) as told:
        ask(RemovedDevices())

    assert told.value.outcome == "unknown"


@pytest.mark.parametrize(
    "devices",
    [ReplacedDevices(FOUND), ScriptedDevices(SILENT, OtherUnit("B is there."), FOUND)],
    ids=["before it was looked", "while it was looked"],
)
def test_another_unit_does_not_know_what_became_of_it(devices: ScriptedDevices) -> None:
    with pytest.raises(NoAnswer) as told:
        ask(devices)

    assert told.value.outcome == "unknown"
