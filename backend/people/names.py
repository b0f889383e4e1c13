"""Names of people and of what is theirs."""

from __future__ import annotations

from backend.core.author import tidy_author
from backend.core.person import folded
from backend.people.passwords import field_refusal
from backend.people.types import NAME_MAX


def good_name(name: str) -> str:
    """A name as it is kept. Raises InvalidRequest where there is none or it is too long."""
    tidy = tidy_author(name)
    # One character of Arabic can be eighteen when names are compared.
    if not 0 < len(tidy) <= NAME_MAX or len(folded(tidy)) > 2 * NAME_MAX:
        raise field_refusal("name", "not_a_name", f"A name has 1 to {NAME_MAX} characters.")
    return tidy
