"""Distances on the globe, taken as a sphere: at most 0.6 % off those on the ellipsoid."""

from __future__ import annotations

import numpy as np

from backend.core.channels import Values

EARTH_M = 6_371_008.8
"""Mean radius of the ellipsoid of WGS 84, (2a + b) / 3 (Moritz 2000, "Geodetic Reference System
1980")."""

REACH_MS = 33.0
"""Faster no bike is ridden for long: the limit of speeds in `formats.columns`, 118 km/h."""
REACH_M = 60.0
"""So far a receiver's position jumps between houses or trees without being wrong."""


def great_circle_m(
    latitude_deg: float | Values,
    longitude_deg: float | Values,
    latitudes_deg: Values,
    longitudes_deg: Values,
) -> Values:
    """From one place, or from each of (n,), to places (n,), in m, by the haversine formula."""
    from_rad, to_rad = np.radians(latitude_deg), np.radians(latitudes_deg)
    half_lat = (to_rad - from_rad) / 2
    half_lon = np.radians(longitudes_deg - longitude_deg) / 2
    chord = np.sin(half_lat) ** 2 + np.cos(from_rad) * np.cos(to_rad) * np.sin(half_lon) ** 2
    metres: Values = 2 * EARTH_M * np.arcsin(np.sqrt(np.clip(chord, 0.0, 1.0)))
    return metres
