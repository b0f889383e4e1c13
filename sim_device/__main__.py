"""`python -m sim_device`: a simulated drive unit on a serial line, or a scenario in virtual time.

`unit` serves until it is told to stop. `scenario list` and `scenario run` print and end: 0 done,
1 refused with the reason, 2 wrong usage.
"""

import argparse
import contextlib
import json
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from firmware_protocol._generated import Market
from firmware_protocol.spelling import words_of
from sim_device import sensor_state
from sim_device.controls import SPEED_FACTOR_MAX, SPEED_FACTOR_MIN
from sim_device.emulated import EmulatedSetup
from sim_device.emulator import BOARD, BOARD_VARIABLE, EmulatorError
from sim_device.flash_file import FlashFile, LogFile
from sim_device.lockstep import NO_MARKET, LockstepUnit, market_named, uid_of
from sim_device.scenario import list_scenarios, run
from sim_device.scenario_file import ScenarioError, ScenarioFile, load, load_live, names
from sim_device.serial_line import PtyLine, SerialLine, TcpLine
from sim_device.simulator import ServedUnit, Stop, new_boot_id, save, serve

PROGRAM = "sim_device"
DEFAULT_SCENARIO = "commute"
NO_SCENARIO = "none"
LOOPBACK = "127.0.0.1"
# Where every unit starts.
SERIAL_RATE = 115200
HOST_BOARD = "host"
# In one process; a core serves some hundred.
UNITS_MAX = 256


