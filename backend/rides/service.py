"""Looking at rides: lists, figures, traces, notes, exports and replays."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from datetime import datetime
from typing import Any

from backend.core.moments import microseconds
from backend.core.ride import BAD, Ride, RideSummary
from backend.errors import InvalidRequest, NotFound
from backend.rides.files import Export, archive, export, share
from backend.rides.traces.axes import Axis
from backend.rides.traces.figure import figure
from backend.rides.traces.trace import Trace, trace
from backend.rides.traces.track import Track, track
from backend.store import ROW_DAMAGED, Sought, Store, expected_of

# (the ride, what is changed) -> the API's answer
Replay = Callable[..., Any]


class Rides:
    """The rides' use cases; safe to call from any thread.

    unit_at: the key of the unit that a device has now; None for one that is not there. running:
    what a ride that is being recorded comes to so far.
    """

    def __init__(
        self,
        store: Store,
        replay: Replay | None = None,
        unit_at: Callable[[str], str | None] = lambda device_id: None,
        running: Callable[[int], RideSummary | None] = lambda ride_id: None,
    ) -> None:
        self._store = store
        self._replay = replay
        self._unit_at = unit_at
        self._running = running

    def list(
        self,
        begin: datetime | None = None,
        end: datetime | None = None,
        limit: int = 50,
        cursor: str | None = None,
        **what: Any,
    ) -> dict[str, object]:
        """One page, newest first: {items, next, total}; total: with the first page only.

        what: as `sought`.
        """
        sought = self.sought(begin, end, **what)
        page = self._store.rides.list(sought, limit, cursor)
        items = [self._as_json(ride) for ride in page.items]
        total = self._store.logbook.count(sought) if cursor is None else None
        return {"items": items, "next": page.next, "total": total}

    def sought(
        self,
        begin: datetime | None = None,
        end: datetime | None = None,
        device: str | None = None,
        **what: Any,
    ) -> Sought:
        """What is looked for, as of `Sought`.

        device: a unit's key or serial number, or the id of a device that is connected now.
        """
        unit = None if device is None else self._unit_at(device) or device
        return Sought(microseconds(begin), microseconds(end), unit, **what)

    def get(self, ride_id: int) -> dict[str, object]:
        """One ride. Raises NotFound."""
        return self._as_json(self._store.rides.get(ride_id))

    def patch(
        self,
        ride_id: int,
        name: str | None = None,
        notes: str | None = None,
        tags: Sequence[str] | None = None,
        doubts_accepted: bool | None = None,
    ) -> dict[str, object]:
        """Change what people wrote about a ride. Raises NotFound, InvalidRequest."""
        return self._as_json(
            self._store.rides.patch(ride_id, name, notes, tags, doubts_accepted, audited=True)
        )

    def require_own(self, ride_ids: Sequence[int], owner_id: int | None) -> None:
        """Raises NotFound for a ride that is not this account's; None has all."""
        self._store.logbook.require_own(ride_ids, owner_id)

    def delete(self, ride_id: int) -> None:
        """Delete a ride; with the last ride of an original file this goes too, on the disk as well.

        Raises NotFound, Conflict while the ride is being recorded.
        """
        with self._store.deciding:
            self._store.rides.delete(ride_id)

    def delete_all(self, ride_ids: Sequence[int], owner_id: int | None = None) -> None:
        """Delete rides in order; those that are gone, or are not this account's, are passed over.
        Raises Conflict."""
        for ride_id in self._store.logbook.own(ride_ids, owner_id):
            with suppress(NotFound):
                self.delete(ride_id)

    def series(
        self,
        ride_id: int,
        channels: Sequence[str] | None = None,
        from_s: float | None = None,
        to_s: float | None = None,
        pixels: int = 1000,
        axis: Axis = "time",
    ) -> Trace:
        """Exact minimum and maximum for each pixel of a window; see `rides.traces.trace`."""
        return trace(self._store.rides.reader(ride_id), channels, from_s, to_s, pixels, axis)

    def track(self, ride_id: int) -> Track:
        """Where the ride went, and how time, motion and way lie over each other."""
        return track(self._store.rides.reader(ride_id))

    def figure(
        self,
        ride_id: int,
        channels: Sequence[str] | None = None,
        pixels: int = 1000,
        language: str = "en",
    ) -> dict[str, object]:
        """The ride as a Plotly figure; see `backend.rides.traces.figure`."""
        drawn = figure(self._store.rides.reader(ride_id), channels, pixels, language)
        document: dict[str, object] = drawn.to_plotly_json()
        return document

    def export(self, ride_id: int, file_format: str, blur_m: float | None = None) -> Export:
        """The ride as a file. Raises NotFound, InvalidRequest for what cannot be made of it.

        blur_m: what is so near to its start and end is left out, as `share`.
        """
        ride = self._store.rides.get(ride_id)
        if blur_m is not None:
            return share(self._store, ride, file_format, blur_m)
        return export(self._store, ride, file_format)

    def archive(
        self,
        formats: Sequence[str],
        blur_m: float | None = None,
        ride_ids: Sequence[int] = (),
        **what: Any,
    ) -> Iterator[bytes]:
        """These rides as a ZIP, or every finished one as of `sought`. Raises NotFound."""
        self._store.logbook.require_own(ride_ids, what.get("owner_id"))
        chosen = list(dict.fromkeys(ride_ids)) or self._store.logbook.ids(self.sought(**what))
        for ride_id in ride_ids:
            self._store.rides.get(ride_id)
        return archive(self._store, chosen, formats, blur_m)

    def replay(self, ride_id: int, **changes: Mapping[str, Any] | None) -> Any:
        """What the motor would have done with other settings, as of `changed_config`."""
        if self._replay is None:
            raise InvalidRequest("This server cannot replay rides.", code="unsupported")
        return self._replay(self._store.rides.reader(ride_id), **changes)

    def _as_json(self, ride: Ride) -> dict[str, object]:
        """A ride as in the API, with what is known to be wrong with its samples."""
        damage = None
        if ride.state == "live":
            ride = replace(ride, summary=self._running(ride.id))
        if ride.state == BAD:
            damage = ROW_DAMAGED
        elif ride.object_key is not None:
            damage = self._store.soundness.cached_damage(expected_of(ride))
        return {**ride.as_json(), "damage": damage}
