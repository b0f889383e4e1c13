"""What others defined and several rooms must agree on: the globe, time zones, FIT's numbers."""
