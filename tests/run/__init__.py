"""A whole run of the tests: where it keeps its files, what it starts, and that nothing is left."""
