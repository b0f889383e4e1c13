"""Finds the Chromium that drives the browser tests, or says exactly how to get one."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

# The same engine without windows: it starts sooner and computes less.
HEADLESS = ("chromium-headless-shell",)
INSTALLED = ("chromium", "chromium-browser", "google-chrome-stable", "google-chrome")
ADVICE = (
    "No Chromium was found for the browser tests. Do one of these:\n"
    "  sudo apt-get install chromium-headless-shell   (Debian; Ubuntu: chromium)\n"
    "  .venv/bin/playwright install chromium    (Playwright's own, any system)\n"
    "  export SPINDLE_CHROMIUM=/path/to/chrome  (one you already have)"
)


class NoChromium(Exception):
    """There is none; the message says how to get one."""


def find_chromium(own: str, headed: bool = False) -> str:
    """Path of a Chromium: SPINDLE_CHROMIUM, else an installed one, else `own`, Playwright's.

    headed: it must be able to show a window. Raises NoChromium; also when
    SPINDLE_CHROMIUM names a file that is not there.
    """
    named = os.environ.get("SPINDLE_CHROMIUM")
    if named:
        if Path(named).is_file():
            return named
        raise NoChromium(f"SPINDLE_CHROMIUM names {named}, and there is no such file.\n{ADVICE}")
    for name in INSTALLED if headed else (*HEADLESS, *INSTALLED):
        found = shutil.which(name)
        if found:
            return found
    if Path(own).is_file():
        return own
    raise NoChromium(ADVICE)
