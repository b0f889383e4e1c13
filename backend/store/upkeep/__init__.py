"""The whole store at once: what is in it and what is wrong, made anew, and saved as one file."""
