"""What a serial line can do to bytes, and a wire that does it.

A serial line never reorders, so neither does this one. Rates are drawn per seed, some of them zero,
so that seeds differ in kind and not only in degree (swarm testing).
"""

from __future__ import annotations

import random
from collections import deque
from dataclasses import dataclass, fields

BITS_PER_BYTE = 10
# What an adapter holds; more falls out, as it does in a real one.
BUFFER_BYTES_MAX = 4096
RUN_BYTES_MAX = 40
PIECES_MAX = 6


@dataclass(frozen=True)
class LinkFaults:
    """Each field is one thing that goes wrong; 0 means it does not."""

    drop_per_byte: float = 0.0
    """A run of 1 to 40 bytes never arrives: an overrun of the receiver's buffer."""
    flip_per_byte: float = 0.0
    """One bit of a byte arrives as the other: noise on the line."""
    duplicate_per_byte: float = 0.0
    """A run of 1 to 40 bytes arrives twice: a bridge repeats a packet."""
    split: float = 0.0
    """Part of the deliveries that come in up to six pieces instead of one."""
    stall_per_s: float = 0.0
    """The line takes nothing for up to 3 s, then everything that waited comes at once."""
    delay_s: float = 0.0
    """Each byte is on its way this long, and up to half as long again."""
    garbage_per_s: float = 0.0
    """For up to 0.3 s every byte arrives as another: the two sides disagree on the baud rate."""
    half_open_per_s: float = 0.0
    """For up to 4 s this direction is dead while the other works: a broken conductor."""
    reset_per_s: float = 0.0
    """The unit restarts, in the middle of a frame if one is being sent."""
    brown_out_per_commit: float = 0.0
    """The supply fails at some byte of a flash write; the unit comes back a second later."""
    brown_out_per_ride: float = 0.0
    """The same in a write to the flash for ride logs."""
    unplug_per_s: float = 0.0
    """The cable is pulled for up to 3 s; what was on its way is gone."""

    def told(self) -> str:
        """The faults that are not zero."""
        return ", ".join(
            f"{field.name} {value:.3g}"
            for field in fields(self)
            if (value := getattr(self, field.name))
        )


CALM = LinkFaults()

# From, to: the factor between them is why rates are drawn on a logarithmic scale.
RANGES = {
    "drop_per_byte": (1e-5, 1e-3),
    "flip_per_byte": (1e-5, 1e-3),
    "duplicate_per_byte": (1e-5, 1e-3),
    "split": (0.05, 1.0),
    "stall_per_s": (0.02, 0.3),
    "delay_s": (0.002, 0.2),
    "garbage_per_s": (0.02, 0.3),
    "half_open_per_s": (0.02, 0.15),
    "reset_per_s": (0.01, 0.1),
    "brown_out_per_commit": (0.1, 0.6),
    "brown_out_per_ride": (0.3, 0.9),
    "unplug_per_s": (0.01, 0.1),
}
# How likely each fault is to be there: a seed is nearly calm, rough, or worse than any desk.
LIKELY = (0.15, 0.35, 0.6)


def draw_faults(chance: random.Random) -> LinkFaults:
    """The faults of one seed: each is there or not, and somewhere in its range."""
    rates = {}
    likely = chance.choice(LIKELY)
    for name, (low, high) in RANGES.items():
        rate = low * (high / low) ** chance.random()
        if chance.random() < likely:
            rates[name] = rate
    return LinkFaults(**rates)


