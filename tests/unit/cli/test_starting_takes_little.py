"""Goal: the command answers at once, because it loads what a verb needs when the verb runs.

Method: what a new process has loaded when it ends; how long that takes depends on the machine.
"""

from __future__ import annotations

import json
import subprocess
import sys

import pytest

HEAVY = {"numpy", "pydantic", "cryptography", "fastapi", "sqlalchemy", "pyarrow", "reportlab"}
ROOMS = {
    "backend.law",
    "backend.formats",
    "backend.store",
    "backend.rides",
    "backend.tuning",
    "backend.web",
}
LOADED = """
import json, sys
from backend.cli import main
try:
    main(sys.argv[1:])
except SystemExit:
    pass
sys.stderr.write("\\n" + json.dumps(sorted(sys.modules)))
"""


@pytest.mark.parametrize(
    ("words", "beside"),
    [
        (["--help"], {"httpx"}),
        (["device", "list", "--server", "http://127.0.0.1:9"], set()),
        (["calibrate", "--help"], {"httpx"}),
    ],
)
def test_a_verb_loads_only_what_it_needs(words: list[str], beside: set[str]) -> None:
    run = subprocess.run(
        [sys.executable, "-c", LOADED, *words], capture_output=True, text=True, check=True
    )

    loaded = set(json.loads(run.stderr.splitlines()[-1]))
    assert "argparse" in loaded
    assert loaded & (HEAVY | ROOMS | beside) == set()
