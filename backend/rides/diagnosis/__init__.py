"""What a ride, and many, show of their bike's health, with evidence."""
