"""The firmware on the Cortex-M4F: flash, RAM, stack, and instructions, which QEMU counts.

Instructions under `-icount` of a stand-alone image (boards/mps2_an386/main_count.c): the same in
every run. They are not cycles; shares of a loop assume one instruction a cycle at 100 MHz, and say
so.
"""

import re
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path

from firmware_protocol._generated import MTU, MTU_BEFORE_HELLO
from sim_device import emulator
from tools.bench.figures import Figure
from tools.bench.stack import stack_bound

# QEMU: shift=6 is 64 ns an instruction, and SysTick counts at 25 MHz.
TICKS_AN_INSTRUCTION = 64e-9 * 25e6
CLOCK_HZ = 100e6

ROOT = Path(__file__).resolve().parents[2]
ROOMS = (
    "firmware_protocol/c",
    "sim_device/firmware/control",
    "sim_device/firmware/app",
    "sim_device/firmware/hal",
    "third_party/monocypher",
)

# Files of app/ by what they are for; the others are configuration and product.
LINK = ("link", "baud_rate", "dispatch", "telemetry", "stream_budget", "events", "system_service",
        "line_service", "stream_service", "time_service", "board_service", "reply")  # fmt: skip
UNLOCKING = ("sha512", "signature", "unlock", "unlock_store", "unlock_service", "permission")

# Files of the codec that hold the parameters.
PARAMETERS = ("ebl_config", "ebl_registry", "ebl_values")

# Members of `app` by what they are for.
PARTS = {
    "link (decoder, three queues, frame in and out)": ("link",),
    "four answers kept for repeats": ("answered",),
    "four streams": ("telemetry",),
    "four images of the configuration": (
        "config.store",
        "config.transaction",
        "config.live",
        "config.in_force",
    ),
    "ride logs": ("ride_log", "bulk", "log_check"),
    "law": ("config.law", "assist_state", "output"),
    "faults with freeze frames": ("faults",),
}


def run() -> list[Figure]:
    reason = emulator.missing()
    if reason is not None:
        return [Figure("the firmware on a Cortex-M4F", "not measured", "", None, reason)]
    image = emulator.build("unit")
    return [*memory(image), *counts(emulator.build("count")), deepest_possible(image)]


def memory(image: Path) -> list[Figure]:
    rooms = dict.fromkeys(
        ("law", "codec", "description of itself", "link and requests", "configuration and product",
         "unlocking", "ride logs", "board", "compiler's own"), 0
    )  # fmt: skip
    parameters = 0
    for name, size in linked(image.with_suffix(".map").read_text()):
        rooms[room_of(name)] += size
        parameters += size if name in PARAMETERS else 0
    ram = {row[3]: int(row[1], 16) for row in symbols(image)}
    parts = "; ".join(f"{room} {size:,}" for room, size in rooms.items())
    codec = rooms["codec"] + rooms["link and requests"]
    state = app_parts(MTU)
    least = sum(list(app_parts(MTU_BEFORE_HELLO).values())[:3])
    protocol = sum(list(state.values())[:3])
    return [
        Figure("flash, all of it", f"{sum(rooms.values()):,} B", "", None, parts),
        Figure("flash of the protocol: codec, link and requests", f"{codec:,} B", "<= 12,288 B",
               codec <= 12_288,
               f"of it {parameters:,} are the tables of parameters and channels with their checks. "
               "The budget's list also names transactions, slots and the logs' window, counted in "
               "other rooms above. Its description, which the host could bring along, is not "
               "counted"),
        Figure(f"RAM of the protocol, frames of {MTU} bytes", f"{protocol:,} B", "", None,
               "four answers kept and four queued, four streams and four of their frames queued: "
               "4,096 B would hold seven such frames, so the budget is for short ones"),
        Figure(f"RAM of the protocol, frames of {MTU_BEFORE_HELLO} bytes", f"{least:,} B",
               "<= 4,096 B", least <= 4096, "built with MTU=128"),
        Figure("RAM of the whole product", f"{ram['unit']:,} B", "", None,
               "; ".join(f"{part} {size:,}" for part, size in state.items())),
    ]  # fmt: skip


def measured(image: Path) -> dict[str, int]:
    """What boards/mps2_an386/main_count.c says of one run, by name."""
    words = [
        *("qemu-system-arm", "-M", "mps2-an386", "-display", "none", "-monitor", "none"),
        *("-serial", "none", "-semihosting-config", "enable=on,target=native"),
        *("-icount", "shift=6,sleep=off", "-kernel", str(image)),
    ]
    # QEMU tells what an image says through semihosting on its standard error.
    said = subprocess.run(words, capture_output=True, text=True, check=True, timeout=60).stderr
    return {name: int(number) for name, number in re.findall(r"(\w+) (\d+)", said)}


