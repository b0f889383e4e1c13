"""Files that hold files: gzip, ZIP, and what Strava and Garmin send who asks for all of it."""
