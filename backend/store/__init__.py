"""SQL and objects: rides, revisions, live tails. The only door to SQLAlchemy and pyarrow."""