class FaultyWire:
    """One direction of the line. Bytes go in as they are sent and come out as they arrive."""

    def __init__(self, chance: random.Random, faults: LinkFaults, bytes_per_s: float) -> None:
        self.faults = faults
        self.bytes_per_s = bytes_per_s
        self.lost_bytes = 0
        self._chance = chance
        self._waiting: deque[bytes] = deque()
        self._waiting_bytes = 0
        self._on_the_way: deque[tuple[float, bytes]] = deque()
        self._credit = 0.0
        self._stalled_until_s = 0.0
        self._garbage_until_s = 0.0
        self._dead_until_s = 0.0

    @property
    def queued_bytes(self) -> int:
        """Bytes that were sent and have not left."""
        return self._waiting_bytes

    def stalled(self, now_s: float) -> bool:
        """Whether the line takes nothing."""
        return now_s < self._stalled_until_s

    def calm(self) -> None:
        """No fault from now on; what is under way arrives."""
        self.faults = CALM
        self._stalled_until_s = self._garbage_until_s = self._dead_until_s = 0.0

    def cut(self) -> None:
        """The cable is pulled: nothing that is under way arrives."""
        self._waiting.clear()
        self._waiting_bytes = 0
        self._on_the_way.clear()

    def put(self, data: bytes) -> None:
        """Bytes sent; what the adapter has no room for is lost."""
        room = BUFFER_BYTES_MAX - self._waiting_bytes
        self.lost_bytes += max(0, len(data) - room)
        if data[:room]:
            self._waiting.append(data[:room])
            self._waiting_bytes += len(data[:room])

    def take(self, now_s: float, step_s: float) -> list[bytes]:
        """What arrives now, in the pieces in which it arrives."""
        self._misfortune(now_s, step_s)
        if not self.stalled(now_s):
            self._send(now_s, step_s)
        arrived = bytearray()
        while self._on_the_way and self._on_the_way[0][0] <= now_s:
            arrived += self._on_the_way.popleft()[1]
        if not arrived:
            return []
        if self._chance.random() < self.faults.split:
            return self._split(bytes(arrived))
        return [bytes(arrived)]

    def _split(self, data: bytes) -> list[bytes]:
        """In pieces; what is short comes byte by byte."""
        if len(data) <= PIECES_MAX:
            return [bytes([byte]) for byte in data]
        cuts = sorted(self._chance.sample(range(1, len(data)), PIECES_MAX - 1))
        return [data[a:b] for a, b in zip([0, *cuts], [*cuts, len(data)], strict=True)]

    def _misfortune(self, now_s: float, step_s: float) -> None:
        faults, chance = self.faults, self._chance
        if faults.stall_per_s and chance.random() < faults.stall_per_s * step_s:
            self._stalled_until_s = now_s + chance.uniform(0.1, 3.0)
        if faults.garbage_per_s and chance.random() < faults.garbage_per_s * step_s:
            self._garbage_until_s = now_s + chance.uniform(0.02, 0.3)
        if faults.half_open_per_s and chance.random() < faults.half_open_per_s * step_s:
            self._dead_until_s = now_s + chance.uniform(0.2, 4.0)

    def _send(self, now_s: float, step_s: float) -> None:
        self._credit = min(self._credit + self.bytes_per_s * step_s, self.bytes_per_s)
        leaving = bytearray()
        while self._waiting and self._credit >= 1.0:
            piece = self._waiting.popleft()
            count = min(len(piece), int(self._credit))
            leaving += piece[:count]
            if piece[count:]:
                self._waiting.appendleft(piece[count:])
            self._credit -= count
            self._waiting_bytes -= count
        if not self._waiting:
            self._credit = min(self._credit, self.bytes_per_s * step_s)
        harmed = self._harmed(bytes(leaving), now_s)
        if harmed:
            due_s = now_s + self.faults.delay_s * self._chance.uniform(1.0, 1.5)
            last_s = self._on_the_way[-1][0] if self._on_the_way else 0.0
            self._on_the_way.append((max(due_s, last_s), harmed))

    def _harmed(self, data: bytes, now_s: float) -> bytes:
        faults, chance = self.faults, self._chance
        if now_s < self._dead_until_s:
            self.lost_bytes += len(data)
            return b""
        if now_s < self._garbage_until_s:
            return chance.randbytes(len(data))
        for at in self._hits(len(data), faults.flip_per_byte):
            data = data[:at] + bytes([data[at] ^ 1 << chance.randrange(8)]) + data[at + 1 :]
        for at in self._hits(len(data), faults.drop_per_byte):
            run = chance.randint(1, RUN_BYTES_MAX)
            self.lost_bytes += len(data[at : at + run])
            data = data[:at] + data[at + run :]
        for at in self._hits(len(data), faults.duplicate_per_byte):
            run = chance.randint(1, RUN_BYTES_MAX)
            data = data[: at + run] + data[at : at + run] + data[at + run :]
        return data

    def _hits(self, length: int, per_byte: float) -> list[int]:
        """Places of a fault in so many bytes."""
        if not per_byte or not length:
            return []
        places = []
        at = int(self._chance.expovariate(per_byte))
        while at < length:
            places.append(at)
            at += 1 + int(self._chance.expovariate(per_byte))
        return places
