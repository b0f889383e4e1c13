"""The rider's home: weeks and months, bikes, records, the last faults, and tags in use."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict

from backend.core.calendar import MONDAY, Period, last_months, last_weeks, require_zone
from backend.core.ride import iso_utc
from backend.core.ride_tags import clean_tags
from backend.store import Store, Totals, Whose
from backend.store.wall_clock import now_us


class RiderHomeService:
    """What all rides come to, and what is done to many of them at once.

    clock: Unix time in microseconds.
    """

    def __init__(self, store: Store, clock: Callable[[], int] = now_us) -> None:
        self._store = store
        self._clock = clock

    def __call__(
        self,
        zone: str = "UTC",
        week_begins: int = MONDAY,
        bike_id: int | None = None,
        owner_id: int | None = None,
    ) -> dict[str, object]:
        """Everything of all rides, or of a bike's or an account's. Raises InvalidRequest for an
        unknown zone.

        zone: the rider's, of the IANA database. week_begins: 1 Monday to 7 Sunday.
        """
        here, now = require_zone(zone), self._clock()
        spans = last_weeks(now, here, week_begins), last_months(now, here)
        home = self._store.logbook.home(spans, Whose(bike_id, owner_id))
        weeks, months = map(with_totals, spans, home.by_period)
        return {
            "weeks": weeks,
            "months": months,
            "bikes": [
                {
                    "bike_id": bike.bike_id,
                    "name": bike.name,
                    "last_ride_at": iso_utc(bike.last_us),
                    "rides": bike.rides,
                    "distance_km": bike.distance_km,
                }
                for bike in home.bikes
            ],
            "records": [
                {
                    "kind": best.kind,
                    "value": best.value,
                    "ride_id": best.ride_id,
                    "started_at": iso_utc(best.started_us),
                }
                for best in home.records
            ],
            "faults": [
                {"ride_id": fault.ride_id, "at": iso_utc(fault.at_us), "flags": fault.flags}
                for fault in home.faults
            ],
            "tags": [{"tag": tag, "rides": rides} for tag, rides in home.tags],
        }

    def tag(
        self,
        ride_ids: Sequence[int],
        add: Sequence[str],
        remove: Sequence[str],
        owner_id: int | None = None,
    ) -> None:
        """Add and remove tags of rides, all or none. Raises NotFound, also for one that is not this
        account's; InvalidRequest."""
        self._store.logbook.require_own(ride_ids, owner_id)
        self._store.logbook.tag(ride_ids, clean_tags(add), clean_tags(remove))


def with_totals(periods: Sequence[Period], totals: Sequence[Totals]) -> list[Mapping[str, object]]:
    """Periods with what the rides in them come to."""
    return [
        {
            "first_day": period.first_day.isoformat(),
            "from": iso_utc(period.from_us),
            "to": iso_utc(period.to_us),
            **figures(each),
        }
        for period, each in zip(periods, totals, strict=True)
    ]


def figures(totals: Totals) -> dict[str, object]:
    """Totals as in the API: the rider's mean power instead of the time it is of."""
    body = asdict(totals)
    rider_s = body.pop("rider_s")
    watts = totals.rider_wh * 3600 / rider_s if totals.rider_wh is not None and rider_s else None
    return body | {"rider_power_w_mean": watts}
