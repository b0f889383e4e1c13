"""MATLAB's `.fis` files in and out, for the tables that the unit's law can have."""

from backend.law.fis.evaluation import Deviation, deviation
from backend.law.fis.mapping import table_of
from backend.law.fis.reading import FisSystem, read_fis
from backend.law.fis.writing import write_fis

__all__ = ["Deviation", "FisSystem", "deviation", "read_fis", "table_of", "write_fis"]
