"""Service visits: what a workshop found, did and changed on a bike."""
