"""Named tables and configurations, with or without a unit; any two of them compared."""
