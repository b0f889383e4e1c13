"""The use cases of service visits; safe to call from any thread."""

from __future__ import annotations

import hashlib
import secrets
import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from typing import IO, Any, Literal, Protocol

from backend.core.canonical_json import sha256_of
from backend.core.moments import utc, utc_or_none
from backend.core.person import Person
from backend.core.revision import RevisionLog
from backend.errors import Conflict, FieldError, InvalidRequest, NotFound
from backend.store.wall_clock import now_us
from backend.visits.changes import changes_since, seen_faults
from backend.visits.files import StoredVisit, plain
from backend.visits.history import HistoryFile, incoming, require_each_once, write_history
from backend.visits.photos import drawn_anew
from backend.visits.records import VisitStore
from backend.visits.types import (
    PHOTOS_MAX,
    POINTS_MAX,
    TEXT_MAX,
    HistoryAdded,
    Visit,
    VisitCalibration,
    VisitChangeIn,
    VisitConsent,
    VisitConsentIn,
    VisitContent,
    VisitIn,
    VisitPart,
    VisitPhoto,
    VisitWords,
)
from backend.visits.workbench import Workbench


class CalibrationResult(Protocol):
    """What a calibration came to."""

    @property
    def verdict(self) -> Literal["pass", "conditional", "fail"] | None: ...
    @property
    def linearity_pct(self) -> float | None: ...
    @property
    def hysteresis_pct(self) -> float | None: ...
    @property
    def expanded_nm(self) -> float | None: ...


class ClosedCalibration(Protocol):
    """What a visit has of a calibration job."""

    @property
    def id(self) -> int: ...
    @property
    def closed_at(self) -> datetime | None: ...
    @property
    def author(self) -> str: ...
    @property
    def file_sha256(self) -> str | None: ...
    @property
    def result(self) -> CalibrationResult: ...


