"""Calibration jobs: a sensor read under known loads, fitted, written, verified, certified."""
