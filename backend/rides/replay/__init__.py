"""A ride replayed and ridden again by the unit's own law, explained, and improved upon."""