class Visits:
    """Visits from the first word to the owner's consent.

    calibrations: jobs of a unit by its key.
    """

    def __init__(
        self,
        visits: VisitStore,
        workbench: Workbench,
        revisions: RevisionLog,
        calibrations: Callable[[str], Sequence[ClosedCalibration]],
    ) -> None:
        self._visits = visits
        self._workbench = workbench
        self._revisions = revisions
        self._calibrations = calibrations
        # A photograph takes some hundred megabytes while it is drawn.
        self._drawing = threading.Lock()

    def list(self, bike_id: int, owner_id: int | None = None) -> tuple[Visit, ...]:
        """The visits of a bike, the newest first. owner_id: the owner who looks, None for the
        workshop. Raises NotFound, StoreError."""
        return tuple(self._seen(visit, owner_id) for visit in self._visits.list(bike_id))

    def get(self, visit_id: int, owner_id: int | None = None) -> Visit:
        """One visit, as `list` has it. Raises NotFound, StoreError."""
        return self._seen(self._visits.get(visit_id), owner_id)

    def open(self, bike_id: int, words: VisitIn, author: str) -> Visit:
        """Begin a visit; a unit that is named is looked at.

        Raises NotFound; Conflict `visit_open`, `other_bike` for a unit that is not on this bike;
        LinkError, StoreError.
        """
        key, seq = self._visits.newest_revision(bike_id)
        content = written(VisitContent(unit_key=key, revision_seq=seq), words)
        if words.device_id is not None:
            content = self._looked_at(content, words.device_id, key)
        return self._seen(self._visits.open(bike_id, secrets.token_hex(16), content, author))

    def change(self, visit_id: int, words: VisitChangeIn) -> Visit:
        """Write in an open visit. Raises NotFound; Conflict `visit_closed`, `visit_changed`;
        StoreError."""
        changed = self._visits.change(visit_id, lambda now: written(now, words), words.version)
        return self._seen(changed)

    def look(self, visit_id: int, device_id: str) -> Visit:
        """Look at the unit: its checks and faults, for after the work. Raises NotFound; Conflict
        `visit_closed`, `other_bike`; LinkError, StoreError."""
        key, _ = self._visits.newest_revision(self._visits.get(visit_id).bike_id)
        # The unit answers before the database is written.
        look = self._workbench.look(device_id)
        require_on_bike(look[0].unit_key, key)
        return self._seen(self._visits.change(visit_id, lambda now: with_look(now, *look)))

    def add_photo(self, visit_id: int, name: str, data: bytes) -> Visit:
        """Keep a photograph, drawn anew. Raises NotFound; InvalidRequest; Conflict `visit_closed`,
        `photos_full`; StoreError."""
        require_open(self._visits.get(visit_id))
        with self._drawing:
            jpeg, width_px, height_px = drawn_anew(data)
        sha256 = hashlib.sha256(jpeg).hexdigest()
        added_at = utc(now_us())
        photo = VisitPhoto(sha256, name, width_px, height_px, len(jpeg), added_at)

        def added(now: VisitContent) -> VisitContent:
            if any(one.sha256 == sha256 for one in now.photos):
                return now
            if len(now.photos) >= PHOTOS_MAX:
                raise Conflict(f"A visit has {PHOTOS_MAX} photographs at most.", "photos_full")
            return replace(now, photos=(*now.photos, photo))

        return self._seen(self._visits.add_photo(visit_id, photo, jpeg, added))

    def photo(self, visit_id: int, sha256: str) -> bytes:
        """A photograph as JPEG. Raises NotFound, StoreError."""
        visit = self._visits.get(visit_id)
        if all(one.sha256 != sha256 for one in visit.content.photos):
            raise NotFound(f"Visit {visit_id} has no photograph {sha256}.")
        return self._visits.photo(visit.token, sha256)

    def remove_photo(self, visit_id: int, sha256: str) -> Visit:
        """Remove a photograph for good. Raises NotFound; Conflict `visit_closed`; StoreError."""

        def without(now: VisitContent) -> VisitContent:
            left = tuple(one for one in now.photos if one.sha256 != sha256)
            if len(left) == len(now.photos):
                raise NotFound(f"Visit {visit_id} has no photograph {sha256}.")
            return replace(now, photos=left)

        return self._seen(self._visits.change(visit_id, without))

    def close(self, visit_id: int) -> Visit:
        """End a visit with what is otherwise now. Raises NotFound, Conflict `visit_closed`,
        StoreError."""
        # Read before the transaction, which must not wait for another connection.
        visit = self._visits.get(visit_id)
        found = self._worked_out(visit).content

        def final(now: VisitContent) -> VisitContent:
            return replace(now, changes=found.changes, calibrations=found.calibrations)

        return self._seen(self._visits.change(visit_id, final, closes=True))

    def remove(self, visit_id: int) -> None:
        """Remove an open visit that was begun by mistake. Raises NotFound, Conflict `visit_closed`,
        StoreError."""
        self._visits.remove(visit_id)

    def consent(self, visit_id: int, request: VisitConsentIn, person: Person | None) -> Visit:
        """Note that the owner agrees with what was done: by their own account, or by a signature
        that the workshop hands over. person: who requests it, None where nobody signs in.

        Raises NotFound; InvalidRequest; Conflict `visit_changed` where it is otherwise by now, and
        `consented_already` where a consent holds; StoreError.
        """
        consent = consent_of(request, person)
        before = self._visits.get(visit_id)
        seen = self._seen(before)
        require_same(request.content_sha256 == seen.content_sha256)
        if seen.consent_holds:
            raise Conflict("Somebody consented to this already.", "consented_already")

        def given(now: StoredVisit) -> VisitConsent:
            require_same((now.version, now.consent) == (before.version, before.consent))
            return consent

        owner_id = None if person is None or person.role != "rider" else person.id
        return self._seen(self._visits.consent(visit_id, given), owner_id)

    def write_history(self, bike_id: int, file: IO[bytes]) -> None:
        """Write the closed visits of a bike as a file. Raises NotFound, StoreError."""
        visits = [one for one in self._visits.list(bike_id) if one.closed_us is not None]
        bike = self._visits.bike_named(bike_id)
        write_history(file, bike, visits, self._visits.photo)

    def read_history(self, bike_id: int, file: IO[bytes]) -> HistoryAdded:
        """Add the visits of a file that are not here yet, all or none of them.

        Raises NotFound; InvalidRequest for a file that is no history; Conflict `visits_full`;
        StoreError.
        """
        # Nothing of a file is read for a bike that is not here.
        self._visits.bike_named(bike_id)
        history = HistoryFile(file)
        visits = [incoming(one) for one in history.visits]
        require_each_once(visits)
        added = self._visits.bring_all(
            bike_id, visits, lambda visit: history.photos(visit.content.photos)
        )
        return HistoryAdded(added, len(visits) - added)

    def _looked_at(
        self, content: VisitContent, device_id: str, key_on_bike: str | None
    ) -> VisitContent:
        readings, faults = self._workbench.look(device_id)
        require_on_bike(readings.unit_key, key_on_bike)
        return with_look(content, readings, faults)

    def _worked_out(self, visit: StoredVisit) -> StoredVisit:
        """A visit with what became of its unit; a closed one has that in its row."""
        key = visit.content.unit_key
        if visit.closed_us is not None or key is None:
            return visit
        revisions = self._revisions.list(key)
        found = (calibration_since(job, utc(visit.opened_us)) for job in self._calibrations(key))
        calibrations = tuple(one for one in found if one is not None)
        changes = changes_since(revisions, visit.content.revision_seq)
        content = replace(visit.content, changes=changes, calibrations=calibrations)
        return replace(visit, content=content)

    def _seen(self, visit: StoredVisit, owner_id: int | None = None) -> Visit:
        """A visit as it is answered. owner_id: of the owner who looks: other people's names are
        none of their business."""
        visit = self._worked_out(visit)
        content, consent = visit.content, visit.consent
        content_sha256 = sha256_of(plain(replace(content, customer="")))
        holds = consent is not None and consent.content_sha256 == content_sha256
        if owner_id is not None:
            content = replace(content, customer="")
            if consent is not None and consent.person_id != owner_id:
                consent = replace(consent, name=None, person_id=None, strokes=())
        return Visit(
            id=visit.id,
            token=visit.token,
            bike_id=visit.bike_id,
            bike_name=visit.bike_name,
            state="open" if visit.closed_us is None else "closed",
            opened_at=utc(visit.opened_us),
            opened_by=visit.opened_by,
            closed_at=utc_or_none(visit.closed_us),
            version=visit.version,
            imported=visit.imported,
            content=content,
            content_sha256=content_sha256,
            consent=consent,
            consent_holds=holds,
        )


