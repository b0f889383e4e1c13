"""What a link carried and lost, counted, never estimated."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass
class LinkStatistics:
    """Counters since the device was added; a copy is a consistent snapshot.

    frames_bad: damaged on the way (CRC, stuffing, length). frames_malformed: whole, but not of the
    protocol. responses_unexpected: to nothing we asked. stream_frames_foreign: of an earlier
    subscription, dropped instead of misread. stream_frames_repeated: a sequence number that does
    not go forward. round_trip_ms: smoothed, None before the first answer. unit_*: the unit's own
    count of stream frames since its subscription. balance_*: stream frames over all subscriptions,
    up to the unit's latest count that the stream has passed: built = received + lost on the line +
    dropped by the unit, exactly. unit_steps_missed: control steps that came too late for a row.
    unit_events_lost: numbers of events that did not come (yet); the unit was asked for its state
    instead. unit_events_again: repetitions of events that had come.
    bits_per_second: the line's rate now, None where it has none. clock_skew_ppm: how much faster
    than ours the unit's clock runs. clock_uncertainty_ms: how well its time is known,
    half of the shortest round trip.
    """

    bytes_received: int = 0
    bytes_sent: int = 0
    frames_received: int = 0
    frames_bad: int = 0
    frames_malformed: int = 0
    requests_sent: int = 0
    requests_repeated: int = 0
    requests_unanswered: int = 0
    responses_unexpected: int = 0
    stream_frames: int = 0
    stream_rows: int = 0
    stream_rows_lost: int = 0
    stream_frames_foreign: int = 0
    stream_frames_repeated: int = 0
    unit_events: int = 0
    unit_events_lost: int = 0
    unit_events_again: int = 0
    balance_built: int = 0
    balance_received: int = 0
    balance_lost: int = 0
    balance_dropped: int = 0
    unit_steps_missed: int = 0
    unit_frames_built: int | None = None
    unit_frames_dropped: int | None = None
    connections: int = 0
    events_dropped: int = 0
    round_trip_ms: float | None = None
    bits_per_second: int | None = None
    clock_skew_ppm: float | None = None
    clock_uncertainty_ms: float | None = None
