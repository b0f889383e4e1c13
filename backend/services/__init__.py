"""Use cases, one verb each. Rides, imports and calibration know tuning and units; units know no
other room."""
