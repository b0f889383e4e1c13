"""Calibration of the torque sensor, pure: captures in, coefficients, uncertainty, judgement out."""
