"""The server itself: its health, its store, its backup, its addresses and certificate."""
