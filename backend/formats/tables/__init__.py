"""Tables of text to rides: our own export, head units, motor controllers, and any with a time.

A table says its own units and zone, or its format defines them, or its owner is asked; nothing is
assumed.
"""

from backend.formats.tables.layouts import looks_like_table
from backend.formats.tables.read import read_table

__all__ = ["looks_like_table", "read_table"]
