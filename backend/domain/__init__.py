"""The vocabulary, pure: modes, fuzzy table, calibration figures, ride, energy, quantities."""
