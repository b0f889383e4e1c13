"""A ride as a file for others: CSV, FIT and GPX, from its rows in physical units."""
