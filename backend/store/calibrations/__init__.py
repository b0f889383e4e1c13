"""Calibrations of torque sensors: each job with its captures, and the file of each closed one."""

from backend.store.calibrations.jobs import CalibrationStore
from backend.store.calibrations.kept import KeptCalibration, KeptCapture

__all__ = ["CalibrationStore", "KeptCalibration", "KeptCapture"]
