"""The vocabulary, pure: assist modes, fuzzy table, calibration metrics, ride, energy, quantities."""
