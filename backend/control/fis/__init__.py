"""MATLAB's `.fis` files in and out, for the tables that the unit's law can have."""

from backend.control.fis.evaluation import Deviation, deviation
from backend.control.fis.mapping import table_of
from backend.control.fis.reading import FisSystem, read_fis
from backend.control.fis.writing import write_fis

__all__ = ["Deviation", "FisSystem", "deviation", "read_fis", "table_of", "write_fis"]
