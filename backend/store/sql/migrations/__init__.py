"""How the schema came to be, step by step. Run at open; never edited once released."""
