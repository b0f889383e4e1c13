"""The server itself: its health, its store as a whole, its backup."""