def calibration_since(job: ClosedCalibration, opened_at: datetime) -> VisitCalibration | None:
    """What a visit keeps of a calibration; None of one that was not closed during it."""
    if job.closed_at is None or job.file_sha256 is None or job.closed_at < opened_at:
        return None
    return VisitCalibration(
        id=job.id,
        closed_at=job.closed_at,
        author=job.author,
        sha256=job.file_sha256,
        verdict=job.result.verdict,
        linearity_pct=job.result.linearity_pct,
        hysteresis_pct=job.result.hysteresis_pct,
        expanded_nm=job.result.expanded_nm,
    )


def require_open(visit: StoredVisit) -> None:
    """Raises Conflict for a closed one."""
    if visit.closed_us is not None:
        raise Conflict("This visit is closed: what was done then stays.", "visit_closed")


def written(content: VisitContent, words: VisitWords) -> VisitContent:
    """A content with what was written; what is absent stays."""
    names = VisitWords.model_fields.keys() & words.model_fields_set
    values: Mapping[str, Any] = {name: getattr(words, name) for name in names}
    if "parts" in values:
        parts = (VisitPart(one.name, one.number, one.quantity) for one in words.parts)
        values = {**values, "parts": tuple(parts)}
    return replace(content, **values)


def with_look(content: VisitContent, readings: Any, faults: Sequence[Any]) -> VisitContent:
    """A content with one more look at the unit: the first is `before`, the last `after`."""
    seen = seen_faults(content.faults, faults, readings.at)
    if content.before is None:
        return replace(content, before=readings, faults=seen)
    return replace(content, after=readings, faults=seen)


def require_on_bike(unit_key: str, key_on_bike: str | None) -> None:
    """Raises Conflict `other_bike`."""
    if unit_key != key_on_bike:
        message = (
            f"The unit {unit_key} is not on this bike: put it on it first, or connect its own."
        )
        raise Conflict(message, "other_bike")


def require_same(is_same: bool) -> None:
    """Raises Conflict `visit_changed` for a visit that is not as it was seen."""
    if not is_same:
        message = "The visit is otherwise by now: look at it again before you consent."
        raise Conflict(message, "visit_changed")


def consent_of(request: VisitConsentIn, person: Person | None) -> VisitConsent:
    """A rider consents by their account; anybody else hands over a signature with its name.

    Raises InvalidRequest.
    """
    at = utc(now_us())
    if person is not None and person.role == "rider":
        return VisitConsent("account", person.name, person.id, at, request.content_sha256, ())
    name = request.name.strip()[:TEXT_MAX]
    points = sum(len(stroke) for stroke in request.strokes) // 2
    if not name or not 2 <= points <= POINTS_MAX or any(len(s) % 2 for s in request.strokes):
        message = "A consent in the workshop has the owner's name and signature."
        raise InvalidRequest(message, fields=[FieldError("strokes", "no_signature", message)])
    strokes = tuple(tuple(round(at, 4) for at in stroke) for stroke in request.strokes)
    return VisitConsent("signature", name, None, at, request.content_sha256, strokes)
