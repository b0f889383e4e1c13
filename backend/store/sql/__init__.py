"""The database: its tables and what brings an older one to them, its one writer, PostgreSQL's lock.

Knows no file of the store and no use of a table.
"""
