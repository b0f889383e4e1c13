"""One ride as one file to keep, send or print."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

from backend import __version__
from backend.core.ride import Ride, iso_utc
from backend.rides.diagnosis.service import Diagnosis
from backend.rides.files import Export, stem
from backend.rides.insight.service import RideEffort, RideEnergy, RidePedalling
from backend.rides.report.page import ReportContent, page
from backend.rides.traces.figure import figure
from backend.rides.traces.track import track
from backend.store import RideReader, Store

PIXELS = 900
ROW_PX = 160


class RideReport:
    """Puts a ride's answers together. Holds nothing of them; safe from any thread."""

    def __init__(
        self,
        store: Store,
        energy: RideEnergy,
        effort: RideEffort,
        pedalling: RidePedalling,
        diagnosis: Diagnosis,
    ) -> None:
        self._store = store
        self._energy, self._effort, self._diagnosis = energy, effort, diagnosis
        self._pedalling = pedalling

    def __call__(
        self,
        ride_id: int,
        language: str = "en",
        threshold_power_w: float | None = None,
        heart_rate_bpm_max: float | None = None,
    ) -> Export:
        """The report as a file. language: `en` or `zh`. Raises NotFound, ObjectDamaged."""
        reader = self._store.rides.reader(ride_id)
        energy = self._energy(ride_id)
        content = ReportContent(
            title=reader.ride.name,
            facts=facts(reader.ride),
            version=__version__,
            figures=figures(reader.ride, energy),
            track=track(reader),
            events=reader.ride.events,
            traces=traces(reader, language),
            energy=energy,
            effort=self._effort(ride_id, threshold_power_w, heart_rate_bpm_max),
            pedalling=self._pedalling(ride_id),
            diagnosis=self._diagnosis(ride_id),
        )
        chunks = encoded(page(content, language))
        return Export(f"{stem(reader.ride)}.html", "text/html; charset=utf-8", chunks)


def facts(ride: Ride) -> str:
    """When it was and what it was made with, as far as anybody knows."""
    context = ride.context
    parts = [iso_utc(ride.started_us), context.device_model, context.device_serial]
    parts.append(ride.notes or None)
    return " · ".join(fact for fact in parts if fact)


def figures(ride: Ride, energy: dict[str, Any]) -> dict[str, float | None]:
    """The headline: the summary and the ascent."""
    summary = asdict(ride.summary) if ride.summary else {}
    return {**summary, "ascent_m": energy["climb"]["ascent_m"] if energy["climb"] else None}


def traces(reader: RideReader, language: str) -> Any:
    """The usual rows; None for a ride that has none of them."""
    drawn = figure(reader, None, PIXELS, language)
    if not drawn.data:
        return None
    rows = sum(1 for _ in drawn.select_yaxes())
    return drawn.update_layout(height=ROW_PX * rows + 60, margin={"t": 20, "r": 10})


def encoded(parts: Iterator[str]) -> Iterator[bytes]:
    """As bytes."""
    for piece in parts:
        yield piece.encode()
