"""The rides as a rider's logbook: found, counted, tagged, and what a list shows of each."""
