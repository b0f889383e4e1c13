"""Units: which are connected, what they say, who watches them, and what is remembered of them."""
