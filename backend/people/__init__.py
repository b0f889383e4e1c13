"""Accounts, sign-in, and the keys of programs."""
