"""FIT files to rides: sound ones and damaged ones, by one reader."""

from backend.formats.fit.layout import HEADER_SIZES, MAGIC
from backend.formats.fit.read import read_fit

__all__ = ["HEADER_SIZES", "MAGIC", "read_fit"]
