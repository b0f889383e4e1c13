"""The makes of units there are, by the word that `?family=` of a device's url takes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol, TypeAlias

from backend.device.driver import LinkOpener, Listener
from backend.device.ebl.session.schema import Schemas
from backend.device.ebl.unit import EblUnit
from backend.device.unit import Unit


class Family(Protocol):
    """Makes a unit of one family."""

    def __call__(
        self,
        opener: LinkOpener,
        listener: Listener,
        streaming: bool = True,
        reopen_when_silent: bool = True,
        schemas: Schemas | None = None,
    ) -> Unit: ...


Families: TypeAlias = Mapping[str, Family]
DEFAULT_FAMILY = EblUnit.family
FAMILIES: Families = {EblUnit.family: EblUnit}
