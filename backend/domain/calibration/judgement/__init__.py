"""Whether a calibration passes: limits, verification, and the earlier ones beside it."""
