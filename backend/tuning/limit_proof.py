"""Limit proofs: what is proven of a configuration before it is written, and kept with it after.

A limit proof follows from the configuration, the method and the firmware whose C is in this
process. It is worked out whenever it is asked for, and kept as it was first made.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Protocol

from backend import law
from backend.core.revision import Revision, RevisionLog
from backend.device.capability import Capability
from backend.errors import FieldError, InvalidRequest, NotFound, SpindleError
from backend.law.limit_proof import LimitProof
from backend.tuning.library.service import Library
from backend.tuning.preview import changed_config
from backend.tuning.service import Tuning
from backend.units.service import Devices

LOG = logging.getLogger(__name__)
OTHER_FIRMWARE = "other_firmware"


class LimitProofs(Protocol):
    """Where limit proofs are stored; tuning.records has one."""

    def save(self, made: LimitProof) -> int:
        """Since when it is kept, Unix microseconds. Raises StoreError."""
        ...


@dataclass(frozen=True)
class ProofSubject:
    """Of what: a unit (`revision` of it, or what it has), an entry of the library, or neither of
    them and so the law's defaults; and what takes the place of their values.

    changes: as of `changed_config`. parameters: by registry name.
    """

    device_id: str | None = None
    revision: int | None = None
    library: str | None = None
    changes: Mapping[str, Any] = field(default_factory=dict)
    parameters: Mapping[str, Any] = field(default_factory=dict)


class LimitProofMaker:
    """Makes proofs and keeps them. For any thread. firmware_version: of the C in here."""

    def __init__(self, proofs: LimitProofs, firmware_version: str) -> None:
        self._proofs = proofs
        self._firmware_version = firmware_version

    def of(self, config: Mapping[str, Any]) -> LimitProof:
        """Of a configuration by registry name. Raises InvalidRequest, StoreError."""
        made = law.prove_limits(config, self._firmware_version)
        return replace(made, created_us=self._proofs.save(made))


class ProvenRevisions:
    """A log of revisions that keeps a limit proof with each; otherwise as the log it stands for."""

    def __init__(self, revisions: RevisionLog, proofs: LimitProofMaker) -> None:
        self._revisions = revisions
        self._proofs = proofs
        self.list = revisions.list

    def append(
        self, unit_key: str, parameters: Mapping[str, Any], *rest: Any, **named: Any
    ) -> Revision:
        """As RevisionLog. A limit proof that cannot be stored is logged; it can be made
        at any time."""
        added = self._revisions.append(unit_key, parameters, *rest, **named)
        if has_law(parameters):
            try:
                self._proofs.of(parameters)
            except SpindleError as error:
                LOG.warning("%s: no limit proof was kept: %s", unit_key, error.message)
        return added


class ProveLimits:
    """Limit proofs of what there is and of what might be written. From any thread."""

    def __init__(
        self, proofs: LimitProofMaker, devices: Devices, tuning: Tuning, library: Library
    ) -> None:
        self._proofs = proofs
        self._devices = devices
        self._tuning = tuning
        self._library = library

    def __call__(self, subject: ProofSubject) -> LimitProof:
        """Raises InvalidRequest for what no unit takes, NotFound, NoAnswer, CapabilityMissing."""
        if subject.device_id is not None and subject.library is not None:
            message = "Name a unit or an entry of the library, not both."
            raise InvalidRequest(message, fields=[FieldError("library", "not_one", message)])
        base = self._base(subject)
        config = {**changed_config(base, **subject.changes), **subject.parameters}
        unknown = [name for name in subject.parameters if name not in base]
        if unknown:
            faults = [FieldError(name, "unknown", f"There is no {name}.") for name in unknown]
            raise InvalidRequest(" ".join(fault.message for fault in faults), fields=faults)
        made = self._proofs.of(config)
        if subject.device_id is None:
            return made
        identity = self._devices.get(subject.device_id).identity
        runs = identity.firmware_version if identity else None
        return made if runs == made.firmware_version else replace(made, unproven=OTHER_FIRMWARE)

    def _base(self, subject: ProofSubject) -> dict[str, Any]:
        defaults = law.law_defaults()
        if subject.library is not None:
            document = self._library.entry(subject.library).document
            values = {name: entry["value"] for name, entry in document["parameters"].items()}
            return {**defaults, **values}
        if subject.device_id is None:
            return defaults
        if subject.revision is None:
            unit = self._devices.writable(subject.device_id)
            unit.require(Capability.READ_CONFIG, Capability.FUZZY_TABLE)
            return {**defaults, **unit.read_config().parameters}
        for revision in self._revisions(subject.device_id):
            if revision.seq == subject.revision and has_law(revision.parameters):
                return {**defaults, **revision.parameters}
        raise NotFound(f"{subject.device_id} has no revision {subject.revision} with a rule table.")

    def _revisions(self, device_id: str) -> Sequence[Revision]:
        return self._tuning.revisions(device_id)


def has_law(parameters: Mapping[str, Any]) -> bool:
    """Whether a configuration is one of the law's, and not of a unit of another make."""
    return "fuzzy_rules" in parameters and "market" in parameters
