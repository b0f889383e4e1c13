"""Tuning: a unit's configuration read, changed as a transaction, proven, and remembered.

A change is checked here with every fault named, checked again by the unit on its own, committed
whole on the configuration it was made for, read back and compared field by field. What the unit had
before is in the revision book first, so that no write loses anything.
"""

from __future__ import annotations

import threading
import time
from collections import defaultdict
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import asdict
from datetime import UTC, datetime

from backend.core.audit import Action
from backend.core.revision import Revision, RevisionLog
from backend.device.capability import Capability
from backend.device.configuration import NO_TRIAL, ConfigImage, ParameterTable, Value
from backend.device.unit import Unit
from backend.errors import Conflict, FieldError, InvalidRequest, LimitViolation, NoAnswer, NotFound
from backend.tuning.parts import PARTS, ConfigPart
from backend.tuning.revisions import TRIED, VERIFIED, Meant, RevisionBook
from backend.tuning.types import (
    Config,
    ConfigChange,
    LastKnown,
    Parameter,
    ParameterChange,
    TypedView,
    check_base,
    differences,
)
from backend.units.outcome import find_outcome, telling
from backend.units.service import Devices

RETURNED_REASON = "Returned to: the trial before was given up."
CONFIRMED_REASON = "Kept after its trial."
CONFIRM_S_MAX = 255
ACTIVE = "active"


