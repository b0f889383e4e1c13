"""A drive unit seen from the host: the thread that drives a conversation, states, streams."""
