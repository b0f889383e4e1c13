"""What a channel is: a name, a unit and the scale from stored counts to the physical value.

Samples live as integer counts from the wire to the disk, because counts compress two to three
times better than floats and come back exactly. The smallest value of the integer type means
"missing", as on the wire; a missing sample is never 0.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

MISSING_INT16 = -(2**15)
MISSING_INT32 = -(2**31)
# The largest counts.
NARROW_MAX, WIDE_MAX = -MISSING_INT16 - 1, -MISSING_INT32 - 1

Counts = npt.NDArray[np.signedinteger[Any]]
Values = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class ChannelSpec:
    """One channel: physical value = count x scale.

    name: with its unit as suffix (`rider_torque_nm`). unit: as shown to people (`Nm`).
    scale: unit per count. wide: counts need 32 bits (position, distance), else 16 suffice.
    """

    name: str
    unit: str
    scale: float
    wide: bool = False

    @property
    def dtype(self) -> np.dtype[np.int16] | np.dtype[np.int32]:
        """Integer type of the counts."""
        return np.dtype(np.int32) if self.wide else np.dtype(np.int16)

    @property
    def missing(self) -> int:
        """The count that means "no sample"."""
        return MISSING_INT32 if self.wide else MISSING_INT16

    def to_values(self, counts: Counts) -> Values:
        """Counts (n,) -> physical values float64 (n,) in `unit`, missing as NaN."""
        values = counts.astype(np.float64)
        values *= self.scale
        values[counts == self.missing] = np.nan
        return values

    def to_counts(self, values: Values) -> Counts:
        """Physical values (n,) -> the nearest counts (n,); NaN and out of range become missing."""
        limit = -self.missing - 1
        counts = np.rint(values / self.scale)
        beyond = ~np.isfinite(counts) | (np.abs(counts) > limit)
        encoded = np.where(beyond, self.missing, counts)
        return encoded.astype(np.int32) if self.wide else encoded.astype(np.int16)


def channel_to_json(channel: ChannelSpec) -> dict[str, object]:
    """A channel as plain JSON, the inverse of `channel_from_json`."""
    return {
        "name": channel.name,
        "unit": channel.unit,
        "scale": channel.scale,
        "wide": channel.wide,
    }


def channel_from_json(body: Mapping[str, object]) -> ChannelSpec:
    """Plain JSON -> channel; raises KeyError or ValueError when a member is absent or no number."""
    return ChannelSpec(
        name=str(body["name"]),
        unit=str(body["unit"]),
        scale=float(str(body["scale"])),
        wide=bool(body.get("wide", False)),
    )


def channel_names(text: str | None) -> list[str] | None:
    """`"a, b"` as a list; None where no channel was named."""
    names = [name.strip() for name in (text or "").split(",")]
    return [name for name in names if name] or None