class Tuning:
    """Reads and changes configurations. For any thread; one change at a time for each device.

    now_s: Unix time.
    """

    def __init__(
        self,
        devices: Devices,
        revisions: RevisionLog,
        now_s: Callable[[], float] = time.time,
    ) -> None:
        self._devices = devices
        self._book = RevisionBook(revisions)
        self._now_s = now_s
        self._lock = threading.Lock()
        self._writing: defaultdict[str, threading.Lock] = defaultdict(threading.Lock)

    # ------------------------------------------------------------------ reading

    def parameters(self, device_id: str) -> list[Parameter]:
        """Every parameter with its bounds and its value now. Raises NotFound, NoAnswer."""
        unit = self._devices.writable(device_id)
        return _views(unit.parameters, unit.read_config().parameters)

    def read_config(self, device_id: str, bank: str = ACTIVE) -> Config:
        """A whole configuration of the unit: `active`, `previous` or `default`.

        Raises NotFound, also where the unit never had a previous one, and NoAnswer.
        """
        key, unit = self._devices.pinned(device_id)
        config = unit.read_config() if bank == ACTIVE else unit.read_bank(bank)
        return Config(key, config.generation, config.crc32, config.parameters)

    def read_part(self, device_id: str, name: str) -> TypedView:
        """A part of the configuration in the shape people edit; name: one of `PARTS`.

        Raises CapabilityMissing for a unit without it, NotFound, NoAnswer.
        """
        key, unit = self._devices.pinned(device_id)
        part = _part(unit, name)
        config = unit.read_config()
        value = part.read(config.parameters)
        if part.unknown_while_lost and unit.settings_are_lost():
            value = {**value, **dict.fromkeys(part.unknown_while_lost)}
        return TypedView(key, config.generation, config.crc32, value)

    def revisions(self, device_id: str) -> Sequence[Revision]:
        """Every configuration the unit is known to have had, newest first."""
        return self._book.list(self._devices.last_known_key(device_id))

    def last_known(self, device_id: str) -> LastKnown:
        """What the unit was last known to be set to, whether it is connected or not.

        What was on trial is left out: a unit that nobody hears gives it up by itself. Raises
        NotFound, also where no configuration of the unit is kept, and NoAnswer where nobody knows
        which unit it is.
        """
        device = self._devices.get(device_id)
        newest = next((one for one in self.revisions(device_id) if one.state != TRIED), None)
        if newest is None:
            raise NotFound(f"No configuration of the unit at {device.url} is kept.", "never_read")
        return LastKnown(
            newest.unit_key,
            device.last_seen_at,
            newest.created_at,
            newest.generation,
            newest.crc32,
            tuple(_views(self._devices.unit(device_id).parameters, newest.parameters)),
        )

    # ------------------------------------------------------------------ writing

    def write_part(
        self,
        device_id: str,
        name: str,
        value: Mapping[str, object],
        reason: str = "",
        if_match: str | None = None,
        confirm_s: int = 0,
        token: str | None = None,
        author: str = "",
    ) -> ConfigChange:
        """Write a whole part in one transaction; as `write_config`, with the part's own names.

        The second table shares its points with the first: other ones are refused, so that nobody
        changes the first without looking at it.
        """
        part = _part(self._devices.writable(device_id), name)
        changes = part.changes(value)
        # A part is of the unit that it is written to: the sensor's calibration is one.
        own = self._devices.unit_key(device_id)
        try:
            return self.write_config(
                device_id,
                changes,
                reason,
                if_match,
                confirm_s,
                author,
                token,
                part.compared,
                own,
                own,
            )
        except LimitViolation as error:
            fields = [part.renamed(fault) for fault in error.fields]
            raise LimitViolation(error.message, error.code, fields) from error

    def write_config(
        self,
        device_id: str,
        changes: Mapping[str, Value],
        reason: str = "",
        if_match: str | None = None,
        confirm_s: int = 0,
        author: str = "",
        token: str | None = None,
        compared: Collection[str] = (),
        unit_key: str | None = None,
        read_from: str | None = None,
    ) -> ConfigChange:
        """Write all of `changes` or none, read everything back and compare.

        if_match: ETag of the configuration the change was made for. confirm_s: 0 for good; else the
        change is on trial, and the unit returns to what it had unless `confirm_config` comes within
        so many seconds. token: the maker's answer to TokenNeeded. compared: names among `changes`
        that are there to be compared: another value than the unit's is refused. unit_key: of the
        unit the change is for; None for the one that is there. read_from: the key of the unit the
        values were read from, None where they were not, or nobody says: what stays with a unit is
        refused of another one. Raises InvalidRequest, LimitViolation with every fault named,
        TokenNeeded, AccessDenied, ConfigConflict, OtherUnit, NotStandingStill, CapabilityMissing,
        NameFirst; after each of them the unit is unchanged. NoAnswer says in `outcome` what became
        of the change. PeerProtocolError names the fields that read back different.
        """
        if not 0 <= confirm_s <= CONFIRM_S_MAX:
            raise InvalidRequest(f"confirm_s is from 0 to {CONFIRM_S_MAX} seconds.")
        key, unit = self._devices.own(device_id, unit_key)
        unit.require(Capability.WRITE_CONFIG)
        if confirm_s:
            unit.require(Capability.UNIT_TRIAL)
        permit = None if token is None else unit.permit(token)
        unknown = unit.parameters.unknown_names(changes)
        if unknown:
            raise InvalidRequest(" ".join(fault.message for fault in unknown), fields=unknown)
        with self._turn(device_id), telling("unchanged"):
            base = unit.read_config()
            check_base(key, base, if_match)
            intended = _intended(unit.parameters, base, changes)
            changed = differences(base.parameters, intended)
            _check_compared(changed, compared)
            if read_from != key:
                _check_of_this_unit(unit.parameters, changed, read_from)
            self._book.back_up(key, base)
            written = base
            writes = bool(changed) or unit.settings_are_lost()
            if writes:
                crc32 = unit.parameters.crc32_of(intended)
                state, action = (
                    (TRIED, Action.CONFIGURATION_TRIED)
                    if confirm_s
                    else (VERIFIED, Action.CONFIGURATION_WRITTEN)
                )
                meant = Meant(crc32, changed, reason, author, state, action)
                try:
                    written = self._commit(
                        device_id, key, base, intended, changed, confirm_s, permit
                    )
                except NoAnswer as error:
                    if error.outcome == "unknown":
                        self._book.leave_open(key, meant)
                    raise
                self._book.note(key, written, meant)
        if writes and confirm_s:
            with telling("changed"):
                expires_at = self._expires_at(unit, written)
            return ConfigChange.of(key, written, "provisional", changed, expires_at)
        waits = writes and Capability.RESTART_TO_APPLY in unit.capabilities
        return ConfigChange.of(key, written, "needs_restart" if waits else "committed", changed)

    def confirm_config(self, device_id: str, author: str = "") -> ConfigChange:
        """Keep the change on trial, after reading it back and comparing it field by field.

        Raises Conflict when nothing is on trial or what is on trial was not written by this
        Spindle, PeerProtocolError naming fields that read back different, NotFound, NameFirst,
        NoAnswer.
        """
        key, unit = self._devices.own(device_id)
        with self._turn(device_id), telling("unchanged"):
            trial = unit.trial()
            if not trial.on_trial:
                raise Conflict(NO_TRIAL, "no_trial")
            meant = self._book.newest_if(key, trial.crc32)
            if meant is None:
                raise Conflict(
                    "What is on trial was not written by this Spindle, so it does not know what "
                    "was meant. Revert it, or keep it with the tool that wrote it.",
                    "unknown_trial",
                )
            tried = ConfigImage(trial.generation, trial.crc32, dict(meant.parameters))
            confirmed = self._certainly(
                device_id,
                key,
                lambda unit: unit.confirm_config(tried.parameters),
                lambda unit: unit.outcome_of_confirm(tried),
            )
            reason = f"Kept after its trial: {meant.reason}" if meant.reason else CONFIRMED_REASON
            done = Action.CONFIGURATION_CONFIRMED
            kept = Meant(confirmed.crc32, (), reason, author, VERIFIED, done)
            self._book.note(key, confirmed, kept)
        return ConfigChange.of(key, confirmed)

    def rollback_config(self, device_id: str, author: str = "") -> ConfigChange:
        """Give up the change on trial; what the unit has then is read back.

        changed: from what was on trial to what is active again. Raises Conflict without a trial,
        NotFound, NoAnswer.
        """
        key, unit = self._devices.own(device_id)
        unit.require(Capability.UNIT_TRIAL)
        with self._turn(device_id), telling("unchanged"):
            tried = unit.read_config()
            rolled_back = self._certainly(
                device_id,
                key,
                lambda unit: unit.rollback_config(),
                lambda unit: unit.outcome_of_rollback(tried),
            )
            changed = differences(tried.parameters, rolled_back.parameters)
            done = Action.CONFIGURATION_ROLLED_BACK
            meant = Meant(rolled_back.crc32, changed, RETURNED_REASON, author, VERIFIED, done)
            self._book.note(key, rolled_back, meant)
        return ConfigChange.of(key, rolled_back, changed=changed)

    def note_trial_end(self, device_id: str) -> None:
        """Note what the unit has, if the newest it is known to have had was on trial and is over.

        For a trial that ended without us: its time ran out, or the unit restarted; and for a change
        whose answer never came. Raises NotFound, NoAnswer, StoreError.
        """
        with self._turn(device_id):
            key, unit = self._devices.pinned(device_id)
            if self._book.may_have_ended(key):
                self._book.back_up(key, unit.read_config())

    # ------------------------------------------------------------------ inside

    def _turn(self, device_id: str) -> threading.Lock:
        """The lock that makes changes of one device wait for each other."""
        device_key = self._devices.get(device_id).id
        with self._lock:
            return self._writing[device_key]

    def _commit(
        self,
        device_id: str,
        key: str,
        base: ConfigImage,
        intended: Mapping[str, Value],
        changed: Sequence[ParameterChange],
        confirm_s: int,
        permit: object,
    ) -> ConfigImage:
        changes = {change.name: change.new for change in changed}
        return self._certainly(
            device_id,
            key,
            lambda unit: unit.write_config(base, changes, confirm_s, permit),
            lambda unit: unit.outcome_of_write(base, intended),
        )

    def _certainly(
        self,
        device_id: str,
        key: str,
        change: Callable[[Unit], ConfigImage],
        read: Callable[[Unit], ConfigImage],
    ) -> ConfigImage:
        """Make a change; where nobody said what became of it, find out by `read`."""
        try:
            with telling("unknown"):
                return change(self._devices.own(device_id, key)[1])
        except NoAnswer as error:
            if error.outcome != "unknown":
                raise
            return find_outcome(self._devices, device_id, key, read, error)

    def _expires_at(self, unit: Unit, written: ConfigImage) -> datetime:
        """When the unit gives up what was just written on trial, by its own count."""
        trial = unit.trial()
        if not trial.on_trial or trial.crc32 != written.crc32:
            raise NoAnswer(
                "The unit gave the change up while it was read back: its time was too short for "
                "this link. Write again with more time."
            )
        return datetime.fromtimestamp(self._now_s() + trial.left_s, UTC)


