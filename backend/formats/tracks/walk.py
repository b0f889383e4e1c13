"""The walk through an XML file of points: everything whole, before and behind damage.

Expat reads it; nothing outside the file is ever fetched, and a file that declares entities of its
own is refused. After damage reading goes on at the next opening of a part that is known. Names are
taken by their namespace, since files use any prefix; a file that declares none is taken by those
that are usual.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from xml.parsers import expat

PIECE_BYTES = 1 << 16
# So much of a name or a number is kept: more was not meant well.
TEXT_CHARACTERS_MAX = 2000
ENCODING = re.compile(rb"""^\s*<\?xml[^>]{0,200}?encoding\s*=\s*["']([A-Za-z0-9._-]{1,40})["']""")
MARKS = ((b"\xef\xbb\xbf", "utf-8"), (b"\xff\xfe", "utf-16-le"), (b"\xfe\xff", "utf-16-be"))
# Opens whatever is read behind damage, where the real beginnings are behind us.
PLACEHOLDER = b"<behind>"
# What a namespace is called here -> what its address holds, and the prefixes that are usual for it.
NAMESPACES: dict[str, tuple[str, tuple[str, ...]]] = {
    "": ("topografix.com/gpx", ("gpx",)),
    "tcx": ("trainingcenterdatabase", ()),
    "activity": ("activityextension", ("ns3", "tpx", "ext")),
    "point": ("trackpointextension", ("gpxtpx", "ns2")),
    "power": ("powerextension", ("pwr",)),
    "cluetrust": ("cluetrust.com", ("gpxdata",)),
    "opentracks": ("opentracksapp.com", ()),
}
TRUNCATED, DAMAGED = "truncated", "damaged"

Texts = dict[str, str]


OWN = ("", "tcx")


class UnsafeXml(Exception):
    """The file declares entities, which no track has and which can be a trap."""


@dataclass(frozen=True)
class Shape:
    """What a kind of file is made of, by the names of its elements.

    point: what one sample is. parts: what holds points, and where reading goes on after damage.
    """

    point: str
    parts: tuple[str, ...]

    @property
    def openings(self) -> re.Pattern[bytes]:
        """Where a part or a point begins."""
        names = "|".join((*self.parts, self.point)).encode()
        return re.compile(rb"<(?:[\w.-]+:)?(?:" + names + rb")(?=[\s/>])")


@dataclass
class Listener:
    """Who hears what the walk meets.

    opened: a part with its attributes. closed: a part. text_read: text of an element outside of the
    points, with its parent's name. point: texts of a point by `namespace:name`, the file's own
    without a namespace; `Value` under its parent's name.
    """

    opened: Callable[[str, Mapping[str, str]], None]
    closed: Callable[[str], None]
    text_read: Callable[[str, str, str], None]
    point: Callable[[Texts], None]


def namespace_of(address: str) -> str:
    """What a namespace is called here; "" for the tracks' own and for unknown ones."""
    plain = address.lower()
    return next((name for name, (part, _) in NAMESPACES.items() if part in plain), "")


def usual_namespace(prefix: str) -> str:
    """The namespace that a prefix usually stands for; the prefix itself where it has no other."""
    return next((name for name, (_, usual) in NAMESPACES.items() if prefix in usual), prefix)


@dataclass
class Walked:
    """How the walk went. error: what was first met, and its byte. points: whole ones of those
    that began."""

    points: int = 0
    points_begun: int = 0
    error: str | None = None
    offset: int | None = None


def as_utf8(data: bytes) -> bytes:
    """The file's text in UTF-8, whatever it is in; bytes that are no text become marks."""
    for mark, encoding in MARKS:
        if data.startswith(mark):
            return data[len(mark) :].decode(encoding, errors="replace").encode(errors="replace")
    declared = ENCODING.match(data[:400])
    encoding = declared.group(1).decode() if declared else "utf-8"
    if encoding.lower() in ("utf-8", "us-ascii"):
        encoding = "utf-8"
    try:
        return data.decode(encoding, errors="replace").encode(errors="replace")
    except (LookupError, ValueError):
        return data.decode(errors="replace").encode()


def walk(text: bytes, shape: Shape, listener: Listener) -> Walked:
    """Read a whole file. text: of `as_utf8`. Raises UnsafeXml."""
    openings = shape.openings
    point = re.compile(rb"<(?:[\w.-]+:)?" + shape.point.encode() + rb"(?=[\s/>])")
    walked = Walked(points_begun=sum(1 for _ in point.finditer(text)))
    prefixes: dict[str, str] = {}
    at, begin = len(text) - len(text.lstrip()), b""
    while at < len(text):
        reader = Reader(shape, listener, walked, begin, prefixes)
        end = reader.read(text, at)
        if end is None:
            return walked
        if walked.error is None:
            walked.error = TRUNCATED if reader.cut_short else DAMAGED
            walked.offset = min(end, len(text))
        opening = openings.search(text, max(end, at + 1))
        if opening is None:
            return walked
        at, begin = opening.start(), PLACEHOLDER
    return walked


class Reader:
    """One pass of expat, from a place on to the end or to what is no XML."""

    def __init__(
        self,
        shape: Shape,
        listener: Listener,
        walked: Walked,
        begin: bytes,
        prefixes: dict[str, str],
    ) -> None:
        self._shape, self._listener, self._walked = shape, listener, walked
        self._begin, self._prefixes = begin, prefixes
        self._names: list[str] = []
        self._texts: list[str] = []
        self._point: Texts | None = None
        self._leaf = False
        self.cut_short = False
        self._parser = expat.ParserCreate("utf-8")
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._text
        self._parser.EntityDeclHandler = self._entity

    def read(self, text: bytes, at: int) -> int | None:
        """To the end of the file (None), or the byte of what cannot be read. Raises UnsafeXml."""
        try:
            self._parser.Parse(self._begin, False)
            for start in range(at, len(text), PIECE_BYTES):
                self._parser.Parse(text[start : start + PIECE_BYTES], False)
            self.cut_short = True
            self._parser.Parse(b"", True)
        except expat.ExpatError:
            place = self._parser.ErrorByteIndex - len(self._begin)
            return at + max(place, 0)
        return None

    def _entity(self, *_: object) -> None:
        raise UnsafeXml

    def _start(self, qualified_name: str, attributes: Mapping[str, str]) -> None:
        name = qualified_name.rpartition(":")[2]
        self._names.append(qualified_name)
        for attribute, address in attributes.items():
            if attribute.startswith("xmlns:"):
                self._prefixes[attribute[6:]] = namespace_of(address) or attribute[6:]
        self._texts, self._leaf = [], True
        if name == self._shape.point:
            self._point = dict(attributes)
        elif self._point is None and name in self._shape.parts:
            self._listener.opened(name, attributes)

    def _end(self, qualified_name: str) -> None:
        name = qualified_name.rpartition(":")[2]
        if self._names:
            self._names.pop()
        qualified_parent = self._names[-1] if self._names else ""
        parent = qualified_parent.rpartition(":")[2]
        text = "".join(self._texts).strip() if self._leaf else ""
        self._texts, self._leaf = [], False
        if name == self._shape.point:
            if self._point is not None:
                self._walked.points += 1
                self._listener.point(self._point)
            self._point = None
        elif self._point is not None:
            if text:
                self._point.setdefault(
                    self._full_name(qualified_parent if name == "Value" else qualified_name), text
                )
        elif name in self._shape.parts:
            self._listener.closed(name)
        elif text:
            self._listener.text_read(parent, name, text)

    def _full_name(self, qualified_name: str) -> str:
        """`namespace:name`, or the name alone in the namespaces that tracks themselves have."""
        prefix, _, name = qualified_name.rpartition(":")
        namespace = self._prefixes.get(prefix) or usual_namespace(prefix)
        return f"{namespace}:{name}" if namespace not in OWN else name

    def _text(self, text: str) -> None:
        if sum(map(len, self._texts)) < TEXT_CHARACTERS_MAX:
            self._texts.append(text[:TEXT_CHARACTERS_MAX])
