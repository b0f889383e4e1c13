"""Calibration of the torque sensor: captures in; coefficients, uncertainty, certificate out."""
