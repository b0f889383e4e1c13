"""Tuning: a unit's configuration read, changed as a transaction, proven, and remembered.

A change is checked here with every fault named, checked again by the unit on its own, committed
whole on the configuration it was made for, read back and compared field by field. What the unit had
before is in the revision log first, so that no write loses anything.
"""

from __future__ import annotations

import logging
import threading
import time
from collections import defaultdict
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import asdict, replace
from datetime import UTC, datetime

from backend.device.ebl.operations.config_settle import (
    settle_confirm,
    settle_rollback,
    settle_write,
)
from backend.device.ebl.operations.config_transaction import (
    ConfigImage,
    read_bank,
    read_config,
    write_config,
)
from backend.device.ebl.operations.config_trial import (
    NO_TRIAL,
    confirm_config,
    rollback_config,
    trial_status,
)
from backend.device.ebl.operations.fault_frames import settings_are_lost
from backend.device.ebl.operations.parameters import (
    PARAMETER_ROWS,
    Value,
    faults_of,
    free_of,
    image_crc32,
    rounded,
    unknown_names,
)
from backend.device.ebl.operations.unlock import Token, token_from
from backend.device.ebl.session.operation import Operation
from backend.device.snapshot import DeviceStatus
from backend.domain.revision import Revision
from backend.errors import (
    Conflict,
    FieldError,
    InvalidRequest,
    LimitViolation,
    NoAnswer,
    StoreError,
)
from backend.services.config_view import (
    Change,
    ConfigChange,
    ConfigView,
    ParameterView,
    RevisionLog,
    TypedView,
    check_base,
    differences,
)
from backend.services.connect import Devices
from backend.services.outcome import telling
from backend.services.settle import Unsettled, settled
from backend.services.typed_views import (
    ASSIST_MODES,
    CALIBRATION,
    FUZZY_TABLES,
    LIMITS,
    ConfigPart,
)

LOG = logging.getLogger(__name__)

