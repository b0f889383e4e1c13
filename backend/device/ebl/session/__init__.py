"""The conversation with one EBL unit: bytes and time in, events and results out; no I/O."""
