"""Words by which a rider finds rides again."""

from __future__ import annotations

from collections.abc import Iterable

from backend.errors import FieldError, InvalidRequest

TAG_LENGTH_MAX = 40
# A list shows a ride's tags in a line.
TAGS_MAX = 20


def clean_tags(words: Iterable[str]) -> tuple[str, ...]:
    """Tags without needless space, each once whatever its case. Raises InvalidRequest."""
    tags: dict[str, str] = {}
    for word in words:
        tag = " ".join(word.replace("\0", "").split())
        if tag:
            tags.setdefault(tag.casefold(), tag)
    if len(tags) > TAGS_MAX or any(len(tag) > TAG_LENGTH_MAX for tag in tags.values()):
        message = f"A ride has at most {TAGS_MAX} tags of at most {TAG_LENGTH_MAX} characters."
        raise InvalidRequest(message, fields=[FieldError("tags", "too_long", message)])
    return tuple(sorted(tags.values(), key=str.casefold))
