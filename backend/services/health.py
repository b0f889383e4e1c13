"""Is everything kept that is to be kept, and is each unit there?

Told now, not then: `degraded` while something cannot be written. Rows that were lost for good, or
never came, stay among the reasons until the unit's next ride begins, so that nobody misses it;
damaged rides until they are restored or deleted.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from typing import Protocol

from backend.services.rides.missing_rows import LOST_BY_WORDS
from backend.services.rides.record import Recorder
from backend.services.rides.ride_tail import RowCounts
from backend.services.units.connect import Devices
from backend.store import WriteWatch
from backend.store.entries import Entries
from backend.store.soundness import Soundness

OK = "ok"
DEGRADED = "degraded"
ROWS_LOST = "rows_lost"
ROWS_MISSING = "rows_missing"
RIDES_DAMAGED = "rides_damaged"
# So many damaged rows are named.
ROWS_NAMED_MAX = 5


class Reason(Protocol):
    """Why something is not as it should be; a store's Trouble is one."""

    @property
    def part(self) -> str: ...
    @property
    def code(self) -> str: ...
    @property
    def message(self) -> str: ...


@dataclass(frozen=True)
class Fault:
    """A reason beside the store's own: rows that are not there, rides that are damaged."""

    part: str
    code: str
    message: str


@dataclass(frozen=True)
class DeviceHealth:
    """One unit: its state, and its rows on their way to the store."""

    id: str
    state: str
    recorder: RowCounts


@dataclass(frozen=True)
class HealthView:
    """The answer of `GET /health`."""

    status: str
    version: str
    reasons: tuple[Reason, ...]
    devices: tuple[DeviceHealth, ...]


class Health:
    """Looks at everything that may be wrong; `look` never waits. For any thread.

    answers: asks the database for nothing in particular. Raises StoreError. soundness: knows which
    rides' files are damaged, entries which rows.
    """

    def __init__(
        self,
        version: str,
        devices: Devices,
        recorder: Recorder,
        watch: WriteWatch,
        answers: Callable[[], None],
        soundness: Soundness,
        entries: Entries,
    ) -> None:
        self._version = version
        self._devices = devices
        self._recorder = recorder
        self._watch = watch
        self._answers = answers
        self._soundness = soundness
        self._entries = entries

    def ready(self) -> None:
        """Whether requests can be answered: raises StoreError while the database does not."""
        self._answers()

    def look(self) -> HealthView:
        """How things are now."""
        troubles: Sequence[Reason] = self._watch.troubles
        devices = tuple(
            DeviceHealth(view.id, view.state, self._recorder.counts(view.id))
            for view in self._devices.list()
        )
        lost = [
            Fault(unit, ROWS_LOST, f"{rows} rows of the latest ride of {unit} could not be saved.")
            for unit, rows in self._recorder.rows_lost_lately()
        ]
        missing = [
            Fault(
                unit,
                f"{ROWS_MISSING}_{lost_by}",
                f"{rows} rows of the latest ride of {unit} never came: {LOST_BY_WORDS[lost_by]}.",
            )
            for unit, lost_by, rows in self._recorder.rows_missing_lately()
        ]
        damaged = []
        if keys := self._soundness.damaged:
            damaged.append(Fault("objects", RIDES_DAMAGED, told_of_damage(keys)))
        if rows := self._entries.damaged:
            damaged.append(Fault("database", RIDES_DAMAGED, told_of_rows(rows)))
        reasons = (*troubles, *lost, *missing, *damaged)
        return HealthView(DEGRADED if troubles else OK, self._version, reasons, devices)


def told_of_damage(keys: Collection[str]) -> str:
    """How many files are damaged, the first of them, and what to do."""
    return (
        f"Files of rides or calibrations that are damaged or missing: {len(keys)}, one of them "
        f"{min(keys)}. "
        "Restore them from a backup; the list of rides and `spindle store check` name each."
    )


def told_of_rows(rides: Collection[int]) -> str:
    """Which rides' rows are damaged and could not be mended from their files, and what to do."""
    some = ", ".join(str(ride_id) for ride_id in sorted(rides)[:ROWS_NAMED_MAX])
    more = f" and {len(rides) - ROWS_NAMED_MAX} more" if len(rides) > ROWS_NAMED_MAX else ""
    return (
        f"Rows of rides in the database that are damaged, and no whole file is named there to mend "
        f"them from: {some}{more}. Restore files or database from a backup, or delete the rides."
    )
