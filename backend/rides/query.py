"""What several routes of rides take and give: numbers of rides, channels, kinds, files."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from fastapi import Path, Query
from fastapi.responses import StreamingResponse

from backend.rides.files import Export
from backend.web.permissions import OwnerId

# What the database can hold.
RideId = Annotated[int, Path(ge=1, le=2**63 - 1)]
Channels = Annotated[
    str | None,
    Query(max_length=600, description="Names separated by commas; absent means all of them."),
]
ExportFormat = Literal["csv", "parquet", "fit", "gpx", "original"]
Blur = Annotated[
    float | None,
    Query(
        ge=50.0,
        le=5000.0,
        description="To be shown to strangers: what is so near to the ride's start and end, in m, "
        "is left out, later passes too, and distance and time begin behind it. FIT, GPX and CSV; "
        "422 `no_positions`, `nothing_to_share`.",
    ),
]


class RideKind:
    """Which rides a list shows; absent means whatever the caller may see."""

    def __init__(
        self,
        owner_id: OwnerId,
        bike: Annotated[int | None, Query(ge=1, le=2**63 - 1)] = None,
        longer_km: Annotated[
            float | None, Query(ge=0.0, le=1e6, description="At least so far.")
        ] = None,
        motor: Annotated[bool, Query(description="The motor's energy is known.")] = False,
        events: Annotated[bool, Query(description="With faults or marks.")] = False,
        tag: Annotated[str | None, Query(max_length=40)] = None,
        q: Annotated[
            str | None,
            Query(max_length=200, description="Words, all in name, notes, tags or place."),
        ] = None,
    ) -> None:
        self._filters: dict[str, object] = {
            "owner_id": owner_id,
            "bike_id": bike,
            "longer_km": longer_km,
            "with_motor": motor,
            "with_events": events,
            "tag": tag,
            "words": q,
        }

    def filters(self) -> dict[str, object]:
        """As the service asks for it."""
        return self._filters


def as_file(export: Export) -> StreamingResponse:
    """A file to be saved."""
    chunks: Iterator[bytes] = iter(export.chunks)
    headers = {"content-disposition": f'attachment; filename="{export.file_name}"'}
    if export.size_bytes is not None:
        headers["content-length"] = str(export.size_bytes)
    return StreamingResponse(chunks, media_type=export.media_type, headers=headers)
