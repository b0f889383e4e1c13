"""What a rider keeps of all rides: cards, weeks and months, tags."""
