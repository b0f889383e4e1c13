"""Rides: recorded, read, exported, explained, compared."""
