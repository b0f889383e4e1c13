"""Visits on a store alone, without units: a bike, pictures, a calibration that was closed."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import cast
from zipfile import ZipFile

from PIL import Image
from sqlalchemy import insert

from backend.calibration.types import JobSummary, Result
from backend.core.moments import utc, utc_or_none
from backend.core.person import Person
from backend.store import Store
from backend.store.bikes import bike_of_unit
from backend.store.sql import tables as t
from backend.tuning.records import RevisionStore
from backend.visits.records import VisitStore
from backend.visits.service import ClosedCalibration, Visits
from backend.visits.types import Visit, VisitConsentIn, VisitIn
from backend.visits.workbench import Workbench

UNIT = "ebl:SP-1"


RESULT = Result("pass", expanded_nm=0.76, linearity_pct=0.25, hysteresis_pct=0.13)


def calibration(number: int, closed_us: int | None, sha256: str | None = "c" * 64) -> JobSummary:
    """A calibration of the unit; closed_us: None for one that is open."""
    return JobSummary(
        id=number,
        state="fitted" if closed_us is None else "closed",
        unit_key=UNIT,
        bike_id=1,
        model=None,
        opened_at=utc(0),
        closed_at=utc_or_none(closed_us),
        author="Ada",
        author_proof=None,
        file_sha256=sha256,
        result=RESULT,
    )


def visits_on(store: Store, calibrations: Sequence[ClosedCalibration] = ()) -> Visits:
    """Service visits whose calibrations are these, with no unit on the cable."""
    revisions = RevisionStore(store.database)
    nobody = cast(Workbench, None)
    return Visits(VisitStore(store), nobody, revisions, lambda _: calibrations)


def a_bike(store: Store, name: str = "Blue", frame_number: str | None = None) -> int:
    """A bike without a unit."""
    values = {"name": name, "frame_number": frame_number, "created_us": 1}
    made = insert(t.bike).values(values).returning(t.bike.c.id)
    return int(store.database.write(lambda c: c.execute(made).scalar_one()))


def bike_with_unit(store: Store, unit_key: str = UNIT) -> int:
    """The bike that a unit is on."""
    return store.database.write(lambda connection: bike_of_unit(connection, unit_key))


def picture(shade: int = 90, size: tuple[int, int] = (64, 48)) -> bytes:
    """A photograph as JPEG, unlike those of another shade."""
    file = io.BytesIO()
    Image.new("RGB", size, (shade, 20, 200)).save(file, "JPEG")
    return file.getvalue()


def signed(visits: Visits, visit_id: int, name: str = "Frau Müller") -> Visit:
    """A visit with a signature drawn in the workshop."""
    sha256 = visits.get(visit_id).content_sha256
    strokes = [[0.1, 0.1, 0.4, 0.5, 0.9, 0.2]]
    request = VisitConsentIn(content_sha256=sha256, name=name, strokes=strokes)
    return visits.consent(visit_id, request, cast(Person, None))


def a_closed_visit(visits: Visits, bike_id: int, photos: int = 2) -> Visit:
    """A visit with words, photographs and a signature that is over."""
    words = VisitIn(customer="Frau Müller", complaint="it bucks", job="4711")
    visit_id = visits.open(bike_id, words, "Ben").id
    for number in range(photos):
        visits.add_photo(visit_id, f"{number}.jpg", picture(10 * number))
    visits.close(visit_id)
    return signed(visits, visit_id)


def files_of_visits(objects: Path) -> list[str]:
    """Names of the files of visits, sorted."""
    folder = objects / "visits"
    return sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []


def history_of_others(history: bytes, token: str) -> bytes:
    """A bike's history with another visit in it than this one."""
    with ZipFile(io.BytesIO(history)) as archive:
        text = archive.read("history.json").decode().replace(token, "f" * 32)
    file = io.BytesIO()
    with ZipFile(file, "w") as archive:
        archive.writestr("history.json", text)
    return file.getvalue()
