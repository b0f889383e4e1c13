"""Imports: files, archives and ride logs of units become rides; nothing is lost or kept twice."""
