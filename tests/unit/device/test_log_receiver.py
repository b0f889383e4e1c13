"""Goal: whatever a unit sends as its log, the host keeps a window of it and not a byte more.

Window and bitmap are those of SPEC chapter 2.5: pieces from the first missing one on.
"""

from __future__ import annotations

import random

from backend.device.ebl.session.log_receiver import LogReceiver
from firmware_protocol.codec import Bulk

CHUNK = 512
WINDOW = 32


def piece(number: int, session: int = 1) -> Bulk:
    return Bulk(session, 0, number * CHUNK, bytes([number % 251]) * CHUNK)


def receiver_of(pieces: int, window: int = WINDOW) -> LogReceiver:
    receiver = LogReceiver(1, 0.0)
    receiver.begin(0, pieces * CHUNK, CHUNK, window)
    return receiver


def held(receiver: LogReceiver) -> int:
    """Pieces that wait for one before them, from what the unit is told of them."""
    told = receiver.acknowledgement(5.0)
    assert told is not None
    return told.bitmap.bit_count()


def test_a_unit_that_sends_its_whole_log_but_the_first_piece_fills_one_window() -> None:
    receiver = receiver_of(10_000)

    for number in range(1, 10_000):
        receiver.take(piece(number), 0.0)

    assert held(receiver) == WINDOW - 1
    assert receiver.frames_foreign == 10_000 - WINDOW
    assert receiver.take_segments() == []


def test_the_missing_piece_makes_room_for_the_next_window() -> None:
    receiver = receiver_of(100, window=4)
    for number in (1, 2, 3, 4, 5):
        receiver.take(piece(number), 0.0)

    receiver.take(piece(0), 0.0)
    receiver.take(piece(7), 0.0)
    receiver.take(piece(8), 0.0)

    assert receiver.received == 4 * CHUNK
    assert b"".join(receiver.take_segments()) == b"".join(piece(n).data for n in range(4))
    assert held(receiver) == 1


def test_what_is_no_piece_of_this_log_is_counted_and_kept_nowhere() -> None:
    receiver = receiver_of(8)
    strange = [
        piece(0, session=2),
        piece(8),
        Bulk(1, 0, 1, bytes(CHUNK)),
        Bulk(1, 0, 0, bytes(CHUNK - 1)),
        Bulk(1, 0, 0, bytes(CHUNK + 1)),
        Bulk(1, 0, 0xFFFFFE00, bytes(CHUNK)),
    ]

    for frame in strange:
        receiver.take(frame, 0.0)

    assert receiver.frames_foreign == len(strange)
    assert receiver.frames == receiver.received == 0


def test_pieces_in_any_order_and_twice_over_are_the_log() -> None:
    receiver = receiver_of(200)
    drawn = random.Random(3)
    data = b""

    while not receiver.done:
        first = receiver.received // CHUNK
        window = list(range(first, min(first + WINDOW, 200))) * 2
        drawn.shuffle(window)
        for number in window:
            receiver.take(piece(number), 0.0)
        data += b"".join(receiver.take_segments())

    assert data == b"".join(piece(number).data for number in range(200))
