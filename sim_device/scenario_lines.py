"""Where in a TOML text a table or a value stands, so that a complaint can name the line."""

import re

_HEADER = re.compile(r"^\s*(\[\[?)\s*([^\]]+?)\s*\]\]?")
_ENTRY = re.compile(r"""^\s*([A-Za-z0-9_."'-]+)\s*=""")
_QUOTES = str.maketrans("", "", "\"'")


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
                *inner, key = entry.group(1).translate(_QUOTES).split(".")
                at = ".".join([*([table] if table else []), *inner])
                self._lines.setdefault((at, key), number)

    def at(self, table: str = "", key: str = "") -> str:
        """`scenario NAME, line N` of this entry, of its table, or of where an inline one begins."""
        written_inline = ("", table.split(" ")[0].split(".")[0])
        places = ((table, key), (table, ""), written_inline)
        number = next((self._lines[place] for place in places if place in self._lines), None)
        return f"scenario {self._name}" + (f", line {number}" if number else "")
