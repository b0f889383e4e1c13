"""A drive unit seen from the host: sans-I/O session, driver thread, configuration transaction, streams."""
