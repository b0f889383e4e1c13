"""GPX and TCX files to rides: XML walked point by point, whatever is damaged in between."""

from backend.ingest.tracks.gpx import read_gpx
from backend.ingest.tracks.tcx import read_tcx

__all__ = ["read_gpx", "read_tcx"]
