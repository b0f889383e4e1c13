"""Two rides, or two windows, on one axis, in figures and on the map."""
