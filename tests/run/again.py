"""A browser test may be tried once more, and is named then; nothing else ever is.

A browser has clocks of its own. More than three in a run are no accident: the run fails.
"""

from __future__ import annotations

from collections.abc import Iterable

import pytest

MOST = 3


def may_be_tried_again(items: Iterable[pytest.Item]) -> None:
    """Marks the browser tests for pytest-rerunfailures."""
    for item in items:
        if item.nodeid.startswith("tests/browser/"):
            item.add_marker(pytest.mark.flaky(reruns=1))


class TriedAgain:
    """Of the process that hands out the tests."""

    def __init__(self) -> None:
        self.names: list[str] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.outcome == "rerun":
            self.names.append(report.nodeid)

    @pytest.hookimpl(tryfirst=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        if len(self.names) > MOST and session.exitstatus == pytest.ExitCode.OK:
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        for name in self.names:
            terminalreporter.write_line(f"tried again: {name}")
        if len(self.names) > MOST:
            terminalreporter.write_line(
                f"{len(self.names)} tests were tried again, {MOST} may be: the run has failed"
            )


def told(config: pytest.Config) -> None:
    """Names what was tried again at the end of the run."""
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(TriedAgain(), "tried again")
