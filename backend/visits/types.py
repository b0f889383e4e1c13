"""What is said of a unit on the workbench and of a service visit."""

from __future__ import annotations

from datetime import datetime
from typing import Annotated, Any, Literal

from pydantic import AwareDatetime, Field

from backend.core.api_models import RequestBody
from backend.core.described import described
from backend.device.capability import Capability
from backend.device.readings import Fault, WearCounters
from backend.device.states import Identity
from backend.units.types import ConfigStamp, DeviceState
from backend.visits.checks import UnitCheck


@described
class UnitChecks:
    """What was found, and the readings it was found by."""

    checked_at: datetime
    checks: tuple[UnitCheck, ...]
    channels: dict[str, float | None]
    faults_active: tuple[str, ...]
    wear: WearCounters | None
    """Null for a unit of another make, which does not count."""


@described
class SupportRevision:
    """A configuration that the unit had, without who gave it and why."""

    seq: int
    created_at: datetime
    state: str
    generation: int | None
    crc32: int | None
    changed: tuple[dict[str, Any], ...]


@described
class SupportFile:
    """A unit as it says it is; null is what it could not say now."""

    format: str
    version: int
    spindle_version: str
    made_at: datetime
    left_out: tuple[str, ...]
    family: str
    state: DeviceState
    reason_code: str
    capabilities: tuple[Capability, ...]
    identity: Identity | None
    config: ConfigStamp | None
    link: dict[str, int | float | None]
    faults: tuple[Fault, ...]
    checks: UnitChecks | None
    parameters: dict[str, Any] | None
    """By name, as last read."""
    revisions: tuple[SupportRevision, ...]
    """Newest first."""


# Of a bike; one a week for twenty years.
VISITS_MAX = 1_000
TEXT_MAX, LONG_TEXT_MAX = 60, 2_000
PARTS_MAX, PHOTOS_MAX = 50, 20
# Of a signature, in points; a slow one on a tablet has some 600.
STROKES_MAX, POINTS_MAX = 60, 4_000

VisitState = Literal["open", "closed"]


@described
class VisitPart:
    """What was built in."""

    name: str
    number: str | None
    """The maker's number of it."""
    quantity: int


@described
class VisitFault:
    """A fault that the unit had during the visit, or remembered."""

    name: str
    count: int | None
    """How often since the unit's start, as last seen."""
    seen_at: AwareDatetime
    over_at: AwareDatetime | None
    """When it was first seen to be over, null while it is there."""


@described
class VisitChange:
    """A setting that is otherwise than before the visit, whatever was tried in between."""

    parameter: str
    old: Any
    new: Any
    changed_at: AwareDatetime
    author: str
    reason: str


@described
class VisitCalibration:
    """A calibration that was closed during the visit; what it came to is null without a fit."""

    id: int
    closed_at: AwareDatetime
    author: str
    sha256: str
    """Of its file."""
    verdict: Literal["pass", "conditional", "fail"] | None = None
    linearity_pct: float | None = None
    hysteresis_pct: float | None = None
    expanded_nm: float | None = None
    """The largest uncertainty of the torque, k = 2."""


@described
class VisitReadings:
    """The unit as it was looked at."""

    at: AwareDatetime
    unit_key: str
    serial_number: str | None
    model: str | None
    firmware_version: str | None
    generation: int | None
    crc32: int | None
    checks: tuple[UnitCheck, ...]
    faults_active: tuple[str, ...]


@described
class VisitPhoto:
    """A photograph, without what the camera wrote into it."""

    sha256: str
    name: str
    width_px: int
    height_px: int
    size_bytes: int
    added_at: AwareDatetime


@described
class VisitConsent:
    """The owner's consent to what was done, as the visit's content was then."""

    by: Literal["account", "signature"]
    name: str | None
    """Null for an earlier owner's, to an owner."""
    person_id: int | None
    """The account's number; null for a signature, and for an earlier owner's, to an owner."""
    at: AwareDatetime
    content_sha256: str
    strokes: tuple[tuple[float, ...], ...]
    """Of a signature: each x, y, x, y, ... as shares of the field's width and height."""


@described
class VisitContent:
    """What a visit is about. The workshop writes the words, the server adds what units report."""

    job: str = ""
    """The workshop's number of the job."""
    technician: str = ""
    customer: str = ""
    """Who brought it. Not in the history that goes on to others, and for the workshop only."""
    counter_km: float | None = None
    complaint: str = ""
    done: str = ""
    notes: str = ""
    parts: tuple[VisitPart, ...] = ()
    unit_key: str | None = None
    """The unit that was on the bike when the visit began."""
    revision_seq: int | None = None
    """The newest configuration of that unit when the visit began."""
    before: VisitReadings | None = None
    """The first readings."""
    after: VisitReadings | None = None
    """The last ones, null before there are second ones."""
    faults: tuple[VisitFault, ...] = ()
    changes: tuple[VisitChange, ...] = ()
    calibrations: tuple[VisitCalibration, ...] = ()
    photos: tuple[VisitPhoto, ...] = ()


@described
class Visit:
    """A service visit of a bike."""

    id: int
    token: str
    """The same on every server that has this visit."""
    bike_id: int
    bike_name: str
    state: VisitState
    opened_at: datetime
    opened_by: str
    closed_at: datetime | None
    version: int
    """Counts the changes of what people wrote."""
    imported: bool
    """It came with a bike's history from another server."""
    content: VisitContent
    content_sha256: str
    """Of the content; what the owner consents to."""
    consent: VisitConsent | None
    consent_holds: bool
    """Nothing is otherwise than what was consented to."""


@described
class VisitList:
    """The newest first."""

    items: tuple[Visit, ...]


@described
class HistoryAdded:
    """What a bike's history brought."""

    added: int
    known: int
    """Visits that were here already; they stay as they are."""


Line = Field(default="", max_length=TEXT_MAX)
Text = Field(default="", max_length=LONG_TEXT_MAX)


class VisitPartIn(RequestBody):
    name: str = Field(min_length=1, max_length=TEXT_MAX)
    number: str | None = Field(default=None, max_length=TEXT_MAX)
    quantity: int = Field(default=1, ge=1, le=999)


class VisitWords(RequestBody):
    """What the workshop writes. What is absent stays."""

    job: str = Line
    technician: str = Line
    customer: str = Line
    counter_km: float | None = Field(default=None, ge=0.0, le=1e6)
    complaint: str = Text
    done: str = Text
    notes: str = Text
    parts: list[VisitPartIn] = Field(default_factory=list, max_length=PARTS_MAX)


class VisitIn(VisitWords):
    device_id: str | None = Field(
        default=None, max_length=400, description="The unit on the bike, to be looked at now."
    )


class VisitChangeIn(VisitWords):
    version: int = Field(ge=1, description="The version that was changed; 409 if it is another.")


class VisitReadingsIn(RequestBody):
    device_id: str = Field(max_length=400, description="The unit on the bike.")


Coordinate = Annotated[float, Field(ge=0.0, le=1.0)]
Stroke = Annotated[list[Coordinate], Field(min_length=2, max_length=2 * POINTS_MAX)]


class VisitConsentIn(RequestBody):
    """An owner with an account says nothing more; a workshop hands over the name and the signature
    that somebody drew."""

    content_sha256: str = Field(
        pattern=r"^[0-9a-f]{64}$", description="What is consented to; 409 if it is otherwise now."
    )
    name: str = Line
    strokes: list[Stroke] = Field(default_factory=list, max_length=STROKES_MAX)
