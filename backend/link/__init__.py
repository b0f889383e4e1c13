"""Bytes in and out: serial port, tcp, the simulated unit's port, port list. The only door to pyserial."""
