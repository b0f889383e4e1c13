"""What routes of tuning take and give."""
