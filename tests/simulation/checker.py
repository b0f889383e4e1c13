"""The judge beside the bike: sees what the unit really sends, holds and does, and checks the host.

It taps the line at the unit's own pins, before any fault, and after every change of the flash it
boots a twin from a copy to learn what a restart would bring. Nothing of what it knows comes from
the session under test.
"""

from __future__ import annotations

import zlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from backend.device.configuration import ConfigImage, TrialStatus
from backend.device.readings import Snapshot
from backend.device.stream import StreamBlock
from firmware_protocol._generated import (
    CHANNELS,
    PARAMETER_BY_NAME,
    AuthChallengeResponse,
    Bank,
    CfgInfoRequest,
    CfgReadRequest,
    MessageId,
    Status,
    StreamCountsEvent,
    StrSnapshotResponse,
    StrSubscribeResponse,
)
from firmware_protocol.bands import bands_left
from firmware_protocol.codec import Event, Request, Response, Stream, decode, encode
from firmware_protocol.framing import FrameDecoder, encode_frame
from firmware_protocol.layout import MISSING, Message, Value
from firmware_protocol.parameters import pack_image, unpack_image
from sim_device.firmware.python.unit import LOG_BLOCK_LENGTH
from sim_device.lockstep import LockstepUnit
from tests.simulation.checks_logs import LogChecks
from tests.simulation.checks_trials import TrialChecks
from tests.simulation.checks_unlock import UnlockChecks
from tests.simulation.violation import Violation

# The configuration's two slots; the rest of the flash is not about configuration.
SLOTS_BYTES = 2048
# Names the write in the image it makes: a text of its own for every write.
MARKER = "fuzzy_table_name"
# Float32 noise of the law; a demand above the limit by more than this is a violation.
TORQUE_NOISE_NM = 1e-4
SPEED_NOISE_KMH = 1e-3
ANSWER_MS_MAX = 100
NO_EPOCH = -1


@dataclass
class Generation:
    """A configuration the flash holds, as a restarted unit would report it."""

    number: int
    image: bytes

    @cached_property
    def values(self) -> dict[str, Value]:
        """Parameters by name."""
        return unpack_image(self.image)


@dataclass
class Intent:
    """A write somebody asked for. outcome: None while it runs.

    confirm_s: 0 for good, else on trial. keep_asked, return_asked: by its author. authorised: by
    the maker.
    """

    marker: str
    changes: Mapping[str, Value]
    outcome: str | None = None
    confirm_s: int = 0
    keep_asked: bool = False
    return_asked: bool = False
    authorised: bool = False


@dataclass
class _SentStream:
    """Frames of one subscription at the unit's pins."""

    sequence: set[int] = field(default_factory=set)
    told: list[tuple[int, int]] = field(default_factory=list)


