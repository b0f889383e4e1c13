"""The JSON that Mahle's My SmartBike exports of a ride, read point by point."""

from backend.formats.mahle.read import looks_like_mahle, read_mahle

__all__ = ["looks_like_mahle", "read_mahle"]
