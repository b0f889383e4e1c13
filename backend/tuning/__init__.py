"""Tuning: configurations read, written, tried and remembered; what a table would do."""
