"""Text in a CSV file that a spreadsheet does not take for a formula (OWASP, "CSV Injection")."""

from __future__ import annotations

# What a spreadsheet begins a formula with, and what it passes over before it looks.
DANGEROUS = ("=", "+", "-", "@", "\t", "\r", "\n")


def guarded(text: str) -> str:
    """Text that no spreadsheet computes."""
    return f"'{text}" if text.startswith(DANGEROUS) else text
