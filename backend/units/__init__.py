"""Units and their connections: which there are, what they report live, which bike each is on."""
