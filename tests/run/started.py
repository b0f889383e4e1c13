"""How many servers, browsers and other processes a run starts: told at its end, and bounded.

Each costs as much as dozens of tests; a run that starts more than it should fails, and says so.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

import pytest

SERVER_HERE = "servers in the tests' processes"
SERVER = "servers of their own"
COMMAND = "spindle commands"
UNIT = "simulated units"
READER = "readers of files"
COMPILER = "compilers"
BROWSER = "browsers"
OTHER = "other processes"

# The most of each in a run: what it takes, and room for a few tests more. Of the servers of their
# own nine are killed one after the other, in test_a_kill_leaves_nothing_half.py.
MOST = {SERVER_HERE: 90, SERVER: 25, COMMAND: 14, UNIT: 40, BROWSER: 6}
# An emulated board is a process wherever a unit of the host's build is none.
UNITS_ON_A_BOARD = 90

# By the first words that are found in a command.
KINDS: tuple[tuple[str, tuple[str, ...]], ...] = (
    (SERVER, ("backend.cli serve", "backend.dev")),
    (COMMAND, ("backend.cli", "bin/spindle")),
    (UNIT, ("sim_device unit",)),
    (READER, ("backend.formats.worker",)),
    (COMPILER, ("gcc", "clang", "cc ")),
)


def kind_of(words: Sequence[object]) -> str:
    """What a command starts."""
    line = " ".join(map(str, words))
    return next((kind for kind, signs in KINDS if any(s in line for s in signs)), OTHER)


class Started:
    """What this process of the run started. `note` is for what is no process."""

    def __init__(self) -> None:
        self.counts: Counter[str] = Counter()

    def note(self, kind: str) -> None:
        self.counts[kind] += 1

    def hear(self, event: str, given: tuple[object, ...]) -> None:
        """An audit hook: Python tells of each process that it starts."""
        if event == "subprocess.Popen":
            words = given[1]
            self.note(kind_of(words if isinstance(words, list | tuple) else [words]))


HERE = Started()


class Report:
    """Adds up what the workers started, tells it, and fails a run that started too much.

    more: how much may be started of some kinds, for `MOST`.
    """

    def __init__(self, more: Mapping[str, int]) -> None:
        self.total: Counter[str] = Counter()
        self.most = MOST | dict(more)

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: object) -> None:
        self.total += Counter(getattr(node, "workeroutput", {}).get("started", {}))

    @pytest.hookimpl(tryfirst=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        self.total += HERE.counts
        if too_many(self.total, self.most) and session.exitstatus == pytest.ExitCode.OK:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        for line in lines(self.total, self.most):
            terminalreporter.write_line(line)


class Counted:
    """In a worker: hands over what it started."""

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        session.config.workeroutput["started"] = dict(HERE.counts)  # type: ignore[attr-defined]


def too_many(counts: Counter[str], most: Mapping[str, int] | None = None) -> list[str]:
    """A line for each kind of which a run started more than it should."""
    return [
        f"{counts[kind]} {kind} were started, {limit} at most should be: let tests share one, or "
        "say in tests/run/started.py why there are more"
        for kind, limit in (most or MOST).items()
        if counts[kind] > limit
    ]


def lines(counts: Counter[str], most: Mapping[str, int] | None = None) -> Iterable[str]:
    """What was started, the most first."""
    if counts:
        yield "started: " + ", ".join(f"{count} {kind}" for kind, count in counts.most_common())
    yield from too_many(counts, most)


def counted(config: pytest.Config) -> None:
    """Counts what this process starts, and tells it if this process hands out the tests."""
    sys.addaudithook(HERE.hear)
    worker = hasattr(config, "workerinput")
    more = {UNIT: UNITS_ON_A_BOARD} if config.getoption("--unit", "host") == "qemu" else {}
    config.pluginmanager.register(Counted() if worker else Report(more), "started")
