"""A run leaves nothing: no process, and no file but what failed tests need for a look."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile

import pytest

from tests.run import guardian, place


class Guard:
    """Of the process that hands out the tests; the workers are what it guards."""

    def __init__(self, config: pytest.Config) -> None:
        self.folder = place.of_this_run()
        mark = self.folder.name
        if config.option.basetemp is None:
            config.option.basetemp = str(self.folder / "tests")
        environment = dict(os.environ)
        os.environ |= {guardian.VARIABLE: mark, "TMPDIR": str(self.folder / "tmp")}
        # Several tests run side by side already; more threads would only wait for each other.
        os.environ |= {"OPENBLAS_NUM_THREADS": "1", "POLARS_MAX_THREADS": "1"}
        tempfile.tempdir = None
        self._guardian = subprocess.Popen(
            [sys.executable, "-S", guardian.__file__, mark, str(self.folder)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            # Not one of those that it ends; and Ctrl-C in the terminal is for the run.
            env=environment,
            start_new_session=True,
        )
        self._kept = False
        # The first that is noted runs last: after everybody who ends something of their own.
        config.add_cleanup(self.wait_until_all_has_ended)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed and not self._kept:
            self._say("keep\n")
            self._kept = True

    def wait_until_all_has_ended(self) -> None:
        """Says what did not end by itself."""
        told, _ = self._guardian.communicate()
        if told.strip():
            sys.stderr.write(f"\nLeft running by the tests:\n{told}")
        if self._kept:
            sys.stderr.write(f"\nFiles of the failed tests, until the next run: {self.folder}\n")

    def _say(self, words: str) -> None:
        assert self._guardian.stdin is not None
        self._guardian.stdin.write(words)
        self._guardian.stdin.flush()


def guarded(config: pytest.Config) -> None:
    """Guards this run; a worker is guarded by who started it, a run within a test by its own."""
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        # A shell's background job ignores Ctrl-C, and so would what a test ends by it.
        signal.signal(signal.SIGINT, signal.default_int_handler)
    within = os.environ.get(guardian.VARIABLE)
    if not hasattr(config, "workerinput") and within is None:
        config.pluginmanager.register(Guard(config), "guard")
