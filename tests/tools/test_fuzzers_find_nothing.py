"""Goal: no input makes the unit's C break a rule of C, nor the host's Python fail unexpectedly.

Method: coverage-guided fuzzing from the golden vectors. In `make test` two targets of the host run
for a second, and the unit's C meets the storm of tests/conformance/wire_storm.c and a sanitizer
(test_app_sanitized.py) instead; `make prove` fuzzes all, the C with clang's libFuzzer. `make fuzz
SECONDS=3600` runs them as long as one likes.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests import counts
from tests.fakes.built_once import built_once
from tools.fuzz import harness

pytestmark = [pytest.mark.slow, pytest.mark.large_count]

# What anybody may send over a line or upload; the others take as long to start.
ALWAYS = ("wire", "fit")
HOST_TARGETS = [
    pytest.param(name, marks=[] if name in ALWAYS else pytest.mark.long)
    for name in ("wire", "csv", "fit", "track", "mahle", "log", "archive", "head")
]
SECONDS = counts.of(20, share=20)


@pytest.fixture(scope="module")
def clang(tmp_path_factory: pytest.TempPathFactory) -> str:
    found = harness.compiler(tmp_path_factory.mktemp("probe"))
    if found is None:
        pytest.fail("There is no clang with libFuzzer: .ci/ensure-tools fuzzing", pytrace=False)
    return found


@pytest.fixture(scope="module")
def objects(clang: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The unit's sources, compiled for all targets."""
    return built_once(
        tmp_path_factory, "fuzz_objects", lambda folder: harness.compile_unit(clang, folder)
    )


@pytest.mark.long
@pytest.mark.parametrize("target", harness.TARGETS)
def test_no_input_found_breaks_the_unit(
    clang: str, objects: Path, target: str, tmp_path: Path
) -> None:
    program = harness.build(clang, target, objects, tmp_path)
    corpus = harness.write_corpus(target, tmp_path)

    done = harness.run(program, corpus, SECONDS, tmp_path)

    assert done.returncode == 0, done.stderr[-4000:]
    assert harness.executions(done.stderr) > 100


@pytest.mark.parametrize("target", HOST_TARGETS)
def test_no_input_found_breaks_the_host(target: str, tmp_path: Path) -> None:
    pytest.importorskip("atheris", reason="atheris has no wheel for this machine")

    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "tools.fuzz.host",
            target,
            f"-max_total_time={SECONDS}",
            "-seed=1",
            f"-artifact_prefix={tmp_path}/",
        ],
        cwd=harness.ROOT,
        capture_output=True,
        text=True,
        check=False,
        timeout=SECONDS + 120,
    )

    assert done.returncode == 0, done.stderr[-4000:]
    assert "Done " in done.stderr
