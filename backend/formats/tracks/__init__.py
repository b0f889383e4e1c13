"""GPX and TCX files to rides: XML walked point by point, whatever is damaged in between."""

from backend.formats.tracks.gpx import read_gpx
from backend.formats.tracks.tcx import read_tcx

__all__ = ["read_gpx", "read_tcx"]
