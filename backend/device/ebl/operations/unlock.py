"""Changes that need the maker's word: what the unit wants signed, and showing it the signature."""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Mapping

from backend.device.ebl.session.operation import Operation, attempt, expect
from backend.device.ebl.session.refusals import refused
from backend.errors import (
    AccessDenied,
    FieldError,
    InvalidRequest,
    NotStandingStill,
    SpindleError,
    TokenNeeded,
)
from firmware_protocol._generated import (
    BAND_BY_NAME,
    PARAMETER_BY_NAME,
    Access,
    AuthChallengeRequest,
    AuthChallengeResponse,
    AuthResponseRequest,
    AuthResponseResponse,
    Status,
)
from firmware_protocol.bands import band_limits, leaves_band
from firmware_protocol.layout import Band, Parameter, Value
from firmware_protocol.spelling import word_of
from firmware_protocol.unlock_token import Token

__all__ = ["Token", "access_refused", "show_token", "token_from"]

AGAIN = "Write once more without a token to get a new challenge. Nothing was changed."
NEXT_STEPS = {
    "wheel_circumference_m": "Measure it once more, with a rider on the bike.",
    "sensor_gain_nm_per_count": (
        "Check weight and lever first; if they are right, the sensor is damaged or another one."
    ),
    "sensor_offset_counts": (
        "Take every load off the pedals and read the zero again; if it stays, the sensor is bent."
    ),
}
"""What to try before the maker is asked, for each parameter with a band."""
LEVELS = (Access.DEALER, Access.FACTORY)


def token_from(text: str) -> Token:
    """A token as a person brings it. Raises InvalidRequest."""
    try:
        return Token.from_hex(text)
    except (ValueError, struct.error) as error:
        raise InvalidRequest(f"This is not a token ({error}).", "no_token") from None


def show_token(transaction: int, token: Token) -> Operation[None]:
    """Show the unit a token for what is staged.

    Raises AccessDenied with the unit's reason, NotStandingStill while the bike moves.
    """
    request = AuthResponseRequest(transaction, token.expires_us, token.signature)
    response = yield from attempt(request)
    if response.status == Status.NOT_STOPPED:
        raise NotStandingStill(
            "The unit looks at no token while wheel or motor turn. Stop the bike and write again "
            "with the same token within its minute; it was not used up, and nothing was changed."
        )
    if response.status == Status.AUTH_BAD:
        raise AccessDenied(
            "The unit refuses this token: it was made for another unit, another change, another "
            f"challenge, or with another key. {AGAIN}",
            "token_refused",
        )
    if response.status in (Status.EXPIRED, Status.STATE):
        raise AccessDenied(
            f"The challenge this token answers is over: it holds for a minute and one attempt. "
            f"{AGAIN}",
            "token_expired",
        )
    if response.status in (Status.AUTH_DELAY, Status.NOT_FOUND):
        raise unlock_refused(response.status, response.detail)
    expect(request, response, AuthResponseResponse)


def unlock_refused(status: int, seconds: int) -> AccessDenied:
    """Why a unit does not even listen to tokens."""
    if status == Status.AUTH_DELAY:
        return AccessDenied(
            f"The unit takes no token for another {seconds} s, because a wrong one came before. "
            "Wait and write once more. Nothing was changed.",
            "token_delay",
        )
    return AccessDenied(
        "This needs the maker's token, and this unit carries no maker's key: nobody can change it "
        "in this unit. Nothing was changed."
    )


LOST = (
    "What the maker chose for this unit is damaged or was never there; whatever is written in its "
    "place needs the maker's word."
)
"""Why a change that is no more than a dealer's is refused."""


def access_refused(
    level: int, base: Mapping[str, Value], changes: Mapping[str, Value], image: bytes
) -> Operation[SpindleError]:
    """The error for a change the unit does not grant: TokenNeeded with its challenge, or why not.

    image: the whole configuration that was to become active.
    """
    fields = protected(base, changes)
    reason = " ".join(field.message for field in fields) or LOST
    needed_level = level if level in LEVELS else Access.FACTORY
    request = AuthChallengeRequest(needed_level)
    response = yield from attempt(request)
    if response.status in (Status.AUTH_DELAY, Status.NOT_FOUND, Status.UNKNOWN_MSG):
        error = unlock_refused(response.status, response.detail)
        return AccessDenied(f"{reason} {error.message}".strip(), error.code, fields)
    if response.status != Status.OK:
        return refused(request, response)
    challenge = expect(request, response, AuthChallengeResponse)
    return TokenNeeded(
        f"{reason} The unit wants a token from its maker for exactly this change within "
        f"{challenge.ttl_s} s; `challenge` is what has to be signed. Nothing was changed.",
        {
            "uid": challenge.uid.hex(),
            "nonce": challenge.nonce.hex(),
            "level": word_of(Access(challenge.level).name),
            "ttl_s": challenge.ttl_s,
            "expires_us": challenge.expires_us,
            "image": image.hex(),
            "image_sha512": hashlib.sha512(image).hexdigest(),
        },
        fields,
    )


def protected(base: Mapping[str, Value], changes: Mapping[str, Value]) -> list[FieldError]:
    """The changes that need a token: factory parameters, limits that go up, and bands left."""
    names = []
    intended = {**base, **changes}
    for name, value in changes.items():
        row = PARAMETER_BY_NAME[name]
        if value == base[name]:
            continue
        if row.access == Access.FACTORY:
            message = f"{name} may only be changed by the factory."
            names.append(FieldError(name, "access_denied", message))
        elif row.ratchet and is_raised(base[name], value):
            names.append(FieldError(name, "token_needed", raised(row, base[name], value)))
        elif name in BAND_BY_NAME and leaves_band(BAND_BY_NAME[name], base, intended):
            names.append(FieldError(name, "outside_band", left(BAND_BY_NAME[name], row, intended)))
    return names


def is_raised(old: Value, new: Value) -> bool:
    """Whether a number went up; ratchets are single numbers."""
    return isinstance(old, float | int) and isinstance(new, float | int) and new > old


def raised(row: Parameter, old: Value, new: Value) -> str:
    """The message to a person about a limit that should go up."""
    return (
        f"{row.name} should go up from {old} to {new} {row.unit}; this limit goes down freely and "
        "up only with a token."
    )


def left(band: Band, row: Parameter, intended: Mapping[str, Value]) -> str:
    """The message about a value too far from what the factory measured, and what to do next."""
    low, high = band_limits(band, intended)
    within = f"{band.within_pct:g} %" if band.within_pct else f"{band.within:g} {band.unit}"
    return (
        f"{row.name} should become {intended[row.name]} {row.unit}; from {low} to {high} "
        f"it may be set here, which is within {within} of the factory's {intended[band.around]}. "
        f"{NEXT_STEPS[band.parameter]} Beyond that it needs the maker's token."
    )
