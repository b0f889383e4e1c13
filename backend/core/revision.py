"""A revision: one configuration a unit has had, who gave it, when and why; where they are kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any, Protocol, TypeAlias

from backend.core.actor import Actor
from backend.core.audit import Action
from backend.core.author import AuthorProof
from backend.core.moments import utc

Parameters: TypeAlias = Mapping[str, Any]


@dataclass(frozen=True)
class Revision:
    """One configuration of a unit, as it is kept.

    seq: counts the unit's configurations from 1. created_us: Unix time. state: `verified`,
    `provisional` or `found`. changed: [{name, old, new}] against the one before. parameters: the
    whole configuration by registry name, as plain JSON. unit_key: whose it is. author_proof: how
    the author is known, as of core.author.
    """

    seq: int
    created_us: int
    author: str
    reason: str
    state: str
    generation: int | None
    crc32: int | None
    changed: Sequence[Mapping[str, Any]]
    parameters: Parameters
    unit_key: str
    author_proof: AuthorProof | None = None

    @property
    def created_at(self) -> datetime:
        """`created_us` as a moment in UTC."""
        return utc(self.created_us)


class RevisionLog(Protocol):
    """Where configurations are kept by unit; tuning.records has one."""

    def append(
        self,
        unit_key: str,
        parameters: Mapping[str, Any],
        changed: Sequence[Mapping[str, Any]] = (),
        reason: str = "",
        author: str = "",
        generation: int | None = None,
        crc32: int | None = None,
        state: str = "verified",
        only_if_changed: bool = False,
        action: Action = Action.CONFIGURATION_FOUND,
        actor: Actor | None = None,
    ) -> Revision:
        """Add a configuration the unit has; only_if_changed: unless the newest is the same, by
        whomever. action, actor: for the audit; None for who acts here. Raises StoreError."""
        ...

    def list(self, unit_key: str, limit: int = ...) -> Sequence[Revision]:
        """Configurations of a unit, newest first."""
        ...
