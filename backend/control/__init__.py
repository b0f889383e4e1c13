"""The only door from the backend to the unit's own C law: surface, lint, replay."""
