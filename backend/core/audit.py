"""What the audit says of a change: what was done to what, and what was otherwise before.

`append` of the store adds it to the chain, in the transaction of the change.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Literal, TypeAlias, get_args

Members: TypeAlias = Mapping[str, Any]
ObjectKind: TypeAlias = Literal[
    "account",
    "key",
    "bike",
    "unit",
    "configuration",
    "calibration",
    "visit",
    "ride",
    "upload",
    "table",
    "library_item",
    "store",
]


class Action(StrEnum):
    """What was done. It begins with what it was done to."""

    ACCOUNT_ADDED = "account_added"
    ACCOUNT_FIRST_ADDED = "account_first_added"
    ACCOUNT_CHANGED = "account_changed"
    ACCOUNT_PASSWORD_SET = "account_password_set"
    ACCOUNT_PASSKEY_ADDED = "account_passkey_added"
    ACCOUNT_PASSKEY_REMOVED = "account_passkey_removed"
    ACCOUNT_REMOVED = "account_removed"
    ACCOUNT_SIGNED_IN = "account_signed_in"
    ACCOUNT_SIGNED_OUT_EVERYWHERE = "account_signed_out_everywhere"
    KEY_ADDED = "key_added"
    KEY_REVOKED = "key_revoked"
    BIKE_ADDED = "bike_added"
    BIKE_CHANGED = "bike_changed"
    BIKE_UNIT_CHANGED = "bike_unit_changed"
    BIKE_REMOVED = "bike_removed"
    BIKE_OFFERED = "bike_offered"
    BIKE_TAKEN = "bike_taken"
    BIKE_LEFT = "bike_left"
    BIKE_RIDES_GIVEN = "bike_rides_given"
    UNIT_FIRST_SEEN = "unit_first_seen"
    UNIT_CONNECTED = "unit_connected"
    UNIT_NAMED = "unit_named"
    UNIT_REMOVED = "unit_removed"
    UNIT_FAULTS_CLEARED = "unit_faults_cleared"
    UNIT_LOG_ERASED = "unit_log_erased"
    UNIT_VALUES_TRIED = "unit_values_tried"
    UNIT_VALUES_ENDED = "unit_values_ended"
    CONFIGURATION_FOUND = "configuration_found"
    CONFIGURATION_WRITTEN = "configuration_written"
    CONFIGURATION_TRIED = "configuration_tried"
    CONFIGURATION_CONFIRMED = "configuration_confirmed"
    CONFIGURATION_ROLLED_BACK = "configuration_rolled_back"
    CALIBRATION_OPENED = "calibration_opened"
    CALIBRATION_WRITTEN = "calibration_written"
    CALIBRATION_RESTORED = "calibration_restored"
    CALIBRATION_CLOSED = "calibration_closed"
    VISIT_OPENED = "visit_opened"
    VISIT_CLOSED = "visit_closed"
    VISIT_CONSENTED = "visit_consented"
    VISIT_REMOVED = "visit_removed"
    VISIT_BROUGHT = "visit_brought"
    RIDE_CHANGED = "ride_changed"
    RIDE_DELETED = "ride_deleted"
    UPLOAD_DELETED = "upload_deleted"
    TABLE_ANSWERED = "table_answered"
    TABLE_FORGOTTEN = "table_forgotten"
    LIBRARY_ITEM_ADDED = "library_item_added"
    LIBRARY_ITEM_CHANGED = "library_item_changed"
    LIBRARY_ITEM_REMOVED = "library_item_removed"
    STORE_BACKED_UP = "store_backed_up"
    STORE_REBUILT = "store_rebuilt"

    @property
    def object_kind(self) -> ObjectKind:
        """What it is done to."""
        kinds: tuple[ObjectKind, ...] = get_args(ObjectKind)
        return next(kind for kind in kinds if self.startswith(f"{kind}_"))


@dataclass(frozen=True)
class AuditEntry:
    """A change that was made, but for who and when.

    object_id, name: of what it was done to. before, after: plain JSON of what differs by name,
    None for nothing; no secret, and no word that somebody wrote of a ride, since what is deleted
    must not live on in what nobody can delete. reason: why, as its author says. unit_key: of the
    unit it concerns. bike_id: of its bike; None for the one the unit is on.
    """

    action: Action
    object_id: int | str | None = None
    name: str | None = None
    before: Members | None = None
    after: Members | None = None
    reason: str = ""
    unit_key: str | None = None
    bike_id: int | None = None


# Adds an entry on its own, for what is done to a unit and not to the database; raises StoreError.
Note: TypeAlias = Callable[[AuditEntry], None]


def no_note(entry: AuditEntry) -> None:
    """Where nothing is kept."""


def differing(before: Members, after: Members) -> tuple[Members, Members]:
    """Of two states by name, the members that are not the same; one that is in one of them only is
    None in the other."""
    names = [name for name in sorted({*before, *after}) if before.get(name) != after.get(name)]
    return {name: before.get(name) for name in names}, {name: after.get(name) for name in names}
