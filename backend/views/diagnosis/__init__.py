"""What a ride's samples show of its bike's health: findings with their evidence. Arrays in, values
out."""