# A write is some ten round trips; on a poor line each may take four attempts.
WRITE_TIMEOUT_S = 30.0
FOUND_REASON = "Found in the unit before a change."
GIVEN_UP_REASON = "Returned to by the unit itself: the trial before was not confirmed."
RETURNED_REASON = "Returned to: the trial before was given up."
KEPT_REASON = "Kept after its trial."
# States of a revision: read back and for good, or read back and on trial.
KEPT = "verified"
TRIED = "provisional"
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
        self._revisions = revisions
        self._now_s = now_s
        self._lock = threading.Lock()
        self._writing: defaultdict[str, threading.Lock] = defaultdict(threading.Lock)
        self._unsettled: dict[str, Unsettled] = {}  # by serial number

    # ------------------------------------------------------------------ reading

    def parameters(self, device_id: str) -> list[ParameterView]:
        """Every parameter with its bounds and its value now. Raises NotFound, NoAnswer."""
        config = self._read(device_id)
        return [
            ParameterView(
                **asdict(row),
                value=config.parameters[row.name],
                free=free_of(row.name, config.parameters),
            )
            for row in PARAMETER_ROWS
        ]

    def read_config(self, device_id: str, bank: str = ACTIVE) -> ConfigView:
        """A whole configuration of the unit: `active`, `previous` or `default`.

        Raises NotFound, also where the unit never had a previous one, and NoAnswer.
        """
        if bank == ACTIVE:
            config = self._read(device_id)
        else:
            mtu = self._devices.writable(device_id).mtu
            config = self._devices.run(device_id, read_bank(bank, mtu))
        return ConfigView(config.generation, config.crc32, config.parameters)

    def revisions(self, device_id: str) -> Sequence[Revision]:
        """Every configuration the unit is known to have had, newest first."""
        return self._revisions.list(self._serial_number(self._devices.status(device_id)))

    # ------------------------------------------------------------------ changing

    def write_config(
        self,
        device_id: str,
        changes: Mapping[str, Value],
        reason: str = "",
        if_match: str | None = None,
        confirm_s: int = 0,
        author: str = "",
        token: str | None = None,
        kept: Collection[str] = (),
    ) -> ConfigChange:
        """Write all of `changes` or none, read everything back and compare.

        if_match: ETag of the configuration the change was made for. confirm_s: 0 for good; else the
        change is on trial, and the unit returns to what it had unless `confirm_config` comes within
        so many seconds. token: the maker's answer to TokenNeeded. kept: names among `changes`
        that are there to be compared: another value than the unit's is refused. Raises
        InvalidRequest, LimitViolation with every fault named, TokenNeeded, AccessDenied,
        ConfigConflict, NotStandingStill; after each of them the unit is unchanged. NoAnswer says
        in `outcome` what became of the change. PeerProtocolError names the fields that read back
        different.
        """
        if not 0 <= confirm_s <= CONFIRM_S_MAX:
            raise InvalidRequest(f"confirm_s is from 0 to {CONFIRM_S_MAX} seconds.")
        permit = None if token is None else token_from(token)
        unknown = unknown_names(changes)
        if unknown:
            raise InvalidRequest(" ".join(fault.message for fault in unknown), fields=unknown)
        with self._turn(device_id), telling("unchanged"):
            base = self._read(device_id)
            check_base(base, if_match)
            intended = _intended(base, changes)
            changed = differences(base.parameters, intended)
            _check_kept(changed, kept)
            serial_number = self._serial_number(self._devices.status(device_id))
            self._back_up(serial_number, base)
            writes = bool(changed) or self._devices.run(device_id, settings_are_lost())
            if writes:
                state = TRIED if confirm_s else KEPT
                try:
                    found = self._commit(device_id, base, intended, changed, confirm_s, permit)
                except NoAnswer as error:
                    if error.outcome == "unknown":
                        meant = Unsettled(image_crc32(intended), changed, reason, author, state)
                        self._unsettled[serial_number] = meant
                    raise
                self._remember(serial_number, found, changed, reason, author, state)
                base = found
        if not writes or not confirm_s:
            return ConfigChange(base.generation, base.crc32, "committed", True, changed, None)
        with telling("changed"):
            expires_at = self._expires_at(device_id, base)
        return ConfigChange(base.generation, base.crc32, "provisional", True, changed, expires_at)

    def confirm_config(self, device_id: str, author: str = "") -> ConfigChange:
        """Keep the change on trial, after reading it back and comparing it field by field.

        Raises Conflict when nothing is on trial or what is on trial was not written by this
        Spindle, PeerProtocolError naming fields that read back different, NotFound, NoAnswer.
        """
        with self._turn(device_id), telling("unchanged"):
            status = self._devices.status(device_id)
            serial_number = self._serial_number(status)
            trial = self._devices.run(device_id, trial_status())
            if not trial.on_trial:
                raise Conflict(NO_TRIAL, "no_trial")
            meant = self._known(serial_number, trial.crc32)
            if meant is None:
                raise Conflict(
                    "What is on trial was not written by this Spindle, so it does not know what "
                    "was meant. Revert it, or keep it with the tool that wrote it.",
                    "unknown_trial",
                )
            tried = ConfigImage(trial.generation, trial.crc32, dict(meant.parameters))
            found = self._certainly(
                device_id,
                confirm_config(meant.parameters, status.mtu),
                lambda _: settle_confirm(tried),
            )
            reason = f"Kept after its trial: {meant.reason}" if meant.reason else KEPT_REASON
            self._remember(serial_number, found, (), reason, author, KEPT)
        return ConfigChange(found.generation, found.crc32, "committed", True, (), None)

    def rollback_config(self, device_id: str, author: str = "") -> ConfigChange:
        """Give up the change on trial; what the unit has then is read back.

        changed: from what was on trial to what is active again. Raises Conflict without a trial,
        NotFound, NoAnswer.
        """
        with self._turn(device_id), telling("unchanged"):
            tried = self._read(device_id)
            mtu = self._devices.status(device_id).mtu
            found = self._certainly(
                device_id, rollback_config(mtu), lambda mtu: settle_rollback(tried, mtu)
            )
            changed = differences(tried.parameters, found.parameters)
            serial_number = self._serial_number(self._devices.status(device_id))
            self._remember(serial_number, found, changed, RETURNED_REASON, author, KEPT)
        return ConfigChange(found.generation, found.crc32, "committed", True, changed, None)

    def note_trial_end(self, device_id: str) -> None:
        """Note what the unit has, if the newest it is known to have had was on trial and is over.

        For a trial that ended without us: its time ran out, or the unit restarted; and for a change
        whose answer never came. Raises NotFound, NoAnswer, StoreError.
        """
        with self._turn(device_id):
            serial_number = self._serial_number(self._devices.status(device_id))
            newest = self._revisions.list(serial_number, 1)
            on_trial = bool(newest) and newest[0].state == TRIED
            if on_trial or serial_number in self._unsettled:
                self._back_up(serial_number, self._read(device_id))

    # ------------------------------------------------------------------ typed views

    def fuzzy_table(self, device_id: str, which: str = "first") -> TypedView:
        """A rule table as the contract's `fuzzy_table`. which: `first` or `second`."""
        return self._part(device_id, FUZZY_TABLES[which])

    def put_fuzzy_table(
        self,
        device_id: str,
        value: Mapping[str, object],
        reason: str,
        if_match: str | None,
        confirm_s: int = 0,
        which: str = "first",
        token: str | None = None,
    ) -> ConfigChange:
        """Write a whole rule table in one transaction.

        The second shares the points of speed and torque rate with the first: other ones are
        refused, so that nobody changes the first table without looking at it.
        """
        part = FUZZY_TABLES[which]
        return self._put_part(device_id, part, value, reason, if_match, confirm_s, token)

    def assist_modes(self, device_id: str) -> TypedView:
        """The five slots of the rider's switch."""
        return self._part(device_id, ASSIST_MODES)

    def put_assist_modes(
        self,
        device_id: str,
        value: Mapping[str, object],
        reason: str,
        if_match: str | None,
        confirm_s: int = 0,
        token: str | None = None,
    ) -> ConfigChange:
        """Write all five slots in one transaction."""
        return self._put_part(device_id, ASSIST_MODES, value, reason, if_match, confirm_s, token)

    def calibration(self, device_id: str) -> TypedView:
        """How raw counts become newton metres."""
        return self._part(device_id, CALIBRATION)

    def put_calibration(
        self,
        device_id: str,
        value: Mapping[str, object],
        reason: str,
        if_match: str | None,
        confirm_s: int = 0,
        token: str | None = None,
    ) -> ConfigChange:
        """Write offset, gain and filters in one transaction."""
        return self._put_part(device_id, CALIBRATION, value, reason, if_match, confirm_s, token)

    def limits(self, device_id: str) -> TypedView:
        """What the unit enforces whatever the table says. Where assist ends is not known while
        defaults stand in place of what was lost: at walking pace, or there is none."""
        found = self._part(device_id, LIMITS)
        if self._devices.run(device_id, settings_are_lost()):
            return replace(found, value={**found.value, "effective_assist_cutoff_kmh": None})
        return found

    def put_limits(
        self,
        device_id: str,
        value: Mapping[str, object],
        reason: str,
        if_match: str | None,
        confirm_s: int = 0,
        token: str | None = None,
    ) -> ConfigChange:
        """Write the limits in one transaction."""
        return self._put_part(device_id, LIMITS, value, reason, if_match, confirm_s, token)

    # ------------------------------------------------------------------ inside

    def _part(self, device_id: str, part: ConfigPart) -> TypedView:
        config = self._read(device_id)
        return TypedView(config.generation, config.crc32, part.read(config.parameters))

    def _put_part(
        self,
        device_id: str,
        part: ConfigPart,
        value: Mapping[str, object],
        reason: str,
        if_match: str | None,
        confirm_s: int,
        token: str | None,
    ) -> ConfigChange:
        changes = part.changes(value)
        try:
            return self.write_config(
                device_id, changes, reason, if_match, confirm_s, token=token, kept=part.kept
            )
        except LimitViolation as error:
            fields = [part.renamed(fault) for fault in error.fields]
            raise LimitViolation(error.message, error.code, fields) from error

    def _turn(self, device_id: str) -> threading.Lock:
        """The lock that makes changes of one device wait for each other."""
        unit_id = self._devices.get(device_id).id
        with self._lock:
            return self._writing[unit_id]

    def _read(self, device_id: str) -> ConfigImage:
        return self._devices.run(device_id, read_config(self._devices.writable(device_id).mtu))

    def _commit(
        self,
        device_id: str,
        base: ConfigImage,
        intended: Mapping[str, Value],
        changed: Sequence[Change],
        confirm_s: int,
        permit: Token | None,
    ) -> ConfigImage:
        changes = {change.name: change.new for change in changed}
        mtu = self._devices.status(device_id).mtu
        return self._certainly(
            device_id,
            write_config(base, changes, mtu, confirm_s, permit),
            lambda mtu: settle_write(base, intended, mtu),
        )

    def _certainly(
        self,
        device_id: str,
        change: Operation[ConfigImage],
        settle: Callable[[int], Operation[ConfigImage]],
    ) -> ConfigImage:
        """Make a change; where nobody said what became of it, find out by `settle`."""
        try:
            with telling("unknown"):
                return self._devices.run(device_id, change, WRITE_TIMEOUT_S)
        except NoAnswer as error:
            if error.outcome != "unknown":
                raise
            return settled(self._devices, device_id, settle, error)

    def _back_up(self, serial_number: str, base: ConfigImage) -> None:
        """Keep what the unit has if the log does not know it; a write that cannot is refused."""
        unsettled = self._unsettled.pop(serial_number, None)
        newest = self._revisions.list(serial_number, 1)
        if not newest or newest[0].crc32 != base.crc32:
            if unsettled is not None and unsettled.crc32 == base.crc32:
                # The change was made after all: the log has it with its author's own reason.
                lost = unsettled
                self._remember(
                    serial_number, base, lost.changed, lost.reason, lost.author, lost.state
                )
                return
            given_up = bool(newest) and newest[0].state == TRIED
            self._revisions.append(
                serial_number,
                base.parameters,
                reason=GIVEN_UP_REASON if given_up else FOUND_REASON,
                generation=base.generation,
                crc32=base.crc32,
            )

    def _remember(
        self,
        serial_number: str,
        found: ConfigImage,
        changed: Sequence[Change],
        reason: str,
        author: str,
        state: str,
    ) -> None:
        try:
            self._revisions.append(
                serial_number,
                found.parameters,
                [asdict(change) for change in changed],
                reason,
                author,
                found.generation,
                found.crc32,
                state,
            )
        except StoreError as error:
            # The unit has the change and it is proven; the next write will keep it as found.
            LOG.error("%s: a proven change could not be noted: %s", serial_number, error.message)

    def _known(self, serial_number: str, crc32: int) -> Revision | None:
        """The newest configuration in the log, if it is the one with this checksum."""
        newest = self._revisions.list(serial_number, 1)
        return newest[0] if newest and newest[0].crc32 == crc32 else None

    def _expires_at(self, device_id: str, written: ConfigImage) -> datetime:
        """When the unit gives up what was just written on trial, by its own count."""
        trial = self._devices.run(device_id, trial_status())
        if not trial.on_trial or trial.crc32 != written.crc32:
            raise NoAnswer(
                "The unit gave the change up while it was read back: its time was too short for "
                "this link. Write again with more time."
            )
        return datetime.fromtimestamp(self._now_s() + trial.left_s, UTC)

    @staticmethod
    def _serial_number(status: DeviceStatus) -> str:
        if status.identity is None:
            raise NoAnswer(status.reason, "not_connected")
        return status.identity.serial_number


def _check_kept(changed: Sequence[Change], kept: Collection[str]) -> None:
    """Raise LimitViolation naming what was to stay as it is."""
    faults = [
        FieldError(
            change.name, "shared", "Both tables share these points; change them in the first."
        )
        for change in changed
        if change.name in kept
    ]
    if faults:
        raise LimitViolation(faults[0].message, "shared_points", faults)


def _intended(base: ConfigImage, changes: Mapping[str, Value]) -> dict[str, Value]:
    """The configuration that is meant, checked whole, as the unit will hold it."""
    moved = {name: value for name, value in changes.items() if value != base.parameters[name]}
    intended = {**base.parameters, **moved}
    faults = faults_of(intended)
    if faults:
        raise LimitViolation(" ".join(fault.message for fault in faults), fields=faults)
    return rounded(intended)
