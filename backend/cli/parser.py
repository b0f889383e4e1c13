"""The command line: every verb, its arguments, and the function that runs it."""

from __future__ import annotations

import argparse
from argparse import Namespace
from pathlib import Path
from typing import Any

from backend import __version__
from backend.cli import api, audit, device, device_log, people, ride, ride_upload, serve, store
from backend.cli.table_answer import QUANTITIES, column_meaning

KEY = "for a server that asks who this is; default: SPINDLE_KEY"
CA = "certificate of an https server that no authority signed; default: SPINDLE_CA"
AUTHOR = "whose changes these are; default: the server's setting, else its system's user"


def build_parser() -> argparse.ArgumentParser:
    """The whole command line of `spindle`."""
    parser = argparse.ArgumentParser(
        prog="spindle",
        description="Configure, calibrate, watch and understand mid-drive e-bikes.",
    )
    parser.add_argument("--version", action="version", version=f"spindle {__version__}")
    parser.add_argument("--author", metavar="NAME", help=AUTHOR)
    parser.add_argument("--key", metavar="sp_...", help=KEY)
    parser.add_argument("--ca", metavar="FILE", help=CA)
    verbs = parser.add_subparsers(metavar="COMMAND", required=True)
    _add_serve(verbs)
    # These two go to the simulator before this parser sees them; they are here to be listed.
    verbs.add_parser("sim", help="a simulated unit on its own", add_help=False)
    verbs.add_parser("scenario", help="list or run scenarios in virtual time", add_help=False)
    _add_device(verbs)
    _add_ride(verbs)
    _add_store(verbs)
    people.add_arguments(_group(verbs, "people", people.WORDS))
    audit.add_arguments(_group(verbs, "audit", audit.WORDS))
    _add_api(verbs)
    _add_calibrate(verbs)
    _add_unlock(verbs)
    return parser


def _add_serve(verbs: Any) -> None:
    command = verbs.add_parser("serve", help="the server; prints its address when it is ready")
    command.add_argument("--host", help="address to listen on (127.0.0.1)")
    command.add_argument("--port", help="port to listen on (8750); 0 takes a free one")
    command.add_argument("--data", type=Path, help="folder for everything that is kept")
    command.add_argument(
        "--device",
        action="append",
        metavar="URL",
        help="sim, /dev/ttyUSB0, COM3 or socket://host:port; repeat for several, `none` for none",
    )
    words = "own: with a certificate that it makes itself; files: see docs/on-a-phone.md (off)"
    command.add_argument("--tls", choices=["off", "own", "files"], help=words)
    _add_author(command)
    command.set_defaults(run=serve.run_server)


def _asking(verbs: Any, name: str, run: Any, **words: Any) -> argparse.ArgumentParser:
    """A verb that asks a server."""
    command: argparse.ArgumentParser = verbs.add_parser(name, **words)
    command.add_argument("--server", metavar="URL", help="default: this machine's, port 8750")
    command.add_argument("--json", action="store_true", help="the server's answer as it is")
    # After the verb, too; absent it leaves what stands before the verb.
    command.add_argument("--key", metavar="sp_...", default=argparse.SUPPRESS, help=KEY)
    command.add_argument("--ca", metavar="FILE", default=argparse.SUPPRESS, help=CA)
    _add_author(command)
    command.set_defaults(run=run)
    return command


def _add_author(command: argparse.ArgumentParser) -> None:
    """After the verb, too; absent it leaves what stands before the verb."""
    command.add_argument("--author", metavar="NAME", default=argparse.SUPPRESS, help=AUTHOR)


def _group(verbs: Any, name: str, words: str) -> Any:
    return verbs.add_parser(name, help=words).add_subparsers(metavar="VERB", required=True)


def _add_bank(command: argparse.ArgumentParser) -> None:
    words = "which of the unit's: in force (active), before (previous), as made (default)"
    command.add_argument(
        "--bank", choices=["active", "previous", "default"], default="active", help=words
    )


