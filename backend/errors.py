"""The errors of the backend. A message says what, on which port or ride, and what to do.

SpindleError
├── LinkError                the port: absent, busy, vanished
│   └── NoAnswer             the unit did not answer; of a change it says what became of it
├── PeerProtocolError        the unit broke the protocol
├── OurProtocolError         we broke it: a bug of ours
├── DeviceRefused            the unit answered with a status other than OK
├── RequestRefused           we or the unit said no, and nothing changed
│   ├── InvalidRequest       the values make no sense
│   ├── LimitViolation       a value is outside what the parameter allows; each is named
│   ├── ConfigConflict       somebody else changed the configuration first
│   ├── OtherUnit            the unit on this connection is not the one that was meant
│   ├── AccessDenied         the parameter needs a higher access level
│   │   └── TokenNeeded      the maker's token would do; it says what has to be signed
│   ├── NotSignedIn          nobody is known to ask, or the password is wrong
│   ├── NotAllowed           who asks is known, and may not
│   ├── TooManyTries         wrong passwords came too often; says how long to wait
│   ├── NotStandingStill     the wheel or the motor still turns
│   ├── Conflict             the thing is not in a state that allows this
│   │   ├── CapabilityMissing    this make of unit cannot do it; names what is missing
│   │   └── NameFirst            nobody knows which unit it is: its owner has to name it
│   └── NotFound             no such device, ride, upload or port
├── BadFile                  a log that cannot be read; says where and what could be saved
└── StoreError               the database or the object store
    ├── ObjectsAway          a bucket does not answer: nothing is known of what is in it
    ├── StoreFull            its disk has no room left
    └── ObjectDamaged        a file of the store is not what was written; nothing of it was sent
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

# What became of a change whose answer did not come: the unit is as it was, it has the change, or
# nobody could find out.
Outcome = Literal["unchanged", "changed", "unknown"]


@dataclass(frozen=True)
class FieldError:
    """One field at fault.

    field: the name in the request or of the parameter, with indices (`fuzzy_rules[2][0]`).
    code: lower-case word for programs (`above_max`).
    message: sentence for people, with the value, the bounds and the unit.
    """

    field: str
    code: str
    message: str


class SpindleError(Exception):
    """Anything that is the world's fault rather than ours.

    message: what, where, what to do. code: lower-case word for programs; the class has a default.
    fields: every field at fault, so that a form can mark them all at once.
    """

    default_code = "error"

    def __init__(
        self, message: str, code: str | None = None, fields: Iterable[FieldError] = ()
    ) -> None:
        super().__init__(message)
        self.message = message
        self.code = code or self.default_code
        self.fields = tuple(fields)


class LinkError(SpindleError):
    """The port is absent, busy or vanished."""

    default_code = "link"


class NoAnswer(LinkError):
    """The unit stayed silent until the deadline.

    outcome: of a change, what became of it; None where nothing was to be changed.
    """

    default_code = "no_answer"

    def __init__(
        self,
        message: str,
        code: str | None = None,
        fields: Iterable[FieldError] = (),
        outcome: Outcome | None = None,
    ) -> None:
        super().__init__(message, code, fields)
        self.outcome = outcome


class PeerProtocolError(SpindleError):
    """The unit sent what the protocol does not allow."""

    default_code = "peer_protocol"


class OurProtocolError(SpindleError):
    """We asked for what the protocol does not allow: a bug of ours."""

    default_code = "our_protocol"


class DeviceRefused(SpindleError):
    """The unit answered with a status other than OK.

    status: name of the protocol's status (`RANGE`). detail: the number that came with it.
    """

    default_code = "device_refused"

    def __init__(
        self,
        message: str,
        status: str = "",
        detail: int = 0,
        code: str | None = None,
        fields: Iterable[FieldError] = (),
    ) -> None:
        super().__init__(message, code or (status.lower() or None), fields)
        self.status = status
        self.detail = detail


class RequestRefused(SpindleError):
    """We or the unit said no, and nothing changed."""

    default_code = "refused"


class InvalidRequest(RequestRefused):
    """The values make no sense together or on their own."""

    default_code = "invalid"


class LimitViolation(RequestRefused):
    """At least one value is outside what its parameter allows."""

    default_code = "out_of_range"


class ConfigConflict(RequestRefused):
    """The configuration is no longer the one the change was made for."""

    default_code = "config_changed"


class OtherUnit(RequestRefused):
    """The unit on the connection is not the one that was meant; it was asked for nothing."""

    default_code = "other_unit"


class AccessDenied(RequestRefused):
    """The parameter needs a higher access level or a token."""

    default_code = "access_denied"


class TokenNeeded(AccessDenied):
    """The unit would do it for a token of its maker.

    challenge: what has to be signed: uid, nonce, level, ttl_s, expires_us, and the image with its
    SHA-512 in hex.
    """

    default_code = "token_needed"

    def __init__(
        self,
        message: str,
        challenge: Mapping[str, str | int],
        fields: Iterable[FieldError] = (),
    ) -> None:
        super().__init__(message, None, fields)
        self.challenge = dict(challenge)


class NotSignedIn(RequestRefused):
    """Nobody is known to ask, or the password is wrong."""

    default_code = "sign_in_first"


class NotAllowed(RequestRefused):
    """The caller is known, and their role or key does not allow it."""

    default_code = "not_allowed"


class TooManyTries(RequestRefused):
    """Wrong passwords came too often. wait_s: until the next one is looked at."""

    default_code = "too_many_tries"

    def __init__(self, message: str, wait_s: float) -> None:
        super().__init__(message)
        self.wait_s = wait_s


class NotStandingStill(RequestRefused):
    """The wheel or the motor turns, and this needs them at rest."""

    default_code = "not_standing_still"


class Conflict(RequestRefused):
    """The thing is not in a state that allows this."""

    default_code = "conflict"


class NameFirst(Conflict):
    """A unit without a serial number and without a name was to be written."""

    default_code = "name_first"


class CapabilityMissing(Conflict):
    """The unit cannot do this, and no unit of its make can. capability: the word for it."""

    default_code = "capability_missing"

    def __init__(self, message: str, capability: str) -> None:
        super().__init__(message, fields=[FieldError(capability, "capability_missing", message)])
        self.capability = capability


class NotFound(RequestRefused):
    """No such device, ride, upload or port."""

    default_code = "not_found"


class BadFile(SpindleError):
    """A log that cannot be read at all; the message says where it breaks and why."""

    default_code = "bad_file"


class StoreError(SpindleError):
    """The database or the object store failed; the message names which and what was not saved."""

    default_code = "store"


class ObjectsAway(StoreError):
    """A bucket does not answer, or refuses: what is in it is not known, so nothing is missing."""

    default_code = "objects_unreachable"


class StoreFull(StoreError):
    """The disk of the database or of the object store has no room left."""

    default_code = "disk_full"


class ObjectDamaged(StoreError):
    """A file of the store is missing or is not what was written; nothing of it was sent."""

    default_code = "object_damaged"