def _views(table: ParameterTable, values: Mapping[str, Value]) -> list[Parameter]:
    """Every parameter that has a value."""
    values_by_name = {row.name: values[row.name] for row in table.rows if row.name in values}
    is_complete = len(values_by_name) == len(table.rows)
    return [
        Parameter(
            **asdict(row),
            value=values_by_name[row.name],
            free=table.free_of(row.name, values_by_name) if is_complete else None,
        )
        for row in table.rows
        if row.name in values_by_name
    ]


def _part(unit: Unit, name: str) -> ConfigPart:
    """The part for this unit. Raises CapabilityMissing."""
    kind = PARTS[name]
    unit.require(Capability.READ_CONFIG, kind.capability)
    return kind.of(unit.parameters)


def _check_compared(changed: Sequence[ParameterChange], compared: Collection[str]) -> None:
    """Raise LimitViolation naming what was to stay as it is."""
    faults = [
        FieldError(
            change.name, "shared", "Both tables share these points; change them in the first."
        )
        for change in changed
        if change.name in compared
    ]
    if faults:
        raise LimitViolation(faults[0].message, "shared_points", faults)


def _check_of_this_unit(
    table: ParameterTable, changed: Sequence[ParameterChange], read_from: str | None
) -> None:
    """Raise LimitViolation naming what stays with a unit, of values that are not this unit's own.

    Of values that nobody says are another unit's, those alone that no one types: the record of a
    calibration.
    """
    rows = {row.name: row for row in table.rows}
    faults = [
        FieldError(
            change.name,
            "of_another_unit",
            f"{change.name} stays with the unit it was measured on: leave it out, or say in "
            "`read_from` that it was read from this one.",
        )
        for change in changed
        if rows[change.name].of_the_unit
        and (read_from is not None or rows[change.name].group == "calibration")
    ]
    if faults:
        raise LimitViolation(faults[0].message, "of_another_unit", faults)


def _intended(
    table: ParameterTable, base: ConfigImage, changes: Mapping[str, Value]
) -> dict[str, Value]:
    """The configuration that is meant, checked whole, as the unit will hold it."""
    moved = {name: value for name, value in changes.items() if value != base.parameters[name]}
    intended = {**base.parameters, **moved}
    faults = table.faults_of(intended)
    if faults:
        raise LimitViolation(" ".join(fault.message for fault in faults), fields=faults)
    return table.rounded(intended)
