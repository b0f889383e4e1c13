"""Turns registry.toml into C, Python, TypeScript and the tables of SPEC.md."""
