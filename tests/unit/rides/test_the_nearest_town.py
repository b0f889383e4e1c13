"""Goal: a position is named after its town, in its time zone, everywhere on earth.

Method: places and zones from an atlas; every zone of the list is one that Python knows.
"""

from __future__ import annotations

from zoneinfo import ZoneInfo

import pytest

from backend.rides.logbook.towns import Gazetteer

TOWNS = Gazetteer()


@pytest.mark.parametrize(
    ("latitude_deg", "longitude_deg", "name", "country", "zone"),
    [
        (53.346, -6.262, "Dublin", "IE", "Europe/Dublin"),
        (48.776, 9.183, "Stuttgart", "DE", "Europe/Berlin"),
        (39.907, 116.397, "Beijing", "CN", "Asia/Shanghai"),
        (-33.868, 151.207, "Sydney", "AU", "Australia/Sydney"),
        (-16.793, -179.99, "Labasa", "FJ", "Pacific/Fiji"),
    ],
)
def test_a_place_has_its_town(
    latitude_deg: float, longitude_deg: float, name: str, country: str, zone: str
) -> None:
    town = TOWNS.nearest(latitude_deg, longitude_deg)

    assert (town.name, town.country, town.zone) == (name, country, zone)


def test_a_town_over_the_date_line_is_near() -> None:
    assert TOWNS.nearest(-16.793, -179.99).away_m < 100_000


def test_far_out_at_sea_the_nearest_town_is_far() -> None:
    # Point Nemo is 2,688 km from any land.
    assert TOWNS.nearest(-48.877, -123.393).away_m > 2_688_000


def test_every_zone_is_known() -> None:
    zones = {zone for _, _, zone in TOWNS._towns[2]}

    assert len(zones) > 300
    assert all(ZoneInfo(zone) for zone in zones)
