"""Configurations and tables that come with Spindle."""

from sim_device.preset import load, names

__all__ = ["load", "names"]
