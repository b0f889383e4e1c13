"""The walk through a damaged FIT file: everything that can be believed, before and behind damage.

A data message is believed when it is of a known definition and its time is near the time before,
or when the messages behind it are. Otherwise the place is lost, and is looked for byte by byte: it
is found where some messages in a row are of known definitions and agree on the time. The search
begins inside the message before the damage, because a lost byte lies in it; a message that the
place found cuts short is given up.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from backend.formats.fit.layout import (
    CHECKSUM_BYTES,
    COMPRESSED,
    HEADER_SIZES,
    LOCAL_MASK,
    MAGIC,
    MAGIC_AT,
    OFFSET_MASK,
    Definition,
    Part,
    declared_end,
    definition_of,
    header_size,
    is_definition,
    makes_sense,
    read_definition,
)
from backend.formats.fit.walk import Walk, checksum_fits

# Times further apart are not of neighbours.
NEAR_S = 86_400
# A header is looked for so far into a file.
SEARCHED_BYTES = 4096
# The longest definition there can be.
DEFINITION_BYTES_MAX = 6 + 2 * (1 + 255 * 3)
# Messages in a row that show the place: at least so many, of which so many must tell a time, and so
# many are looked at for it.
CHAIN_MIN, CHAIN_TIMES, CHAIN_MAX = 4, 2, 24

Definitions = Sequence[Definition | None]


@dataclass
class Salvage:
    """What was found, and what was met: (code, byte) of each trouble."""

    parts: list[Part] = field(default_factory=list)
    troubles: list[tuple[str, int]] = field(default_factory=list)
    skipped_bytes: int = 0
    expected_bytes: int = 0
    read_until: int = 0

    @property
    def walked(self) -> bool:
        """Whether the way through the file was never lost, whatever its values are."""
        return all(code == "checksum_mismatch" for code, _ in self.troubles)

    @property
    def structure(self) -> list[range]:
        """The bytes of every definition when first met, and those where the way was first lost."""
        lost = min((at for code, at in self.troubles if code == "damaged"), default=0)
        return [
            range(lost, lost + DEFINITION_BYTES_MAX if lost else 0),
            *(
                range(definition.at, definition.at + 1 + len(encoded))
                for part in self.parts
                for encoded, definition in part.definitions.items()
            ),
        ]

    def add_problem(self, code: str, at: int) -> None:
        """Note what was met at a byte."""
        self.troubles.append((code, at))


@dataclass(frozen=True)
class Step:
    """One message as it would be read. definition: the new one, or the data's."""

    stop: int
    definition: Definition
    is_data: bool
    offset_s: int | None = None


