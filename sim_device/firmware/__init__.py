"""The firmware in C99: law, product, hardware interface, boards."""
