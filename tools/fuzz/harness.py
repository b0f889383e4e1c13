"""Builds and runs the libFuzzer harnesses of this folder.

They need clang with libFuzzer and its sanitizers; on Debian and Ubuntu that is
`apt-get install clang libclang-rt-14-dev` (the number is clang's). Nothing else here needs clang.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

from firmware_protocol.framing import encode_frame

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
TARGETS = ("receive", "unit", "flash", "ride_log")
INCLUDES = (
    "firmware_protocol/c",
    "sim_device/firmware/control",
    "sim_device/firmware/app",
    "sim_device/firmware/hal",
    "sim_device/firmware/boards/host",
    "sim_device/physics",
    "third_party/monocypher",
)
SOURCE_FOLDERS = (
    "firmware_protocol/c",
    "sim_device/firmware/app",
    "sim_device/firmware/control",
    "third_party/monocypher",
)
BOARD = ("bench_board.c", "log_flash.c")
COMPILERS = ("clang", *(f"clang-{version}" for version in range(22, 12, -1)))
OPTIONS = (
    "-std=c99",
    "-g",
    "-O1",
    "-ffp-contract=off",
    "-fsanitize=fuzzer,address,undefined",
    "-fno-sanitize-recover=all",
)
EMPTY = "int LLVMFuzzerTestOneInput(const char *d, unsigned long n);\n"
EMPTY += "int LLVMFuzzerTestOneInput(const char *d, unsigned long n) { return !d && n; }\n"
LENGTH_MAX = 4096
# Scripts of pages for fuzz_ride_log.c: place, kind, filling, type, length, log, boot, number, time,
# its shift, rows. A log of three pages; one of which the second block is torn; two logs.
RIDE_LOG_PAGES = tuple(
    bytes([len(pages)]) + b"".join(bytes([*page[:2], 7, *page[2:], 9, 20, 11]) for page in pages)
    for pages in (
        ((0, 0, 1, 200, 1, 1, 0), (1, 0, 2, 60, 1, 1, 1), (2, 0, 3, 220, 1, 1, 2)),
        ((4, 0, 1, 200, 2, 1, 0), (6, 1, 3, 220, 2, 1, 2)),
        ((0, 2, 1, 200, 1, 0, 0), (2, 0, 1, 200, 5, 1, 0), (4, 0, 6, 5, 5, 1, 2)),
    )
)


def compiler(folder: Path) -> str | None:
    """A clang that can build fuzzers, tried on an empty one in `folder`, or None."""
    probe = folder / "probe.c"
    probe.write_text(EMPTY)
    for name in COMPILERS:
        if shutil.which(name) is None:
            continue
        command = [name, *OPTIONS, str(probe), "-o", str(folder / "probe")]
        if subprocess.run(command, capture_output=True, check=False).returncode == 0:
            return name
    return None


def compile_unit(name: str, folder: Path) -> None:
    """The unit's sources as objects in `folder`: what every target is linked with."""
    sources = [path for part in SOURCE_FOLDERS for path in sorted((ROOT / part).rglob("*.c"))]
    sources += [ROOT / "sim_device/firmware/boards/host" / file for file in BOARD]
    includes = [f"-I{ROOT / part}" for part in INCLUDES]
    _run([name, *OPTIONS, *includes, "-c", *map(str, sources)], folder)


def build(name: str, target: str, objects: Path, folder: Path) -> Path:
    """The program of a target, linked with what `compile_unit` made."""
    program = folder / f"fuzz_{target}"
    includes = [f"-I{ROOT / part}" for part in INCLUDES]
    unit = map(str, sorted(objects.glob("*.o")))
    _run([name, *OPTIONS, *includes, str(HERE / f"fuzz_{target}.c"), *unit, "-o", str(program)])
    return program


def _run(command: list[str], folder: Path | None = None) -> None:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr)


def write_corpus(target: str, folder: Path) -> Path:
    """The golden vectors as first inputs, in the form the target takes."""
    corpus = folder / f"corpus_{target}"
    corpus.mkdir(exist_ok=True)
    cases = json.loads((ROOT / "firmware_protocol/vectors/messages.json").read_text())["cases"]
    for index, case in enumerate(cases):
        frame = bytes.fromhex(case["frame"])
        wire = encode_frame(frame)
        if target == "unit" and len(frame) < 256:
            (corpus / f"{index:03}").write_bytes(
                b"\x00" + bytes([len(frame)]) + frame + b"\x02\x08"
            )
        elif target == "receive":
            (corpus / f"{index:03}").write_bytes(b"\x00" + wire)
    if target == "ride_log":
        for number, page in enumerate(RIDE_LOG_PAGES):
            (corpus / f"{number}").write_bytes(page)
    if target == "flash":
        (corpus / "blank").write_bytes(b"\xff" * 512)
        (corpus / "forged").write_bytes(bytes(range(1, 65)))
    return corpus


def run(
    program: Path, corpus: Path, seconds: int, folder: Path
) -> subprocess.CompletedProcess[str]:
    """Fuzz for so long; return code 0 means that nothing was found."""
    return subprocess.run(
        [
            str(program),
            f"-max_total_time={seconds}",
            f"-max_len={LENGTH_MAX}",
            "-seed=1",
            "-print_final_stats=1",
            f"-artifact_prefix={folder}/",
            str(corpus),
        ],
        capture_output=True,
        text=True,
        check=False,
        timeout=seconds + 120,
    )


def executions(output: str) -> int:
    """How many inputs a run has tried."""
    for line in output.splitlines():
        if line.startswith("stat::number_of_executed_units:"):
            return int(line.split(":")[-1])
    return 0
