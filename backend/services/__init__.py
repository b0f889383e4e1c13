"""Use cases, one verb each. Rides and imports know tuning and units; units know no other room."""
