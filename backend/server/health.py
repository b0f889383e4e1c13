"""Is everything kept that is to be kept, and is each unit there?

Told now, not then: `degraded` while something cannot be written. Rows that were lost for good, or
never came, stay among the reasons until the unit's next ride begins, so that nobody misses it;
damaged rides until they are restored or deleted.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from typing import Literal, cast

from backend.core.described import described
from backend.rides.recording.bounds import LOST_BY_WORDS
from backend.rides.recording.recorder import Recorder
from backend.rides.recording.ride_tail import RecorderHealth
from backend.store import WriteWatch
from backend.store.entries import Entries
from backend.store.soundness import Soundness
from backend.units.service import Devices
from backend.units.types import DeviceState

HealthCode = Literal[
    "disk_full",
    "store_read_only",
    "io_error",
    "queue_full",
    "database_unreachable",
    "database_damaged",
    "objects_unreachable",
    "objects_refused",
    "rows_lost",
    "rows_missing_machine",
    "rows_missing_line",
    "rows_missing_unit",
    "rides_damaged",
]
# So many damaged rows are named.
ROWS_NAMED_MAX = 5


@described
class HealthReason:
    code: HealthCode
    message: str
    part: str
    """What it is about: a part of the store, or the id of a unit."""


@described
class DeviceHealth:
    id: str
    state: DeviceState
    recorder: RecorderHealth


@described
class Health:
    status: Literal["ok", "degraded"]
    """`degraded` while something that is to be kept cannot be written."""
    version: str
    reasons: tuple[HealthReason, ...]
    """Why. With status ok too: `rows_lost` and `rows_missing_*` until the unit's next ride, the
    latter with where most of them were lost; `rides_damaged` until the files are restored or the
    rides deleted."""
    devices: tuple[DeviceHealth, ...]


class HealthCheck:
    """Looks at everything that may be wrong; `current` never waits. For any thread.

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

    def current(self) -> Health:
        """How things are now."""
        troubles = [
            HealthReason(cast(HealthCode, one.code), one.message, one.part)
            for one in self._watch.troubles
        ]
        devices = tuple(
            DeviceHealth(view.id, view.state, self._recorder.counts(view.id))
            for view in self._devices.list()
        )
        lost = [
            HealthReason(
                "rows_lost", f"{rows} rows of the latest ride of {unit} could not be saved.", unit
            )
            for unit, rows in self._recorder.rows_lost_lately()
        ]
        missing = [
            HealthReason(
                cast(HealthCode, f"rows_missing_{lost_by}"),
                f"{rows} rows of the latest ride of {unit} never came: {LOST_BY_WORDS[lost_by]}.",
                unit,
            )
            for unit, lost_by, rows in self._recorder.rows_missing_lately()
        ]
        damaged = []
        if keys := self._soundness.damaged:
            damaged.append(HealthReason("rides_damaged", describe_damaged_files(keys), "objects"))
        if rows := self._entries.damaged:
            damaged.append(HealthReason("rides_damaged", describe_damaged_rows(rows), "database"))
        reasons = (*troubles, *lost, *missing, *damaged)
        return Health("degraded" if troubles else "ok", self._version, reasons, devices)


def describe_damaged_files(keys: Collection[str]) -> str:
    """How many files are damaged, the first of them, and what to do."""
    return (
        f"Files of rides or calibrations that are damaged or missing: {len(keys)}, one of them "
        f"{min(keys)}. "
        "Restore them from a backup; the list of rides and `spindle store check` name each."
    )


def describe_damaged_rows(rides: Collection[int]) -> str:
    """Which rides' rows are damaged and could not be mended from their files, and what to do."""
    some = ", ".join(str(ride_id) for ride_id in sorted(rides)[:ROWS_NAMED_MAX])
    more = f" and {len(rides) - ROWS_NAMED_MAX} more" if len(rides) > ROWS_NAMED_MAX else ""
    return (
        f"Rows of rides in the database that are damaged, and no whole file is named there to mend "
        f"them from: {some}{more}. Restore files or database from a backup, or delete the rides."
    )
