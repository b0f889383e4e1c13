"""What a member of an enumeration is called wherever it is not C: in the API, in files, in words.

The registry spells members as C spells constants, MAMDANI_CENTROID. Programs and people read
`mamdani_centroid`; only the labels of fuzzy rules stay as every table prints them. Any case is
read, because requests, backups and revisions up to version 0.2 have the registry's.
"""

from enum import IntEnum, IntFlag
from functools import cache
from typing import TypeVar

RULE_LABELS = frozenset(("NB", "NS", "ZO", "PS", "PB"))

Member = TypeVar("Member", bound=IntEnum)


def word_of(name: str) -> str:
    """The one spelling of a member's name."""
    return name if name in RULE_LABELS else name.lower()


def words_of(table: type[IntEnum] | type[IntFlag]) -> tuple[str, ...]:
    """All members of an enumeration, or all its flags, in the order of the registry."""
    return tuple(word_of(name) for name in table.__members__)


def member_of(table: type[Member], word: str) -> Member:
    """The member that is called so, in any case. Raises KeyError."""
    return table[_names(table)[word.casefold()]]


@cache
def _names(table: type[Member]) -> dict[str, str]:
    return {name.casefold(): name for name in table.__members__}