def _add_device(verbs: Any) -> None:
    group = _group(
        verbs,
        "device",
        "units: list, add, remove, show, get, set, backup, restore, diff, presets, download",
    )
    unit = "id, url, unit key or serial number; may be left out when there is only one unit"
    _asking(group, "list", device.list_devices, help="every unit and its state")
    command = _asking(group, "add", device.add, help="open a unit")
    command.add_argument("url")
    command.add_argument("--name", help="what you call it; one without a serial number needs it")
    _asking(group, "remove", device.remove, help="let a unit go").add_argument("unit", help=unit)
    command = _asking(group, "show", device.show, help="identity, link and newest values")
    command.add_argument("unit", nargs="?", help=unit)
    command = _asking(group, "get", device.get, help="parameters, all or the named ones")
    command.add_argument("words", nargs="*", metavar="[UNIT] NAME", help=unit)
    _add_bank(command)
    command = _asking(group, "set", device.set_parameters, help="change parameters, all or none")
    command.add_argument("words", nargs="+", metavar="[UNIT] NAME=VALUE", help=unit)
    command.add_argument("--reason", default="", help="why; kept with the revision")
    command.add_argument("--token", metavar="HEX", help="of `spindle unlock sign`")
    command = _asking(group, "backup", device.backup, help="the configuration as a JSON file")
    command.add_argument("unit", nargs="?", help=unit)
    command.add_argument("--output", "-o", type=Path, help="a file; standard output if absent")
    _add_bank(command)
    command = _asking(
        group, "restore", device.restore, help="write a backup's values, or a preset's"
    )
    command.add_argument("file", type=Path, help="of `device backup`, or a name of `presets`")
    command.add_argument("unit", nargs="?", help=unit)
    command.add_argument("--reason", default="", help="why; kept with the revision")
    command.add_argument("--token", metavar="HEX", help="of `spindle unlock sign`")
    command = _asking(group, "diff", device.diff, help="a backup against the unit, or another")
    command.add_argument("file", type=Path, help="of `device backup`, or a name of `presets`")
    command.add_argument("other", nargs="?", help="another backup's file, or a unit")
    _asking(group, "presets", device.list_presets, help="what comes with Spindle for `restore`")
    command = _asking(group, "download", device_log.download, help="make a log of the unit a ride")
    command.add_argument("log", type=int, help="its number in `/devices/{unit}/logs`")
    command.add_argument("unit", nargs="?", help=unit)


def _add_ride(verbs: Any) -> None:
    words = "rides: import, upload, list, show, export, archive, report, delete"
    group = _group(verbs, "ride", words)
    command = _asking(group, "import", ride.import_files, help="FIT files and other logs")
    command.add_argument("files", nargs="+", type=Path)
    command.add_argument("--time-zone", metavar="ZONE", help="of times without one: Europe/Dublin")
    for name in QUANTITIES:
        command.add_argument(f"--{name}-unit", metavar="UNIT", help=f"of a table's {name}")
    command.add_argument("--rows-per-second", type=float, help="of a log without times")
    words = "whether 03/04 is 3 April or 4 March"
    command.add_argument("--dates", choices=["day_first", "month_first"], help=words)
    command.add_argument(
        "--column",
        action="append",
        default=[],
        type=column_meaning,
        metavar="NAME=CHANNEL",
        help="what a column of a table is, or `none`; repeat for several",
    )
    command = _asking(group, "upload", ride_upload.upload, help="files and whole folders")
    command.add_argument("paths", nargs="+", type=Path, metavar="PATH")
    command.add_argument("--watch", action="store_true", help="also what appears, until Ctrl-C")
    command = _asking(group, "list", ride.list_rides, help="newest first")
    command.add_argument("words", nargs="*", help="in name, notes, tags or place")
    command.add_argument("--limit", type=int, default=50)
    command.add_argument("--bike", type=int, help="its number")
    command.add_argument("--since", metavar="DATE", help="begun on or after 2026-05-01")
    command.add_argument("--longer-km", type=float, help="at least so far")
    command.add_argument("--motor", action="store_true", help="with motor data")
    command.add_argument("--events", action="store_true", help="with faults or marks")
    command.add_argument("--tag", help="with this tag")
    _asking(group, "show", ride.show, help="one ride's figures").add_argument("ride", type=int)
    command = _asking(group, "export", ride.export, help="a ride as a file")
    command.add_argument("ride", type=int)
    formats = ["csv", "parquet", "fit", "gpx", "original"]
    command.add_argument("--format", choices=formats, default="csv")
    command.add_argument("--output", "-o", type=Path, help="a file; standard output if absent")
    blur = "for strangers: leave out what is so near to start and end (fit, gpx, csv)"
    command.add_argument("--blur", type=float, metavar="METRES", help=blur)
    command = _asking(group, "archive", ride.archive, help="rides as one ZIP with a list of them")
    command.add_argument("rides", type=int, nargs="*", help="all if absent")
    command.add_argument("--formats", default="fit", help="of csv,parquet,fit,gpx,original (fit)")
    command.add_argument("--output", "-o", type=Path, help="a file; standard output if absent")
    command.add_argument("--blur", type=float, metavar="METRES", help=blur)
    command = _asking(
        group, "report", ride.report, help="a ride as one HTML file, to keep or print"
    )
    command.add_argument("ride", type=int)
    command.add_argument("--output", "-o", type=Path, help="a file; standard output if absent")
    command.add_argument("--language", choices=["en", "zh"], default="en")
    command.add_argument("--threshold-power-w", type=float, help="of the rider, for power zones")
    command.add_argument("--heart-rate-bpm-max", type=float, help="of the rider, for its zones")
    _asking(group, "delete", ride.delete, help="delete a ride").add_argument("ride", type=int)


