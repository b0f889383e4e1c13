"""Goal: two hosts that know nothing of each other never mix, lose or double a change.

Method: a rule-based state machine (hypothesis) draws what either host does next, in any order, with
repeated frames, trials, power cuts inside flash writes and handshakes in between. A model of
a page says what the unit must answer; after every step the unit's active image is the model's.
"""

from __future__ import annotations

import zlib
from dataclasses import dataclass, field

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    rule,
)
from sim_device.firmware.python._native import lib

from firmware_protocol import codec
from firmware_protocol._generated import (
    CfgAbortRequest,
    CfgBeginRequest,
    CfgBeginResponse,
    CfgCommitRequest,
    CfgConfirmRequest,
    CfgRollbackRequest,
    CfgSetRequest,
    CfgValidateRequest,
    CommitFlags,
    HelloRequest,
    Status,
)
from firmware_protocol.layout import Message, Value
from firmware_protocol.parameters import pack_image, set_items, unpack_image
from tests.fakes.bench_unit import BenchUnit

LEASE_S = 30.0
COMMIT_PERIOD_S = 2.0
HOSTS = st.sampled_from([0, 1])
# An erase and a slot are some 1400 bytes: cuts fall before, inside and after.
CUTS = st.integers(min_value=0, max_value=1500)
CHANGES = st.fixed_dictionaries(
    {},
    optional={
        "pedal_stop_ms": st.integers(50, 1000),
        "assist_cutoff_kmh": st.sampled_from([10.0, 20.0, 25.0]),
        "fuzzy_gain_points": st.sampled_from(
            [[0.1, 0.2, 0.3, 0.4, 0.5], [0.1, 0.1, 0.3, 0.4, 0.5]]
        ),
    },
)


# Seconds a change is tried; 0 is for good.
TRIALS = st.sampled_from([0, 0, 5, 20])
# Mostly nothing; what another host, or time, may do between two steps of a write.
MEANWHILE = st.sampled_from(
    ["", "", "", "", "begins", "writes", "commits", "confirms", "reverts", "handshake", "lease"]
)


@dataclass
class Host:
    """What one host believes and has asked."""

    first_tid: int
    asked: int = 0
    base: tuple[int, bytes] = (0, b"")
    transaction: int = 0
    intended: dict[str, Value] = field(default_factory=dict)

    def tid(self) -> int:
        self.asked += 1
        return self.first_tid + self.asked % 100


