"""What a ride's samples come to: energy by group, effort, gradient. Arrays in, values out."""
