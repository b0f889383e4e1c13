"""Goal: no bytes from the line make the unit's codec read or write where it may not.

Method: the C as it is in the unit, built with AddressSanitizer and UBSan, under seeded noise in
buffers that are exactly as long as they claim.
"""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

# Processes, compilers or hundreds of files: left out of `make test-fast`.
pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[2]
SOURCES = sorted((ROOT / "firmware_protocol" / "c").glob("*.c"))
STRICT = ["-std=c99", "-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror"]
SANITIZERS = ["-g", "-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"]


def compiler() -> str:
    found = shutil.which(os.environ.get("CC", "cc"))
    if found is None:
        pytest.fail("There is no C compiler, which `make setup` asks for.", pytrace=False)
    return found


@pytest.mark.host_build("compiles for the host")
def test_noise_on_the_line_breaks_no_rule_of_c(tmp_path: Path) -> None:
    program = tmp_path / "wire_storm"
    include = f"-I{ROOT / 'firmware_protocol' / 'c'}"
    storm = Path(__file__).with_name("wire_storm.c")
    build = subprocess.run(
        [compiler(), *STRICT, *SANITIZERS, include, storm, *SOURCES, "-o", program],
        capture_output=True,
        text=True,
        check=False,
    )
    if "-fsanitize" in build.stderr or "libasan" in build.stderr or "lubsan" in build.stderr:
        pytest.skip("this compiler has no sanitizers")
    assert build.returncode == 0, build.stderr

    run = subprocess.run([program], capture_output=True, text=True, timeout=120, check=False)

    assert run.returncode == 0, run.stdout + run.stderr