def command_line(program: str = PROGRAM) -> argparse.ArgumentParser:
    """What `unit` and `scenario` take, under the name that people typed."""
    parser = argparse.ArgumentParser(
        prog=program, description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    commands = parser.add_subparsers(dest="command", required=True)
    unit = "unit" if program == PROGRAM else "sim"
    _add_unit(commands.add_parser(unit, help="a simulated drive unit on a serial line"))
    scenario = commands.add_parser("scenario", help="list or run scenarios in virtual time")
    verbs = scenario.add_subparsers(dest="verb", required=True)
    listing = verbs.add_parser("list", help="what there is, with its settings")
    running = verbs.add_parser("run", help="run one and print its figures")
    running.add_argument("name")
    running.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    for verb in (listing, running):
        verb.add_argument("--json", action="store_true", help="one JSON object on standard output")
    return parser


def _add_unit(unit: argparse.ArgumentParser) -> None:
    line = unit.add_mutually_exclusive_group(required=True)
    line.add_argument("--pty", type=Path, metavar="LINK", help="symbolic link to make")
    line.add_argument("--tcp", type=_port, metavar="[HOST:]PORT", help="to listen on; 0: any free")
    unit.add_argument(
        "--scenario",
        type=_live_scenario,
        default=DEFAULT_SCENARIO,
        metavar="NAME|FILE.toml|none",
        help=f"what the rider does (default %(default)s): {', '.join(_live_names())}, "
        "or a file of your own (docs/scenarios.md)",
    )
    unit.add_argument("--speed", type=_speed, default=1.0, metavar="X", help="times real time")
    unit.add_argument(
        "--virtual", action="store_true", help="time passes only when the host says so"
    )
    unit.add_argument(
        "--serial-rate",
        type=int,
        default=0,
        choices=[0, SERIAL_RATE],
        help="the line has a rate and begins with this one; 0: bytes take no time (default)",
    )
    unit.add_argument(
        "--board",
        default=os.environ.get(BOARD_VARIABLE, HOST_BOARD),
        choices=(HOST_BOARD, BOARD),
        help="where the firmware runs: here, or on a microcontroller in QEMU (default %(default)s)",
    )
    unit.add_argument(
        "--sensor",
        choices=sensor_state.names(),
        help="the state of its torque sensor: sound as the thesis' two, worn or broken",
    )
    unit.add_argument(
        "--count",
        type=_count,
        default=1,
        metavar="N",
        help="units in this process, with the next seeds, on the next ports, LINK-2, FILE-2 ...",
    )
    unit.add_argument("--seed", type=int, default=0, help="makes noise and serial number")
    unit.add_argument(
        "--flash",
        type=Path,
        metavar="FILE",
        help="keeps its configuration, FILE.log its ride logs; of another board, FILE.log all",
    )
    unit.add_argument(
        "--market",
        default="eu_epac",
        type=str.lower,
        choices=[*words_of(Market), NO_MARKET],
        help="whose law a new unit is made for; a --flash that is there keeps its own; none: no "
        "factory was there, and the unit gives no assist",
    )
    unit.add_argument(
        "--unlock-key", type=_unlock_key, metavar="FILE", help="the maker's public key (*.pub)"
    )


def _port(text: str) -> tuple[str, int]:
    host, _, port = text.rpartition(":")
    if not port.isdecimal() or not int(port) <= 65535:
        raise argparse.ArgumentTypeError(f"{text} is not [HOST:]PORT")
    return host or LOOPBACK, int(port)


def _count(text: str) -> int:
    if not text.isdecimal() or not 1 <= int(text) <= UNITS_MAX:
        raise argparse.ArgumentTypeError(f"{text} is not a number from 1 to {UNITS_MAX}")
    return int(text)


def _speed(text: str) -> float:
    try:
        speed = float(text)
    except ValueError:
        speed = float("nan")
    if not SPEED_FACTOR_MIN <= speed <= SPEED_FACTOR_MAX:
        raise argparse.ArgumentTypeError(
            f"{text} is not a number from {SPEED_FACTOR_MIN:g} to {SPEED_FACTOR_MAX:g}"
        )
    return speed


def _unlock_key(name: str) -> bytes:
    try:
        return bytes.fromhex(Path(name).read_text(encoding="ascii"))
    except (OSError, ValueError) as error:
        raise argparse.ArgumentTypeError(f"{name} is no public key in hex: {error}") from None


def _live_scenario(name: str) -> ScenarioFile | None:
    try:
        return None if name == NO_SCENARIO else load_live(name)
    except ScenarioError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _live_names() -> list[str]:
    return [name for name in names() if load(name).live]


def host_unit(
    arguments: argparse.Namespace,
) -> tuple[LockstepUnit, FlashFile | None, LogFile | None]:
    """The unit of a command line with the firmware's host build, and its memories on disk.

    Raises ValueError for a memory that is none, OSError for one that cannot be read.
    """
    flash = FlashFile(arguments.flash) if arguments.flash is not None else None
    log = LogFile(Path(f"{arguments.flash}.log")) if arguments.flash is not None else None
    unit = _bike(
        arguments,
        flash=flash.load() if flash is not None else None,
        log=log.load() if log is not None else None,
        market=arguments.market,
        unlock_key=arguments.unlock_key,
        boot_id=new_boot_id(),
        line_baud=arguments.serial_rate,
    )
    return unit, flash, log


def _serve(arguments: argparse.Namespace) -> None:
    stop = Stop()
    if arguments.board != HOST_BOARD:
        if arguments.count > 1:
            raise ValueError(f"--count is for units of --board {HOST_BOARD}")
        _serve_board(arguments, stop)
        return
    with contextlib.ExitStack() as closing:
        served = []
        for number in range(arguments.count):
            unit, flash, log = host_unit(_of_one(arguments, number))
            line = closing.enter_context(contextlib.closing(_line(arguments, number)))
            save(unit, flash, log)
            served.append(ServedUnit(unit, line, flash, log))
        for one in served:
            _ready(one.line.address)
        serve(served, stop)


def _of_one(arguments: argparse.Namespace, number: int) -> argparse.Namespace:
    """The words of one unit of several: a seed and a memory of its own."""
    flash = arguments.flash and _numbered(arguments.flash, number)
    own = {"seed": arguments.seed + number, "flash": flash}
    return argparse.Namespace(**vars(arguments) | own)


def _line(arguments: argparse.Namespace, number: int) -> SerialLine:
    if arguments.pty is not None:
        return PtyLine(_numbered(arguments.pty, number))
    host, port = arguments.tcp
    return TcpLine(host, port + number if port else 0)


def _numbered(path: Path, number: int) -> Path:
    """The path of the first unit as it was given, then path-2, path-3 ..."""
    return path.with_name(f"{path.name}-{number + 1}") if number else path


def _serve_board(arguments: argparse.Namespace, stop: Stop) -> None:
    flash: Path | None = arguments.flash
    EmulatedSetup(
        bike=_bike(arguments, bike_alone=True),
        uid=uid_of("process", arguments.seed),
        unlock_key=arguments.unlock_key,
        memory_file=flash.with_name(f"{flash.name}.log") if flash is not None else None,
        pty=arguments.pty,
        tcp=arguments.tcp,
        serial_rate=arguments.serial_rate,
        market=market_named(arguments.market),
    ).run(_ready, stop)


def _bike(arguments: argparse.Namespace, **firmware: Any) -> LockstepUnit:
    return LockstepUnit(
        arguments.seed,
        name="process",
        scenario=arguments.scenario,
        sensor=arguments.sensor,
        speed_factor=arguments.speed,
        clock="virtual" if arguments.virtual else "real",
        **firmware,
    )


def _ready(address: str) -> None:
    print(f"ready {address}", flush=True)


def _scenario(arguments: argparse.Namespace) -> None:
    if arguments.verb == "list":
        found = list_scenarios()
        by_name = {row["name"]: row["doc"] for row in found}
        _print({"items": found} if arguments.json else by_name, arguments.json)
        return
    settings: dict[str, object] = {}
    for pair in arguments.set:
        key, equals, value = pair.partition("=")
        if not equals:
            raise ScenarioError(f"--set {pair}: write it as key=value")
        settings[key] = value
    _print(run(arguments.name, settings), arguments.json)


def _print(result: dict[str, Any], as_json: bool) -> None:
    if as_json:
        print(json.dumps(result))
        return
    for name, value in result.items():
        print(f"{name:28} {value}")


def main(words: Sequence[str] | None = None) -> int:
    """Does what the words ask for; what it returns is the process's exit code.

    `--as NAME` in front: the command people typed, for messages and usage. A reader that has enough
    (`spindle scenario list | head`) ends it quietly.
    """
    try:
        try:
            return _run(words)
        finally:
            sys.stdout.flush()
    except BrokenPipeError:
        # At exit Python flushes once more, with a trace where there is nobody.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def _run(words: Sequence[str] | None) -> int:
    given = list(sys.argv[1:] if words is None else words)
    program = PROGRAM
    if given[:1] == ["--as"] and len(given) > 1:
        program, given = given[1], given[2:]
    arguments = command_line(program).parse_args(given)
    try:
        if arguments.command == "scenario":
            _scenario(arguments)
        else:
            _serve(arguments)
    except ScenarioError as error:
        print(f"{program}: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        raise
    except (OSError, ValueError, MemoryError, EmulatorError) as error:
        print(f"{program}: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
