"""What a ride comes to: energy apart, gradient, effort, pedalling, use of the table."""
