"""Turns registry.toml into C, Python, TypeScript, Lua and the tables of SPEC.md."""
