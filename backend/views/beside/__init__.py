"""Two rides, or two windows of one, side by side on one axis, in figures and on the map."""
