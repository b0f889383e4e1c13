"""Imports: files and ride logs that become rides, or fill those that are there."""
