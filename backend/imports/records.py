"""What owners said of tables, a file each beside the objects: `tables/<hash of the header>.json`.

In files, so that a database that is made again from its folder still knows it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from backend.core.described import described
from backend.errors import NotFound, StoreError
from backend.formats.questions import TableAnswer, TableQuestion, answer_from_json, answer_to_json
from backend.store.objects import TABLES, Objects

HEADER = re.compile(r"[0-9a-f]{64}")


@described
class AnsweredTable:
    """A kind of table that was answered for."""

    header_sha256: str
    kind: str
    columns: tuple[str, ...]
    """Their names."""
    answer: TableAnswer


class TableAnswers:
    """The answers, by the header they are for."""

    def __init__(self, objects: Objects) -> None:
        self._objects = objects

    def get(self, header_sha256: str) -> AnsweredTable | None:
        """What is known of a header, None for nothing; a damaged file is nothing, too."""
        if not HEADER.fullmatch(header_sha256):
            return None
        try:
            body = self._objects.read_json(key_of(header_sha256))
            answer = answer_from_json(body["answer"]) if body else None
        except (StoreError, KeyError, TypeError, ValueError):
            return None
        if body is None or answer is None:
            return None
        columns = tuple(str(name) for name in body.get("columns", ()))
        return AnsweredTable(header_sha256, str(body.get("kind", "")), columns, answer)

    def save(self, question: TableQuestion, answer: TableAnswer) -> None:
        """Keep what was said, in place of what was said before. Raises StoreError."""
        body = {
            "schema_version": 1,
            "kind": question.kind,
            "columns": [column.name for column in question.columns],
            "answer": answer_to_json(answer),
        }
        self._objects.publish_json(key_of(question.header_sha256), body)

    def forget(self, header_sha256: str) -> None:
        """From now on it is asked again. Raises NotFound."""
        if self.get(header_sha256) is None:
            raise NotFound(f"Nothing was said of a table with the header {header_sha256}.")
        self._objects.remove(key_of(header_sha256))

    def all(self) -> Iterator[AnsweredTable]:
        """Everything that was said, by header."""
        for key in self._objects.table_keys():
            stored = self.get(key.removeprefix(f"{TABLES}/").removesuffix(".json"))
            if stored is not None:
                yield stored


def key_of(header_sha256: str) -> str:
    """Key of what was said of a header."""
    return f"{TABLES}/{header_sha256}.json"
