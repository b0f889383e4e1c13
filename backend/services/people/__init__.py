"""Who asks: people sign in, keys and tickets are known again, accounts are managed."""
