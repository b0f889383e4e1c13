"""What a ride tells: energy, effort, pedalling, diagnosis, comparison, report."""
