"""FIT files read by Spindle and by fitdecode, a reader that is not ours, cell by cell."""
