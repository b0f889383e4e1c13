"""The walk through a JSON object of which one member is the list of a ride's points.

The text is decoded piece by piece and each point by itself, so that memory holds one point and the
columns. After damage reading goes on at the next point. Numbers stay as they were written.
"""

from __future__ import annotations

import codecs
import json
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

TIME = "ts"
PIECE_BYTES = 1 << 20
# A point has some 400 characters. What is longer than this is damage, or was not meant well.
VALUE_CHARACTERS_MAX = 1 << 18
# So many places are looked at for the next point, in a whole file.
ATTEMPTS_MAX = 1000
TRUNCATED, DAMAGED = "truncated", "damaged"
POINT = re.compile(r'\{\s*"[a-z]{2}"\s*:')
POINTS = re.compile(r'\[\s*(?=\{\s*"[a-z]{2}"\s*:)')
BETWEEN = re.compile(r"[\s,]*")
AFTER_NAME = re.compile(r"\s*:\s*")
DECODER = json.JSONDecoder(parse_int=str, parse_float=str, parse_constant=str)


@dataclass(frozen=True)
class Listener:
    """Who hears what the walk meets. member: a member of the document. point: each whole point."""

    member: Callable[[str, Any], None]
    point: Callable[[dict[str, Any]], None]


@dataclass
class Walked:
    """How the walk went. error: what was first met, and its byte. points: whole ones."""

    points: int = 0
    error: str | None = None
    offset: int | None = None


class Walk:
    """One pass over a document, with a window of its text."""

    def __init__(self, data: bytes, listener: Listener) -> None:
        self._data, self._listener = data, listener
        # A byte that is no text is kept as one character, so that places can be reported.
        self._decoder = codecs.getincrementaldecoder("utf-8")("surrogateescape")
        self._text, self._at, self._taken = "", 0, 0
        self._attempts = 0

    def run(self) -> Walked:
        """From the first brace to the last, as far as it goes. Never raises."""
        walked = Walked()
        begin: Callable[[Walked], None] = self._opening
        while True:
            try:
                begin(walked)
                self._members(walked)
                return walked
            except (ValueError, RecursionError) as error:
                ended = self._ended(getattr(error, "pos", self._at))
                first = walked.error is None
                if first:
                    walked.error, walked.offset = DAMAGED, self._place()
            if not self._next_point():
                if first and ended:
                    walked.error = TRUNCATED
                return walked
            begin = self._each_point

    def _opening(self, _: Walked) -> None:
        if self._mark() != "{":
            raise ValueError
        self._at += 1

    def _members(self, walked: Walked) -> None:
        """Members up to the document's last brace."""
        while (mark := self._mark()) != "}":
            if mark != '"':
                raise ValueError
            name = str(self._value())
            self._skip(AFTER_NAME)
            if POINTS.match(self._text, self._at):
                self._skip(POINTS)
                self._each_point(walked)
            else:
                self._listener.member(name, self._value())

    def _each_point(self, walked: Walked) -> None:
        """Points up to the end of their list."""
        while self._mark() != "]":
            point = self._value()
            if not isinstance(point, dict):
                raise ValueError
            walked.points += 1
            self._listener.point(point)
        self._at += 1

    def _next_point(self) -> bool:
        """Go to where the next whole point begins; False when none does."""
        self._at += 1
        while self._attempts < ATTEMPTS_MAX:
            self._fill()
            match = POINT.search(self._text, self._at)
            if match is not None:
                self._at = match.start()
                if self._is_point():
                    return True
                self._attempts += 1
                self._at += 1
            elif self._taken < len(self._data):
                # A beginning may stand at the window's end.
                self._at = max(self._at, len(self._text) - VALUE_CHARACTERS_MAX // 2)
            else:
                return False
        return False

    def _is_point(self) -> bool:
        """Whether a value begins here that is a point, not a part of one."""
        self._fill()
        try:
            point, _ = DECODER.raw_decode(self._text, self._at)
        except (ValueError, RecursionError):
            return False
        return isinstance(point, dict) and TIME in point

    def _ended(self, place: int) -> bool:
        """Whether the file ends before the document does. place: where reading failed."""
        if self._taken < len(self._data):
            return False
        return place >= len(self._text.rstrip()) or not self._text.rstrip().endswith("}")

    def _place(self) -> int:
        """The byte of the file that is read next."""
        return self._taken - len(self._text[self._at :].encode(errors="surrogateescape"))

    def _mark(self) -> str:
        """The character that the next value begins with, "" at the end."""
        self._skip(BETWEEN)
        return self._text[self._at : self._at + 1]

    def _skip(self, what: re.Pattern[str]) -> None:
        self._fill()
        match = what.match(self._text, self._at)
        if match is None:
            raise ValueError
        self._at = match.end()

    def _value(self) -> Any:
        self._fill()
        value, self._at = DECODER.raw_decode(self._text, self._at)
        return value

    def _fill(self) -> None:
        """Have as much text ahead as a value may take, as far as there is any."""
        while len(self._text) - self._at < VALUE_CHARACTERS_MAX and self._taken < len(self._data):
            piece = self._data[self._taken : self._taken + PIECE_BYTES]
            self._taken += len(piece)
            ended = self._taken >= len(self._data)
            self._text = self._text[self._at :] + self._decoder.decode(piece, ended)
            self._at = 0
