"""Compiles the unit's C into one extension module, with the headers as the only declaration.

Every public header is read as it stands: cffi compares it with the compiled code, so a wrong
signature fails the build. Headers listed here therefore keep to plain declarations: integer
``#define``s, enums, structs and prototypes.
"""

import re
from pathlib import Path

from cffi import FFI

ROOT = Path(__file__).resolve().parents[3]

SOURCE_FOLDERS = (
    "firmware_protocol/c",
    "sim_device/firmware/control",
    "sim_device/firmware/app",
    "sim_device/firmware/boards/host",
    "sim_device/physics",
    "sim_device/twin",
    "third_party/monocypher",
)

HAL_FOLDER = "sim_device/firmware/hal"

# In order of dependence. A header that is not here cannot be called from Python.
HEADERS: tuple[str, ...] = (
    "firmware_protocol/c/ebl_result.h",
    "firmware_protocol/c/ebl_registry.h",
    "firmware_protocol/c/ebl_layout.h",
    "firmware_protocol/c/ebl_frame.h",
    "firmware_protocol/c/ebl_values.h",
    "sim_device/firmware/control/fuzzy_table.h",
    "sim_device/firmware/control/assist_types.h",
    "sim_device/firmware/control/assist_trace.h",
    "sim_device/firmware/control/assist.h",
    "sim_device/firmware/control/hold.h",
    "sim_device/twin/twin.h",
    "sim_device/firmware/control/market.h",
    "sim_device/firmware/control/rotor_receiver.h",
    "sim_device/firmware/control/wheel_speed.h",
    "sim_device/firmware/hal/hal.h",
    "sim_device/firmware/app/storage/config_law.h",
    "sim_device/firmware/app/faults/step_watch.h",
    "sim_device/firmware/app/config/sha512.h",
    "sim_device/firmware/app/config/signature.h",
    "sim_device/firmware/boards/host/bench_board.h",
    "sim_device/physics/road.h",
    "sim_device/physics/rider.h",
    "sim_device/physics/ledger.h",
    "sim_device/physics/battery.h",
    "sim_device/physics/motor.h",
    "sim_device/physics/motor_foc.h",
    "sim_device/physics/drivetrain.h",
    "sim_device/physics/gears.h",
    "sim_device/physics/torque_sensor.h",
    "sim_device/physics/rotor_link.h",
    "sim_device/physics/wheel_sensor.h",
    "sim_device/physics/hung_mass.h",
    "sim_device/physics/physics.h",
    "sim_device/firmware/boards/host/unit.h",
)

# What C calls in Python: the answer to a board request (see unit.py).
CALLBACKS = """
extern "Python" int unit_request_python(void *, uint16_t, const uint8_t *, size_t, uint8_t *,
                                        size_t, size_t *);
"""

# Without contraction and fast-math the host and a Cortex-M4F agree to the bit (ADR 1). -O3 lets the
# compiler work on four points of a batch at once: 10 instead of 34 ns per fuzzy evaluation.
COMPILE_ARGUMENTS = ["-std=c99", "-O3", "-ffp-contract=off", "-fno-math-errno"]


def declarations(header: str) -> str:
    """The header's text without what cffi cannot read: comments and preprocessor lines."""
    text = re.sub(r"/\*.*?\*/", " ", (ROOT / header).read_text(encoding="utf-8"), flags=re.S)
    text = re.sub(r"//[^\n]*", "", text)
    kept = []
    for line in text.splitlines():
        if not line.lstrip().startswith("#"):
            kept.append(line)
        elif re.match(r"\s*#define\s+\w+\s+(0x[0-9a-fA-F]+|\d+)u?\s*$", line):
            kept.append(re.sub(r"u\s*$", "", line))
    return "\n".join(kept)


def sources() -> list[str]:
    """Every C file that belongs to the host build, relative to the project's root."""
    return [
        str(path.relative_to(ROOT))
        for folder in SOURCE_FOLDERS
        for path in sorted((ROOT / folder).rglob("*.c"))
        if not path.name.startswith("main_")
    ]


def included() -> list[str]:
    """Every header of those folders: a change in one compiles the sources again."""
    folders = (*SOURCE_FOLDERS, HAL_FOLDER)
    return [
        str(path.relative_to(ROOT)) for folder in folders for path in (ROOT / folder).rglob("*.h")
    ]


def as_included(header: str) -> str:
    """The header's path from the folder that the compiler is told of."""
    folders = (*SOURCE_FOLDERS, HAL_FOLDER)
    return next(header.removeprefix(f"{at}/") for at in folders if header.startswith(f"{at}/"))


ffibuilder = FFI()
ffibuilder.cdef("\n".join(declarations(header) for header in HEADERS))
ffibuilder.cdef(CALLBACKS)
ffibuilder.set_source(
    "sim_device.firmware.python._native",
    "\n".join(f'#include "{as_included(header)}"' for header in HEADERS),
    sources=sources(),
    include_dirs=[*SOURCE_FOLDERS, HAL_FOLDER],
    depends=sorted(included()),
    extra_compile_args=COMPILE_ARGUMENTS,
)
