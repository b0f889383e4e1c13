"""Goal: whatever the line does, no write is lost, doubled, mixed or wrongly reported, no value is
made up, assist stays within its limits, and after the faults everything comes to an end.

Method: 200 seeds of 40 simulated seconds (0.12 s of ours each), in `make test` the first 20, each
with faults of its own; the session against the unit's firmware on one virtual clock. Clients write,
try, unlock, ride and collect rides; judges read the unit's flash and its pins. Planted faults prove
that they see: in the host here, in the firmware with tools/mutation (`judged` in breaks.toml).
"""

from __future__ import annotations

import tomllib
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from backend.device.ebl.operations import config_transaction
from backend.device.ebl.session.log_receiver import LogReceiver
from backend.device.ebl.session.operation import Operation
from backend.device.ebl.session.requests import RequestTable
from backend.device.ebl.session.stream_receiver import StreamReceiver
from backend.errors import NoAnswer
from tests import counts
from tests.simulation import clients_trials, workload
from tests.simulation.workload import simulate
from tests.simulation.world import Verdict

REGRESSIONS = tomllib.loads(Path(__file__).with_name("regressions.toml").read_text())["seed"]
SEEDS_OF_THE_JOB = 200
SEEDS = counts.of(SEEDS_OF_THE_JOB)
SEEDS_A_TEST = 20
# A planted fault has to be found by the seeds that the job has.
SEEDS_UNTIL_FOUND_MAX = SEEDS_OF_THE_JOB
SEEDS_UNTIL_ALL_SEEN_MAX = 50
# Where a commit is carried out and its answer lost, at the time of writing; others follow.
SEED_WITH_A_LOST_COMMIT = 159


@cache
def lived(seed: int) -> Verdict:
    """A seed's story, lived once for all who look at it."""
    return simulate(seed)


@pytest.mark.large_count
@pytest.mark.parametrize("first", range(1, SEEDS + 1, SEEDS_A_TEST))
def test_every_seed_ends_well(first: int) -> None:
    wrong = {
        seed: verdict.wrong
        for seed in range(first, first + SEEDS_A_TEST)
        if (verdict := lived(seed)).wrong is not None
    }

    assert wrong == {}, "add the seed to regressions.toml; `make simulate SEED=n` tells its story"


@pytest.mark.parametrize("past", REGRESSIONS, ids=lambda past: str(past["seed"]))
def test_a_seed_that_once_failed_stays_well(past: dict[str, object]) -> None:
    assert lived(int(str(past["seed"]))).wrong is None, past["broke"]


def test_the_seeds_go_through_what_they_are_meant_to() -> None:
    figures: dict[str, int] = {}
    for seed in range(1, SEEDS_UNTIL_ALL_SEEN_MAX + 1):
        for name, count in lived(seed).figures.items():
            figures[name] = figures.get(name, 0) + count
        if all(figures.values()):
            break

    assert all(figures.values()), figures


@pytest.mark.parametrize("seed", [1, 7, 33])
def test_the_same_seed_is_the_same_story_to_the_byte(seed: int) -> None:
    assert simulate(seed) == lived(seed)


# ---------------------------------------------------------------- planted faults


def found(says: str, first: int = 1) -> bool:
    """Whether the judge says so of one of the job's seeds, from `first` on."""
    seeds = range(first, first + SEEDS_UNTIL_FOUND_MAX)
    return any(says in (simulate(seed).wrong or "") for seed in seeds)


@pytest.mark.long
def test_a_host_that_repeats_under_a_new_number_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """As if the unit suppressed no duplicates: a commit whose answer was lost is done again."""
    send = RequestTable._send

    def renumbered(self: RequestTable, entry: Any, now_s: float) -> bytes:
        if entry.attempts_left < entry.question.attempts:
            while self._next_tid in self._pending:
                self._next_tid = self._next_tid % 255 + 1
            entry.tid = self._next_tid
            self._next_tid = self._next_tid % 255 + 1
            entries = list(self._pending.values())
            self._pending.clear()
            self._pending.update({each.tid: each for each in entries})
        return send(self, entry, now_s)

    monkeypatch.setattr(RequestTable, "_send", renumbered)
    monkeypatch.setattr(config_transaction, "TRANSACTION_GONE", ())

    assert found("says that nothing changed", first=SEED_WITH_A_LOST_COMMIT)


def test_a_host_that_trusts_silence_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    def trusting(*arguments: object) -> Operation[None]:
        try:
            yield from commit(*arguments)  # type: ignore[arg-type]
        except NoAnswer:
            return

    commit = config_transaction._commit
    monkeypatch.setattr(config_transaction, "_commit", trusting)
    monkeypatch.setattr(config_transaction, "compare", lambda intended, found: None)

    assert found("; the unit holds another one")


def test_a_host_that_calls_a_lost_commit_undone_without_a_look_is_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def hasty(*_: object) -> Operation[Any]:
        yield from ()
        raise NoAnswer("The unit did not answer.", outcome="unchanged")

    monkeypatch.setattr(workload, "outcome_of_write", hasty)

    assert found("says that nothing changed")


def test_a_host_that_counts_no_gap_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    take = StreamReceiver.take

    def blind(self: StreamReceiver, frame: object, wall_us: int, late: bool) -> object:
        self._next_sequence = frame.seq  # type: ignore[attr-defined]
        return take(self, frame, wall_us, late)  # type: ignore[arg-type]

    monkeypatch.setattr(StreamReceiver, "take", blind)

    assert found("rows were lost and not counted")


def test_a_host_that_says_kept_and_never_asks_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    def lazy(intended: object, mtu: int) -> Operation[Any]:
        return config_transaction.read_config(mtu)

    monkeypatch.setattr(clients_trials, "confirm_config", lazy)

    assert found("would not survive a restart")


def test_a_host_that_takes_pieces_of_a_log_as_they_come_is_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    take = LogReceiver.take

    def in_order(self: LogReceiver, frame: Any, now_s: float) -> None:
        take(self, replace(frame, offset=self.received), now_s)

    monkeypatch.setattr(LogReceiver, "take", in_order)

    assert found("other ones from byte")
