"""Every configuration a unit is known to have had, and changes whose outcome is still unknown."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field

from backend.core.actor import SERVER, Actor, actor_now
from backend.core.audit import Action
from backend.core.revision import Revision, RevisionLog
from backend.device.configuration import ConfigImage
from backend.errors import StoreError
from backend.tuning.types import ParameterChange

LOG = logging.getLogger(__name__)

FOUND_REASON = "Found in the unit before a change."
ROLLED_BACK_REASON = "Returned to by the unit itself: the trial before was not confirmed."
# States of a revision: read back and for good, or read back and on trial.
VERIFIED = "verified"
TRIED = "provisional"


@dataclass(frozen=True)
class Meant:
    """A change as the log is to have it. crc32: of the configuration it makes. action, actor: for
    the audit; who acts where it is made, however late it is added."""

    crc32: int
    changed: Sequence[ParameterChange]
    reason: str
    author: str
    state: str
    action: Action
    actor: Actor = field(default_factory=actor_now)


class RevisionBook:
    """The log of revisions by unit, kept so that no write loses what was there before it."""

    def __init__(self, revisions: RevisionLog) -> None:
        self._revisions = revisions
        self._open: dict[str, Meant] = {}

    def list(self, unit: str) -> Sequence[Revision]:
        """Every configuration of a unit, newest first."""
        return self._revisions.list(unit)

    def newest_if(self, unit: str, crc32: int) -> Revision | None:
        """The newest configuration of a unit, if it is the one with this checksum."""
        newest = self._newest(unit)
        return newest if newest is not None and newest.crc32 == crc32 else None

    def may_have_ended(self, unit: str) -> bool:
        """Whether the newest is on trial, or a change may have been made that nobody answered."""
        newest = self._newest(unit)
        return unit in self._open or (newest is not None and newest.state == TRIED)

    def leave_open(self, unit: str, meant: Meant) -> None:
        """This change may have been made and is not in the log: whoever looks next finds out."""
        self._open[unit] = meant

    def back_up(self, unit: str, config: ConfigImage) -> None:
        """Keep what the unit has if the log does not know it. Raises StoreError."""
        open_change = self._open.get(unit)
        newest = self._newest(unit)
        if newest is None or newest.crc32 != config.crc32:
            rolled_back = newest is not None and newest.state == TRIED
            reason = ROLLED_BACK_REASON if rolled_back else FOUND_REASON
            found = Action.CONFIGURATION_ROLLED_BACK if rolled_back else Action.CONFIGURATION_FOUND
            meant = Meant(config.crc32, (), reason, "", VERIFIED, found, SERVER)
            if open_change is not None and open_change.crc32 == config.crc32:
                # The change was made after all: the log has it with its author's own reason.
                meant = open_change
            self._append(unit, config, meant, only_if_changed=True)
        self._open.pop(unit, None)

    def note(self, unit: str, config: ConfigImage, meant: Meant) -> None:
        """Add a change that is proven. Where a full disk does not take it, it stays open, and is
        added, with its author and reason, before anything else is written to the unit."""
        try:
            self._append(unit, config, meant)
        except StoreError as error:
            self.leave_open(unit, meant)
            LOG.error("%s: a proven change could not be noted yet: %s", unit, error.message)

    def _append(
        self, unit: str, config: ConfigImage, meant: Meant, only_if_changed: bool = False
    ) -> None:
        self._revisions.append(
            unit,
            config.parameters,
            [asdict(change) for change in meant.changed],
            meant.reason,
            meant.author,
            config.generation,
            config.crc32,
            meant.state,
            only_if_changed,
            meant.action,
            meant.actor,
        )

    def _newest(self, unit: str) -> Revision | None:
        newest = self._revisions.list(unit, 1)
        return newest[0] if newest else None
