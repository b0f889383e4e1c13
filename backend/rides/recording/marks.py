"""A moment of the ride that is being recorded is marked, to be found again."""

from __future__ import annotations

from collections.abc import Callable

from backend.core.described import described
from backend.errors import Conflict
from backend.rides.recording.recorder import Recorder
from backend.store import MarkStore


@described
class RideMark:
    """A moment that was marked, t_s seconds after the start of its ride."""

    ride_id: int
    t_s: float
    number: int
    """From 1, in its ride."""


class MarkMoment:
    """require: raises NotFound for an unknown unit."""

    def __init__(
        self, recorder: Recorder, marks: MarkStore, require: Callable[[str], object]
    ) -> None:
        self._recorder = recorder
        self._marks = marks
        self._require = require

    def __call__(self, device_id: str) -> RideMark:
        """Mark the newest moment of a unit's ride.

        Raises NotFound, Conflict `no_ride` while the unit records none, `marks_full`, StoreError.
        """
        self._require(device_id)
        newest = self._recorder.newest(device_id)
        if newest is None:
            raise Conflict("No ride is being recorded; one begins when the bike moves.", "no_ride")
        ride_id, t_s = newest
        return RideMark(ride_id, t_s, self._marks.add(ride_id, t_s).value)
