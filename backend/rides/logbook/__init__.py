"""All rides of a rider: cards, weeks and months, tags, places."""