class Salvaging:
    """One pass over the bytes."""

    def __init__(self, data: bytes) -> None:
        self.data = data
        self.salvage = Salvage()
        self.walk = Walk()
        # The time that is believed, which the next one must be near to.
        self.last_s: int | None = None
        # The latest data message, which a place found later may cut short.
        self.latest: tuple[int, Definition] | None = None
        self.start = 0
        self.end: int | None = None

    def run(self) -> Salvage:
        """Everything there is."""
        data, salvage = self.data, self.salvage
        at, end = self.begin(first_header(data)), len(data)
        while at < end:
            if self.file_ends(at):
                at += CHECKSUM_BYTES
                if header_size(data, at):
                    at = self.begin(at)
                    continue
                if at < end:
                    salvage.add_problem("trailing", at)
                salvage.read_until = at
                return salvage
            step = self.step(at, end, self.walk.definitions)
            if step is not None and self.believed(at, step):
                self.take(at, step)
                at = salvage.read_until = step.stop
            else:
                at = self.find_next_message(at)
        if not salvage.troubles or salvage.troubles[-1][0] != "truncated":
            salvage.add_problem("truncated", end)
        return salvage

    def begin(self, at: int | None) -> int:
        """A file of the chain begins; returns where its messages do."""
        self.walk, self.last_s, self.latest = Walk(), None, None
        self.salvage.parts.append(self.walk.part)
        self.start, self.end = at or 0, None
        if at is None:
            self.salvage.add_problem("header", 0)
            return 0
        self.end = declared_end(self.data, at)
        size = header_size(self.data, at) or HEADER_SIZES[1]
        if self.end is None or self.end <= at + size:
            self.salvage.add_problem("header", at)
            self.end = None
        else:
            self.salvage.expected_bytes += self.end + CHECKSUM_BYTES - at
        return at + size

    def file_ends(self, at: int) -> bool:
        """Whether the checksum stands here: the header, another one behind, or the last bytes."""
        left, behind = len(self.data) - at, at + CHECKSUM_BYTES
        another = bool(header_size(self.data, behind))
        last = left == CHECKSUM_BYTES
        if left < CHECKSUM_BYTES or not (another or at == self.end or (last and not self.end)):
            return False
        proven = checksum_fits(self.data, self.start, at)
        if not proven and at == self.end and not another and not last and self.chain(at, None):
            self.salvage.add_problem("header", self.start)
            self.end = None
            return False
        if self.end not in (at, None):
            self.salvage.add_problem("header", self.start)
        elif not proven:
            self.salvage.add_problem("checksum_mismatch", at)
        return True

    def step(self, at: int, end: int, definitions: Definitions) -> Step | None:
        """The message at `at`, None when there can be none."""
        head = self.data[at]
        if is_definition(head):
            read = read_definition(self.data, at, end)
            if read is None or not makes_sense(read[0], self.data):
                return None
            return Step(read[1], read[0], False)
        definition = definition_of(head, definitions)
        if definition is None or at + definition.size > end:
            return None
        if not head & COMPRESSED:
            return Step(at + definition.size, definition, True)
        # A message that brings its own time needs none in its header.
        if definition.time_at:
            return None
        return Step(at + definition.size, definition, True, head & OFFSET_MASK)

    def believed(self, at: int, step: Step) -> bool:
        """Whether a message fits the time before it, or else what is behind it does."""
        if not step.is_data:
            # A damaged header can look like a definition, which would spoil all that follows.
            return self.chain(at, self.last_s, True)
        if not step.definition.time_at:
            return True
        time_s = step.definition.time_s(self.data, at)
        if time_s is not None and self.last_s is not None and near(time_s, self.last_s):
            return True
        return self.chain(step.stop, self.last_s, True)

    def chain(self, at: int, last_s: int | None, aligned: bool = False) -> bool:
        """Whether messages in a row begin here whose times are near `last_s`, or each other.

        aligned: what is before was read, so that the file may end without a time.
        """
        definitions, times, end = list(self.walk.definitions), 0, len(self.data)
        for number in range(CHAIN_MAX):
            if number >= CHAIN_MIN and times >= CHAIN_TIMES:
                return True
            ends = at == self.end or end - at == CHECKSUM_BYTES
            if ends or header_size(self.data, at + CHECKSUM_BYTES):
                return times > 0 or aligned
            step = self.step(at, end, definitions) if at < end else None
            if step is None:
                return aligned and self.is_cut(at, definitions)
            if not step.is_data:
                definitions[self.data[at] & LOCAL_MASK] = step.definition
            elif step.offset_s is not None:
                times += 1
            elif step.definition.time_at:
                time_s = step.definition.time_s(self.data, at)
                if not time_s:
                    return False
                if last_s is not None and not near(time_s, last_s):
                    return False
                last_s, times = time_s, times + 1
            at = step.stop
        # So many in a row are no accident, even if they tell no time.
        return True

    def take(self, at: int, step: Step) -> None:
        """Keep a message."""
        definition, clock = step.definition, self.walk.clock
        if not step.is_data:
            encoded = self.data[at + 1 : step.stop]
            self.walk.definitions[self.data[at] & LOCAL_MASK] = self.walk.part.add(
                definition, encoded
            )
            self.latest = None
            return
        if step.offset_s is not None:
            time_s = clock.tick(self.data, step.offset_s)
            if time_s is not None:
                definition.time_of_offset[at] = time_s
        elif definition.time_at:
            time_s = definition.time_s(self.data, at)
            if time_s is not None and (
                self.chain(step.stop, time_s, True)
                if self.last_s is None
                else near(time_s, self.last_s)
            ):
                self.last_s = time_s
                clock.at, clock.definition = at, definition
        definition.offsets.append(at)
        self.latest = (at, definition)

    def find_next_message(self, at: int) -> int:
        """Where reading goes on behind a message that cannot be one; the end for nowhere."""
        data, end = self.data, len(self.data)
        begin = self.latest[0] + 1 if self.latest is not None else at + 1
        for place in range(begin, end - CHECKSUM_BYTES):
            if place != at and self.could_begin(place) and self.chain(place, self.last_s):
                self.salvage.add_problem("damaged", at)
                return self.go_on_from(at, place)
            if header_size(data, place + CHECKSUM_BYTES):
                self.salvage.add_problem("damaged", at)
                return place
        if self.last_s is not None and self.chain(at, None):
            # A clock that was set anew: what follows agrees with itself.
            self.last_s = None
            return at
        self.salvage.add_problem(
            "truncated" if self.is_cut(at, self.walk.definitions) else "damaged", at
        )
        self.salvage.skipped_bytes += end - at
        return end

    def is_cut(self, at: int, definitions: Definitions) -> bool:
        """Whether a message begins here that the end of the file cuts short."""
        end = len(self.data)
        if at >= end:
            return True
        head = self.data[at]
        if is_definition(head):
            return read_definition(self.data, at, end) is None
        definition = definition_of(head, definitions)
        return definition is not None and at + definition.size > end

    def could_begin(self, place: int) -> bool:
        """A quick look at a header byte, before the chain behind it is read."""
        head = self.data[place]
        return is_definition(head) or definition_of(head, self.walk.definitions) is not None

    def go_on_from(self, at: int, place: int) -> int:
        """Give up the message before damage, which reaches into it: it is not trusted.

        It is, when just one message is skipped: then that one's own header is what was damaged.
        """
        begin = at
        one_message = any(d is not None and place - at == d.size for d in self.walk.definitions)
        if self.latest is not None and not one_message:
            begin, definition = self.latest
            definition.offsets.pop()
            definition.time_of_offset.pop(begin, None)
        self.latest = None
        self.salvage.skipped_bytes += place - begin
        return place


def near(time_s: int, other_s: int) -> bool:
    """Whether two times may be of neighbours."""
    return abs(time_s - other_s) <= NEAR_S


def first_header(data: bytes) -> int | None:
    """Where the first file begins, also when its header's size is damaged; None for nowhere."""
    named = data.find(MAGIC, 0, SEARCHED_BYTES)
    return named - MAGIC_AT if named >= MAGIC_AT else None