def _add_store(verbs: Any) -> None:
    group = _group(verbs, "store", "what is kept here: check, rebuild (without a server)")
    words = "what is in database and folder; changes nothing"
    for name, run, help_text in (
        ("check", store.check, words),
        ("rebuild", store.rebuild, "every ride of the folder back into an empty database"),
    ):
        command = group.add_parser(name, help=help_text)
        command.add_argument("--data", type=Path, help="the folder of `spindle serve --data`")
        command.add_argument("--json", action="store_true", help="one JSON object")
        command.set_defaults(run=run)


def _add_api(verbs: Any) -> None:
    command = _asking(verbs, "api", api.request, help="any request of the API; see /docs")
    command.add_argument("method", type=str.upper, choices=api.METHODS, metavar="METHOD")
    command.add_argument("path", help="as in the API's description; {unit} is the unit's id")
    words = "key=value of the body, or of the query; key==value of the query; @FILE reads a file"
    command.add_argument("fields", nargs="*", metavar="key=value", help=words)
    command.add_argument("--unit", help="may be left out when there is only one unit")
    words = "of the request, such as 'if-match: \"...\"'; repeat for several"
    command.add_argument("--header", "-H", action="append", default=[], metavar="H", help=words)
    command.add_argument("--input", metavar="FILE", help="the whole body; - is standard input")
    command.add_argument("--type", default="application/json", help="of it (application/json)")
    command.add_argument("--output", "-o", type=Path, help="a file; standard output if absent")


def _add_calibrate(verbs: Any) -> None:
    words = "certificates of calibrations, without a server: evaluate, paper"
    group = _group(verbs, "calibrate", words)
    command = group.add_parser("evaluate", help="works a certificate out again")
    command.add_argument("file", type=Path, help="a certificate's file")
    command.add_argument("--json", action="store_true", help="one JSON object")
    command.set_defaults(run=_evaluate)
    command = group.add_parser("paper", help="a certificate as a PDF to be signed")
    command.add_argument("file", type=Path, help="a certificate's file")
    command.add_argument("output", type=Path, metavar="OUT.pdf")
    command.add_argument("--language", choices=["en", "zh"], default="en", help="(en)")
    command.add_argument("--zone", default="UTC", help="of its moments, like Europe/Zurich (UTC)")
    command.add_argument("--paper", choices=["a4", "letter"], default="a4", help="(a4)")
    command.set_defaults(run=_paper)


def _add_unlock(verbs: Any) -> None:
    group = _group(verbs, "unlock", "the maker's tool: keys, and tokens that raise limits")
    command = group.add_parser("keygen", help="a private key, and FILE.pub for units")
    command.add_argument("file", type=Path)
    command.set_defaults(run=_keygen)
    command = group.add_parser("sign", help="a token for the challenge of a refused change")
    command.add_argument("key", type=Path, help="the private key of keygen")
    command.add_argument("challenge", type=Path, nargs="?", help="JSON; standard input if absent")
    command.set_defaults(run=_sign)


# What these need takes longer to load than the rest of the command does to start.


def _evaluate(options: Namespace) -> int:
    from backend.cli.calibrate import evaluate

    return evaluate(options)


def _paper(options: Namespace) -> int:
    from backend.cli.calibrate import paper

    return paper(options)


def _keygen(options: Namespace) -> int:
    from backend.cli.unlock import keygen

    return keygen(options)


def _sign(options: Namespace) -> int:
    from backend.cli.unlock import sign

    return sign(options)
