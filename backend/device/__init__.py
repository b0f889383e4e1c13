"""A drive unit seen from the host: sans-I/O session, driver thread, transaction, streams."""
