"""Where in a TOML text a table or a value stands, so that a complaint can name the line."""

import re

_HEADER = re.compile(r"^\s*(\[\[?)\s*([^\]]+?)\s*\]\]?")
_ENTRY = re.compile(r"^\s*([A-Za-z0-9_-]+)\s*=")


class Source:
    """A scenario's text under its name."""

    def __init__(self, name: str, text: str) -> None:
        self._name = name
        self._lines: dict[tuple[str, str], int] = {}
        table = ""
        seen: dict[str, int] = {}
        for number, line in enumerate(text.splitlines(), start=1):
            header, entry = _HEADER.match(line), _ENTRY.match(line)
            if header is not None:
                table = header.group(2)
                if header.group(1) == "[[":
                    seen[table] = seen.get(table, 0) + 1
                    table = f"{table} {seen[table]}"
                self._lines.setdefault((table, ""), number)
            elif entry is not None:
                self._lines.setdefault((table, entry.group(1)), number)

    def at(self, table: str = "", key: str = "") -> str:
        """`scenario NAME, line N` of this entry, or of its table; without a line if neither is
        written in the plain form."""
        number = self._lines.get((table, key)) or self._lines.get((table, ""))
        return f"scenario {self._name}" + (f", line {number}" if number else "")
