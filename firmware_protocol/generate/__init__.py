"""Turns registry.toml into C, Python, TypeScript, Lua, A2L and the tables of SPEC.md."""
