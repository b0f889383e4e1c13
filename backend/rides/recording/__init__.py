"""Recording: what a connected unit streams becomes a ride."""