class Checker:
    """Safety checkers. Every method raises Violation with what was seen."""

    def __init__(self, unit: LockstepUnit) -> None:
        flash = unit.unit.flash()
        self.generations: list[Generation] = [boot_twin(flash)]
        self.trials = TrialChecks()
        self.unlock = UnlockChecks(flash)
        self.logs = LogChecks(unit.unit.log())
        self.boot = 1
        self._flash = flash
        self._log_changes = unit.unit.log_changes
        self.intents: dict[str, Intent] = {}
        self._unchanged_promised: set[str] = set()
        self._slots = flash[:SLOTS_BYTES]
        self._decoder = FrameDecoder()
        self._rows: dict[int, list[tuple[int, bytes]]] = {}
        self._snapshots: set[tuple[int, bytes]] = set()
        self._streams: dict[int, _SentStream] = {}
        self._epoch = NO_EPOCH
        self.frames_seen = 0
        self.conservation_checks = 0

    @property
    def active(self) -> Generation:
        """What a restart of the unit would bring."""
        return self.generations[-1]

    # ------------------------------------------------------------------ the unit's side

    def restarted(self) -> None:
        """A unit with a new RAM is on the line."""
        self._decoder = FrameDecoder()
        self._streams.clear()
        self._epoch = NO_EPOCH
        self.boot += 1
        self._log_changes = -1
        self.unlock.restarted()

    def said(self, data: bytes) -> None:
        """Bytes the unit sent, as it sent them."""
        for frame in self._decoder.feed(data):
            self.frames_seen += 1
            message = decode(frame)
            if isinstance(message, Stream):
                self._stream(message)
            elif isinstance(message, Event) and isinstance(message.message, StreamCountsEvent):
                stats = message.message
                sent = self._streams.setdefault(self._epoch, _SentStream())
                sent.told.append((stats.built, stats.dropped_tx))
            elif isinstance(message, Response):
                self._response(message)

    def _response(self, response: Response) -> None:
        answer = response.message
        if response.message_id == MessageId.AUTH_RESPONSE and response.status == Status.AUTH_BAD:
            self.unlock.refused(response.detail)
        if isinstance(answer, AuthChallengeResponse):
            self.unlock.challenged(answer)
        elif isinstance(answer, StrSnapshotResponse):
            self._snapshots.add((answer.t_us, bytes(answer.values)))
        elif isinstance(answer, StrSubscribeResponse) and answer.epoch != self._epoch:
            self._epoch = answer.epoch
            self._streams[answer.epoch] = _SentStream()

    def _stream(self, frame: Stream) -> None:
        self._rows.setdefault(frame.t0_us, []).append((frame.seq, frame.values.tobytes()))
        sent = self._streams[frame.epoch]
        sent.sequence.add(frame.seq)
        while sent.told and frame.seq >= sent.told[0][0]:
            built, dropped = sent.told.pop(0)
            missing = built - sum(1 for seq in sent.sequence if seq < built)
            self.conservation_checks += 1
            if missing != dropped:
                raise Violation(
                    f"The unit built {built} frames and says it dropped {dropped}; "
                    f"{missing} never left it."
                )

    def looked(self, unit: LockstepUnit) -> Generation | None:
        """Look at the flash; the new configuration if there is one."""
        if unit.unit.log_changes != self._log_changes:
            self._log_changes = unit.unit.log_changes
            self.logs.looked(unit.unit.log())
        flash = unit.unit.flash()
        if flash == self._flash and self.trials.current is None:
            return None
        unit_s = unit.unit.observe(("t_s",))["t_s"]
        found = None
        if flash != self._flash:
            self._flash = flash
            self.unlock.looked(flash, unit_s)
            found = self._slots_looked(flash, unit_s)
        if unit.unit.powered:
            self.trials.passed(unit_s, self.boot)
        return found

    def _slots_looked(self, flash: bytes, unit_s: float) -> Generation | None:
        slots = flash[:SLOTS_BYTES]
        if slots == self._slots:
            return None
        self._slots = slots
        current = self.trials.current
        trial = self.trials.looked(slots, unit_s, self.boot)
        if current is not None and current.ended is not None:
            current.return_asked = self.intents[current.marker].return_asked
            if current.ended == "asked" and not current.return_asked:
                raise Violation(f"{current.marker} was given up; nobody asked and its time ran.")
        if trial is not None:
            intent = self._is_one_whole_write(self.active, Generation(trial.number, trial.image))
            trial.marker, trial.confirm_s = intent.marker, intent.confirm_s
            if not intent.confirm_s:
                raise Violation(f"{intent.marker} is on trial; it was to be written for good.")
        found = boot_twin(flash)
        before = self.active
        if found.image == before.image and found.number == before.number:
            return None
        intent = self._is_one_whole_write(before, found)
        if intent.confirm_s and not intent.keep_asked:
            raise Violation(f"{intent.marker} would last; its author only tried it.")
        self.generations.append(found)
        return found

    def _is_one_whole_write(self, before: Generation, found: Generation) -> Intent:
        if found.number != before.number + 1:
            raise Violation(f"Generation {before.number} became {found.number}.")
        marker = str(found.values[MARKER])
        intent = self.intents.get(marker)
        if intent is None:
            raise Violation(f"Generation {found.number} carries {marker!r}, which nobody wrote.")
        if found.image != pack_image({**before.values, **intent.changes}):
            raise Violation(f"Generation {found.number} is not {marker} on {before.number}.")
        if any(str(past.values[MARKER]) == marker for past in self.generations):
            raise Violation(f"{marker} was applied twice.")
        if marker in self._unchanged_promised:
            raise Violation(
                f"{marker} is in the unit; its author was told {intent.outcome!r}, "
                "which says that nothing changed."
            )
        raised = raised_limits(before.values, found.values)
        if raised and not intent.authorised:
            raise Violation(f"{marker} raised {raised} without the maker's word for it.")
        return intent

    def assist_is_within_limits(self, seen: Mapping[str, Any]) -> None:
        """The demand of this control step against the configurations it may be running on."""
        demand_nm = seen["motor_demand_nm"]
        if demand_nm == 0.0:
            return
        running = [generation.values for generation in self.generations[-2:]]
        running += self.trials.limits(seen["t_s"])
        limit_nm = max(float(str(values["motor_torque_nm_max"])) for values in running)
        cutoff_kmh = max(float(str(values["assist_cutoff_kmh"])) for values in running)
        if not 0.0 <= demand_nm <= limit_nm + TORQUE_NOISE_NM:
            raise Violation(f"The motor is asked for {demand_nm} Nm; the limit is {limit_nm} Nm.")
        if demand_nm > 0.0 and seen["speed_kmh"] > cutoff_kmh + 1.0:
            raise Violation(
                f"Assist of {demand_nm} Nm at {seen['speed_kmh']:.2f} km/h, cut off at "
                f"{cutoff_kmh} km/h."
            )

    # ------------------------------------------------------------------ the host's side

    def shown_block(self, block: StreamBlock) -> None:
        """Rows that reached a listener: sent so by the unit, and counted exactly."""
        values = block.values.tobytes()
        sent = [seq for seq, rows in self._rows.get(block.t0_us, []) if rows == values]
        if not sent:
            raise Violation(f"Rows at {block.t0_us} us were shown that the unit never sent.")
        if not any(block.first_index == seq * len(block.values) for seq in sent):
            raise Violation(
                f"The rows at {block.t0_us} us are number {block.first_index} to the host and "
                f"frame {sent} of the unit: rows were lost and not counted, or counted twice."
            )

    def shown_values(self, values: Snapshot) -> None:
        """A row somebody asked for."""
        counts = bytearray()
        for channel in CHANNELS:
            value = values.channels[channel.name]
            count = MISSING if value is None else round(value / float(channel.scale))
            counts += count.to_bytes(2, "little", signed=True)
        if (values.t_us, bytes(counts)) not in self._snapshots:
            raise Violation(f"Values at {values.t_us} us were shown that the unit never sent.")

    def shown_config(self, config: ConfigImage) -> None:
        """A configuration somebody read: the unit had exactly this one."""
        image = pack_image(config.parameters)
        had = [past.image for past in self.generations if past.number == config.generation]
        had += [past.image for past in self.trials.trials if past.number == config.generation]
        if image not in had or zlib.crc32(image) != config.crc32:
            raise Violation(f"Generation {config.generation} was shown; the unit never had it.")

    def verified(self, intent: Intent, config: ConfigImage) -> None:
        """A write that came back as done and proven."""
        self.shown_config(config)
        intent.outcome = "verified"
        if config.parameters[MARKER] != intent.marker:
            raise Violation(f"{intent.marker} was verified; the unit holds another one.")
        if self.active.number < config.generation:
            raise Violation(f"{intent.marker} was verified and would not survive a restart.")

    def tried(self, intent: Intent, config: ConfigImage) -> None:
        """A trial that came back as running."""
        self.shown_config(config)
        intent.outcome = "on trial"
        if config.parameters[MARKER] != intent.marker:
            raise Violation(f"{intent.marker} was said to be on trial; the unit holds another one.")

    def status_told(self, status: TrialStatus, boot: int) -> None:
        """Where the unit says it stands, asked while nothing changes and nothing goes wrong."""
        current = self.trials.current
        number = self.active.number if current is None else current.number
        if (status.on_trial, status.generation) != (current is not None, number):
            raise Violation(f"{status} is told; the flash has generation {number}.")
        reasons = self.trials.reasons_in(boot)
        if status.rollback_cause not in reasons:
            raise Violation(
                f"The unit says its last trial ended by {status.rollback_cause!r}; "
                f"it was {reasons}."
            )

    def again(self, intent: Intent) -> None:
        """The author of a refused write tries it once more."""
        self._unchanged_promised.discard(intent.marker)

    def refused(self, intent: Intent, outcome: str) -> None:
        """A write whose author was told that the unit is unchanged."""
        intent.outcome = outcome
        self._unchanged_promised.add(intent.marker)
        if any(str(past.values[MARKER]) == intent.marker for past in self.generations):
            raise Violation(
                f"{intent.marker} is in the unit; its author was told {outcome!r}, which says "
                "that nothing changed."
            )