class TwoHosts(RuleBasedStateMachine):
    """The model: the active image, and at most one open transaction."""

    def __init__(self) -> None:
        super().__init__()
        self.unit = BenchUnit()
        self.hosts = (Host(1), Host(101))
        self.generation, self.image = self.unit.read_image()
        self.now_s = 0.0
        self.open: int | None = None
        self.staged: dict[str, Value] = {}
        self.valid = False
        self.lease_end_s = 0.0
        self.commit_free_s = 0.0
        # What comes back unless somebody confirms, and when.
        self.way_back: tuple[int, bytes] | None = None
        self.trial_end_s = 0.0

    @initialize()
    def both_read(self) -> None:
        for host in self.hosts:
            host.base = (self.generation, self.image)
            host.intended = unpack_image(self.image)

    # ------------------------------------------------------------------ asking

    def ask(self, host: Host, message: Message) -> codec.Response:
        tid = host.tid()
        response = self.unit.ask_frame(codec.encode(codec.Request(tid, message)))
        repeated = codec.encode(codec.Request(tid, message, retransmit=True))
        assert self.unit.ask_frame(repeated) == response, "a repetition was done again"
        return response

    def knows(self, host: Host) -> bool:
        """Whether the host's transaction is the open one; its lease is then renewed."""
        if self.open is None or host.transaction != self.open:
            return False
        self.lease_end_s = self.now_s + LEASE_S
        return True

    @rule(index=HOSTS)
    def reads(self, index: int) -> None:
        self.hosts[index].base = self.unit.read_image()
        assert self.hosts[index].base == (self.generation, self.image)

    @rule(index=HOSTS)
    def begins(self, index: int) -> None:
        host = self.hosts[index]
        generation, image = host.base
        response = self.ask(host, CfgBeginRequest(generation, zlib.crc32(image)))

        if self.open is not None or self.way_back is not None:
            assert response.status == Status.BUSY
        elif (generation, image) != (self.generation, self.image):
            assert response.status == Status.STALE_BASE
        else:
            assert isinstance(response.message, CfgBeginResponse)
            self.open = host.transaction = response.message.transaction
            self.lease_end_s = self.now_s + LEASE_S
            self.staged, self.valid = unpack_image(self.image), False
            host.intended = dict(self.staged)

    @rule(index=HOSTS, changes=CHANGES)
    def sets(self, index: int, changes: dict[str, Value]) -> None:
        host = self.hosts[index]
        for items in set_items(changes):
            response = self.ask(host, CfgSetRequest(host.transaction, items))
            if self.knows(host):
                assert response.status == Status.OK
                self.staged, self.valid = self.staged | changes, False
            else:
                assert response.status in (Status.STATE, Status.EXPIRED)
        host.intended = host.intended | changes

    @rule(index=HOSTS)
    def validates(self, index: int) -> None:
        host = self.hosts[index]
        response = self.ask(host, CfgValidateRequest(host.transaction))

        if not self.knows(host):
            assert response.status in (Status.STATE, Status.EXPIRED)
            return
        points = self.staged["fuzzy_gain_points"]
        assert isinstance(points, list)
        self.valid = points[0] != points[1]
        assert response.status == (Status.OK if self.valid else Status.INVALID_CONFIG)

    @rule(index=HOSTS, moving=st.sampled_from([False, False, True]), trial_s=TRIALS)
    def commits(self, index: int, moving: bool, trial_s: int = 0) -> None:
        host = self.hosts[index]
        image = pack_image(host.intended)
        self.unit.inputs(speed_kmh=10.0 if moving else 0.0)
        response = self.ask(host, commit_request(host.transaction, image, trial_s))
        self.unit.inputs(speed_kmh=0.0)

        if not self.knows(host):
            assert response.status in (Status.STATE, Status.EXPIRED)
        elif not self.valid:
            assert response.status == Status.STATE
        elif image != pack_image(self.staged):
            assert response.status == Status.CRC_MISMATCH
        elif self._raises_a_limit():
            assert response.status == Status.ACCESS
        elif moving:
            assert response.status == Status.NOT_STOPPED
        elif image != self.image and self.now_s < self.commit_free_s:
            assert response.status == Status.RATE_LIMIT
        else:
            assert response.status == Status.OK
            self._committed(image, trial_s)

    def _raises_a_limit(self) -> bool:
        """Nobody here has a token, so the cut-off only goes down."""
        cutoff, active = self.staged["assist_cutoff_kmh"], unpack_image(self.image)
        assert isinstance(cutoff, float)
        return cutoff > float(str(active["assist_cutoff_kmh"]))

    def _committed(self, image: bytes, trial_s: int) -> None:
        if image != self.image:
            if trial_s:
                self.way_back = (self.generation, self.image)
                self.trial_end_s = self.now_s + trial_s
            self.generation += 1
            self.commit_free_s = self.now_s + COMMIT_PERIOD_S
        self.image, self.open = image, None

    @rule(index=HOSTS)
    def confirms(self, index: int) -> None:
        """Keeps what this host has read last, whoever wrote it."""
        host = self.hosts[index]
        generation, image = host.base
        response = self.ask(host, CfgConfirmRequest(generation, zlib.crc32(image)))

        if generation != self.generation:
            assert response.status == Status.STALE_BASE
        elif image != self.image:
            assert response.status == Status.CRC_MISMATCH
        else:
            assert response.status == Status.OK
            self.way_back = None

    @rule(index=HOSTS)
    def reverts(self, index: int) -> None:
        response = self.ask(self.hosts[index], CfgRollbackRequest())

        assert response.status == (Status.STATE if self.way_back is None else Status.OK)
        self._returned()

    def _returned(self) -> None:
        if self.way_back is not None:
            self.generation, self.image = self.way_back
            self.way_back = None

    @rule(index=HOSTS)
    def aborts(self, index: int) -> None:
        host = self.hosts[index]
        response = self.ask(host, CfgAbortRequest(host.transaction))

        assert (response.status == Status.OK) == self.knows(host)
        if response.status == Status.OK:
            self.open = None

    @rule(
        index=HOSTS,
        changes=CHANGES,
        wait=st.booleans(),
        fresh=st.booleans(),
        between=st.lists(MEANWHILE, min_size=4, max_size=4),
        trial_s=TRIALS,
    )
    def writes(
        self,
        index: int,
        changes: dict[str, Value],
        wait: bool,
        fresh: bool,
        between: list[str],
        trial_s: int = 0,
    ) -> None:
        """The whole way in one go, with something happening between its steps."""
        if wait:
            self.time_passes(COMMIT_PERIOD_S)
        if fresh:
            self.reads(index)
        self._meanwhile(between[0], 1 - index)
        self.begins(index)
        self._meanwhile(between[1], 1 - index)
        self.sets(index, changes)
        self._meanwhile(between[2], 1 - index)
        self.validates(index)
        self._meanwhile(between[3], 1 - index)
        self.commits(index, False, trial_s)

    def _meanwhile(self, what: str, other: int) -> None:
        if what == "begins":
            self.begins(other)
        elif what == "writes":
            self.writes(other, {"pedal_stop_ms": 777}, True, True, [""] * 4)
        elif what == "handshake":
            self.handshake(other)
        elif what == "confirms":
            self.reads(other)
            self.confirms(other)
        elif what == "reverts":
            self.reverts(other)
        elif what == "commits":
            self.commits(other, False)
        elif what == "lease":
            self.time_passes(LEASE_S + 1.0)

    # ------------------------------------------------------------------ the world

    @rule(index=HOSTS)
    def handshake(self, index: int) -> None:
        self.ask(self.hosts[index], HelloRequest(1, 1, 0, 544, bytes([index] * 8)))
        self.open = None

    @rule(seconds=st.sampled_from([0.1, 2.0, 15.0, 31.0]))
    def time_passes(self, seconds: float) -> None:
        self.unit.advance(seconds)
        self.now_s += seconds
        if self.open is not None and self.now_s >= self.lease_end_s:
            self.open = None
        if self.now_s >= self.trial_end_s:
            self._returned()

    @rule(index=HOSTS, cut=CUTS, trial_s=TRIALS)
    def loses_power_while_committing(self, index: int, cut: int, trial_s: int) -> None:
        """Whatever byte the supply fails at: exactly the old or exactly the new one boots."""
        host = self.hosts[index]
        writes = self.open is not None and host.transaction == self.open and self.valid
        lib.bench_flash_cut_after(self.unit.board, cut)
        image = pack_image(host.intended)
        self.ask(host, commit_request(host.transaction, image, trial_s))
        self.unit.boot()
        found = self.unit.read_image()

        # No trial survives a restart, neither one that ran nor one that began here.
        self._returned()
        lasting = writes and trial_s == 0
        news = (self.generation + 1, pack_image(self.staged)) if lasting else None
        assert found in ((self.generation, self.image), news)
        self.generation, self.image = found
        self.open, self.now_s, self.commit_free_s = None, 0.0, 0.0
        for each in self.hosts:
            each.transaction = 0

    @invariant()
    def the_unit_holds_what_the_model_says(self) -> None:
        assert self.unit.read_image() == (self.generation, self.image)


def commit_request(transaction: int, image: bytes, trial_s: int) -> CfgCommitRequest:
    flags = CommitFlags.PROVISIONAL if trial_s else 0
    return CfgCommitRequest(transaction, zlib.crc32(image), flags, trial_s)


TwoHosts.TestCase.settings = settings(
    max_examples=100,
    stateful_step_count=30,
    deadline=None,
    suppress_health_check=list(HealthCheck),
)
test_two_hosts_never_mix_a_change = pytest.mark.board_long(TwoHosts.TestCase)
