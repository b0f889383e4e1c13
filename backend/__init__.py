"""Spindle's server: talks to drive units, keeps rides, serves the API and the pages."""

__version__ = "0.6.0"