def raised_limits(before: Mapping[str, Value], after: Mapping[str, Value]) -> list[str]:
    """The limits that went up, of those that may only go down, and the bands that were left."""
    raised = [
        name
        for name, row in PARAMETER_BY_NAME.items()
        if row.ratchet and float(str(after[name])) > float(str(before[name]))
    ]
    return raised + [band.parameter for band in bands_left(before, after)]


def boot_twin(flash: bytes) -> Generation:
    """What a unit with this flash reports after a restart, asked over a clean line."""
    no_log = b"\xff" * LOG_BLOCK_LENGTH
    twin = LockstepUnit(seed=0, name="twin", flash=flash, log=no_log, boot_id=0xFFFF)
    decoder = FrameDecoder()
    info: Any = _asked(twin, decoder, CfgInfoRequest(), 1)
    image = b""
    while len(image) < info.image_length:
        request = CfgReadRequest(Bank.ACTIVE, len(image), info.image_length - len(image))
        part: Any = _asked(twin, decoder, request, 2 + len(image) % 200)
        image += part.data
    return Generation(info.generation, image)


def _asked(twin: LockstepUnit, decoder: FrameDecoder, request: Message, tid: int) -> Message:
    twin.send(encode_frame(encode(Request(tid, request))))
    for _ in range(ANSWER_MS_MAX):
        twin.advance(0.001)
        for frame in decoder.feed(twin.receive()):
            answer = decode(frame)
            if isinstance(answer, Response) and answer.message is not None:
                return answer.message
    raise Violation(f"A unit restarted from this flash does not answer {request}.")