def counts(image: Path) -> list[Figure]:
    runs = [measured(image) for _ in range(3)]
    said = runs[0]
    same = "the same in 3 of 3 runs" if runs == [said] * 3 else "NOT the same in 3 runs"
    step = said["streaming_step_ticks10"] / 10 / TICKS_AN_INSTRUCTION
    worst = said["streaming_step_worst_ticks"] / TICKS_AN_INSTRUCTION
    poll = said["idle_poll_ticks10"] / 10 / TICKS_AN_INSTRUCTION
    byte = said["byte_ticks10"] / 10 / TICKS_AN_INSTRUCTION
    signature = said["signature_ticks"] / TICKS_AN_INSTRUCTION
    law = said["step_ticks10"] / 10 / TICKS_AN_INSTRUCTION
    return [
        Figure("instructions of a control step, fuzzy law", f"{law:,.0f}", "", None, same),
        Figure("the same with 12 channels streamed at 100 Hz", f"{step:,.0f} (worst {worst:,.0f})",
               "", None, "the worst closes a frame of ten rows"),
        Figure("instructions of a poll with nothing to do", f"{poll:,.0f}", "", None),
        Figure("instructions of a received byte", f"{byte:.0f}", "<= 40", byte <= 40,
               "framing, CRC-32 and queue"),
        Figure("share of a 100 Hz loop at 100 MHz", f"{share(step, 100):.2f} %", "", None,
               "one control step; one instruction a cycle assumed"),
        Figure("share of a 1 kHz loop at 100 MHz", f"{share(step, 1000):.2f} %", "", None,
               "the same, were it called so often"),
        Figure("instructions to check a signature (Ed25519)", f"{signature / 1e6:.2f} M", "", None,
               f"{1e3 * signature / CLOCK_HZ:.0f} ms at 100 MHz and an instruction a cycle; the "
               "control step waits"),
        Figure("deepest stack seen", f"{said['stack_bytes']:,} B", "", None,
               "painted stack: first boot, HELLO, stream, control steps; with a signature checked "
               f"{said['signature_stack_bytes']:,} B"),
    ]  # fmt: skip


def deepest_possible(image: Path) -> Figure:
    bound = stack_bound(image)
    return Figure("deepest stack possible", f"{bound.bytes_max:,} B", "", None,
                  "call graph of the unit's image; of it an interrupt and a fault, with the "
                  f"floating-point registers, {bound.interrupts_bytes} B; "
                  f"{', '.join(bound.path)}")  # fmt: skip


def app_parts(frame_bytes: int) -> dict[str, int]:
    """Bytes of the product's state by what it is for, with frames of at most this size."""
    names = {name for members in PARTS.values() for name in members} | {"whole"}
    source = '#include "app.h"\n' + "".join(
        f"char size_{name.replace('.', '_')}"
        f"[sizeof({'app' if name == 'whole' else f'((app *)0)->{name}'})];\n"
        for name in sorted(names)
    )
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "sizes.o"
        folders = [word for room in ROOMS for word in ("-I", str(ROOT / room))]
        subprocess.run(
            ["arm-none-eabi-gcc", "-mcpu=cortex-m4", "-mthumb", "-std=c99",
             f"-DLINK_MTU={frame_bytes}u", *folders, "-xc", "-", "-c", "-o", str(made)],
            input=source, text=True, check=True, capture_output=True,
        )  # fmt: skip
        sizes = {row[3].removeprefix("size_"): int(row[1], 16) for row in symbols(made)}
    parts = {
        title: sum(sizes[name.replace(".", "_")] for name in members)
        for title, members in PARTS.items()
    }
    return parts | {"rest": sizes["whole"] - sum(parts.values())}


def share(instructions: float, loop_hz: float) -> float:
    return 100 * instructions * loop_hz / CLOCK_HZ


def linked(text: str) -> Iterable[tuple[str, int]]:
    """Object file and size of everything a link map puts into flash."""
    body = text[text.index("Linker script and memory map") :]
    body = body[: body.index("\n.bss")]
    for size, path in re.findall(r"^ \.?\S*\s+0x[0-9a-f]+\s+0x([0-9a-f]+) (\S+)$", body, re.M):
        yield Path(path).stem if "(" not in path else "libgcc", int(size, 16)


def room_of(name: str) -> str:
    def holds(folder: str) -> bool:
        return any((ROOT / folder).rglob(f"{name}.c"))

    if name == "ebl_schema":
        return "description of itself"
    if holds("firmware_protocol/c"):
        return "codec"
    if holds("sim_device/firmware/control"):
        return "law"
    if holds("third_party/monocypher") or name in UNLOCKING:
        return "unlocking"
    if not holds("sim_device/firmware/app"):
        return "board" if (emulator.BOARD_FOLDER / f"{name}.c").exists() else "compiler's own"
    if holds("sim_device/firmware/app/ride_log") or name == "log_service":
        return "ride logs"
    return "link and requests" if name in LINK else "configuration and product"


def symbols(image: Path) -> list[list[str]]:
    listed = subprocess.run(
        ["arm-none-eabi-nm", "-S", str(image)], capture_output=True, text=True, check=True
    ).stdout
    return [row for row in map(str.split, listed.splitlines()) if len(row) == 4]
