"""Passkeys (W3C Web Authentication, level 3): a browser signs in by its authenticator."""
