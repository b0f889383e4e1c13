"""The command line: every verb, its arguments, and the function that runs it."""

from __future__ import annotations

import argparse
from argparse import Namespace
from pathlib import Path
from typing import Any

from backend import __version__
from backend.cli import (
    bike_numbers,
    calibration_job,
    device,
    device_live,
    device_log,
    drift,
    law,
    library,
    people,
    propose,
    ride,
    ride_compare,
    ride_upload,
    serve,
    store,
)

KEY = "for a server that asks who this is; default: SPINDLE_KEY"
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
    verbs = parser.add_subparsers(metavar="COMMAND", required=True)
    _add_serve(verbs)
    # These two go to the simulator before this parser sees them; they are here to be listed.
    verbs.add_parser("sim", help="a simulated unit on its own", add_help=False)
    verbs.add_parser("scenario", help="list or run scenarios in virtual time", add_help=False)
    _add_device(verbs)
    _add_library(verbs)
    _add_ride(verbs)
    _add_store(verbs)
    people.add_arguments(_group(verbs, "people", people.WORDS))
    _add_law(verbs)
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
    _add_author(command)
    command.set_defaults(run=serve.run_server)


def _asking(verbs: Any, name: str, run: Any, **words: Any) -> argparse.ArgumentParser:
    """A verb that asks a server."""
    command: argparse.ArgumentParser = verbs.add_parser(name, **words)
    command.add_argument("--server", metavar="URL", help="default: this machine's, port 8750")
    command.add_argument("--json", action="store_true", help="the server's answer as it is")
    # After the verb, too; absent it leaves what stands before the verb.
    command.add_argument("--key", metavar="sp_...", default=argparse.SUPPRESS, help=KEY)
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
        "units: list, show, get, set, backup, restore, diff, presets, try, service, logs",
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
    command = _asking(group, "try", device_live.try_values, help="values, until their time is over")
    command.add_argument("words", nargs="*", metavar="[UNIT] NAME=VALUE", help=unit)
    command.add_argument("--seconds", type=int, default=60, help="1 to 255 (60)")
    command.add_argument("--end", action="store_true", help="end what is tried")
    command = _asking(group, "service", device_live.service, help="distance, hours, flash wear")
    command.add_argument("unit", nargs="?", help=unit)
    command = _asking(group, "logs", device_log.list_logs, help="rides in the unit's own flash")
    command.add_argument("unit", nargs="?", help=unit)
    command = _asking(group, "download", device_log.download, help="make a log of the unit a ride")
    command.add_argument("log", type=int, help="its number in `device logs`")
    command.add_argument("unit", nargs="?", help=unit)
    command = _asking(group, "erase", device_log.erase, help="free a fetched log in the unit")
    command.add_argument("log", type=int, help="its number in `device logs`")
    command.add_argument("unit", nargs="?", help=unit)


def _add_library(verbs: Any) -> None:
    words = "tables and configurations: list, show, add, import, remove, export, compare"
    group = _group(verbs, "library", words)
    entry = "id or name; @N for version N"
    command = _asking(group, "list", library.list_entries, help="what there is under a name")
    command.add_argument("--deleted", action="store_true", help="deleted ones, too")
    _asking(group, "show", library.show, help="one of them").add_argument("entry", help=entry)
    command = _asking(group, "add", library.add, help="keep a document, or what a unit has")
    command.add_argument("file", nargs="?", type=Path, help="of `export` or `device backup`")
    command.add_argument("--unit", nargs="?", const="", help="of this unit, or the only one")
    _add_keeping(command)
    command = _asking(group, "import", library.import_fis, help="keep the table of a .fis file")
    command.add_argument("file", type=Path, help="of MATLAB's Fuzzy Logic Toolbox")
    _add_keeping(command)
    command = _asking(group, "remove", library.remove, help="take an own one out")
    command.add_argument("entry", help=entry)
    command = _asking(group, "export", library.export, help="as a file")
    command.add_argument("entry", help=entry)
    command.add_argument("--format", choices=["json", "fis", "csv"], default="json")
    _add_which(command)
    command.add_argument("--output", "-o", type=Path, help="a file; standard output if absent")
    command = _asking(group, "compare", library.compare, help="two side by side")
    for end in ("left", "right"):
        command.add_argument(end, help=f"{entry}; a unit, or `unit`; @N for its revision N")
    _add_which(command)
    command.add_argument("--feel", action="store_true", help="ride both on the simulated bike")


def _add_keeping(command: argparse.ArgumentParser) -> None:
    command.add_argument("--name", help="the document's own if absent")
    command.add_argument("--comment", help="the document's own if absent")
    command.add_argument("--replace", metavar="ENTRY", help="in place of this one, deleted or not")


def _add_which(command: argparse.ArgumentParser) -> None:
    words = "which table of a configuration"
    command.add_argument("--table", choices=["first", "second"], default="first", help=words)


def _add_ride(verbs: Any) -> None:
    group = _group(
        verbs, "ride", "rides: import, upload, list, show, compare, export, report, replay, delete"
    )
    command = _asking(group, "import", ride.import_files, help="FIT files and other logs")
    command.add_argument("files", nargs="+", type=Path)
    command.add_argument("--time-zone", metavar="ZONE", help="of times without one: Europe/Dublin")
    for name in ("speed", "distance", "altitude", "temperature", "torque"):
        command.add_argument(f"--{name}-unit", metavar="UNIT", help=f"of a table's {name}")
    command.add_argument("--rows-per-second", type=float, help="of a log without times")
    command = _asking(group, "upload", ride_upload.upload, help="files and whole folders")
    command.add_argument("paths", nargs="+", type=Path, metavar="PATH")
    command.add_argument("--watch", action="store_true", help="also what appears, until Ctrl-C")
    _asking(group, "sample", ride.sample, help="a simulated ride to look round with")
    command = _asking(group, "list", ride.list_rides, help="newest first")
    command.add_argument("words", nargs="*", help="in name, notes, tags or place")
    command.add_argument("--limit", type=int, default=50)
    command.add_argument("--bike", type=int, help="its number")
    command.add_argument("--since", metavar="DATE", help="begun on or after 2026-05-01")
    command.add_argument("--longer-km", type=float, help="at least so far")
    command.add_argument("--motor", action="store_true", help="with motor data")
    command.add_argument("--events", action="store_true", help="with faults or marks")
    command.add_argument("--tag", help="with this tag")
    command = _asking(group, "tag", ride.tag, help="add tags to rides, or take them away")
    command.add_argument("tags", nargs="+", metavar="TAG")
    command.add_argument("--rides", type=int, nargs="+", required=True, metavar="RIDE")
    command.add_argument("--remove", action="store_true", help="take these away")
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
    command = _asking(group, "replay", ride.replay, help="the ride with another table")
    command.add_argument("ride", type=int)
    command.add_argument("--table", type=Path, help="a fuzzy_table as JSON")
    command.add_argument("--second-table", type=Path, help="the second one")
    command.add_argument("--modes", type=Path, help="assist_modes as JSON")
    command.add_argument("--settings", type=Path, help="a backup, or a preset by its name")
    command.add_argument("--closed-loop", action="store_true", help="as if the bike answered")
    command.add_argument("--mass-kg", type=float, help="rider, bike and load, for the closed loop")
    command.add_argument("--drag-area-m2", type=float, help="0.4 bent low to 0.6 upright")
    words = "two rides, or windows of rides, side by side"
    ride_compare.add_arguments(_asking(group, "compare", ride_compare.compare, help=words))
    command = _asking(group, "since", ride.since, help="the rides since a change, and before it")
    command.add_argument("revision", type=int, nargs="?", help="of the unit; its newest if absent")
    command.add_argument("--unit", help="whose; may be left out when there is only one unit")
    _asking(group, "delete", ride.delete, help="delete a ride").add_argument("ride", type=int)
    command = _asking(group, "files", ride.list_files, help="files that came, and what became")
    command.add_argument("--limit", type=int, default=50)
    command = _asking(group, "remove-file", ride.remove_file, help="one that no ride came from")
    command.add_argument("file", help="its id in `ride files`")


def _add_store(verbs: Any) -> None:
    group = _group(verbs, "store", "what is kept here: check, rebuild (without a server)")
    words = "what is in database and folder; changes nothing"
    for name, run, said in (
        ("check", store.check, words),
        ("rebuild", store.rebuild, "every ride of the folder back into an empty database"),
    ):
        command = group.add_parser(name, help=said)
        command.add_argument("--data", type=Path, help="the folder of `spindle serve --data`")
        command.add_argument("--json", action="store_true", help="one JSON object")
        command.set_defaults(run=run)


def _add_law(verbs: Any) -> None:
    command = _asking(verbs, "surface", law.surface, help="the gain over speed and torque rate")
    command.add_argument("--table", type=Path, help="a fuzzy_table as JSON; the unit's if absent")
    command.add_argument("--unit", help="whose table; may be left out when there is only one unit")
    command.add_argument("--second", action="store_true", help="the second of its two tables")
    command.add_argument("--speeds", default="0:25:11", help="from:to:count in km/h (0:25:11)")
    command.add_argument("--rates", default="0:0.9:10", help="from:to:count (0:0.9:10)")
    command = _asking(verbs, "lint", law.lint, help="what is doubtful about a table")
    command.add_argument("--table", type=Path, help="a fuzzy_table as JSON; the unit's if absent")
    command.add_argument("--unit", help="whose table; may be left out when there is only one unit")
    command.add_argument("--second", action="store_true", help="the second of its two tables")
    command = _asking(verbs, "propose", propose.propose, help="settings for a wish, from rides")
    command.add_argument("rides", type=int, nargs="+", help="1 to 5, by number")
    command.add_argument("--objective", choices=propose.OBJECTIVES, default="more_range")
    command.add_argument("--target-pct", type=float, help="10 for range, else 20")
    command.add_argument("--knobs", help="of ratio,band,filter,torque_rate,cells; all if absent")
    command.add_argument("--mass-kg", type=float, help="rider, bike and load")
    command.add_argument("--save", metavar="NAME", help="keep the recommended one in the library")
    command = _asking(verbs, "certificate", law.certificate, help="what is proven of every ride")
    command.add_argument("--table", type=Path, help="a fuzzy_table as JSON, in the first's place")
    command.add_argument("--unit", help="whose; may be left out when there is only one unit")
    command.add_argument("--revision", type=int, help="of the unit; what it has now if absent")
    command.add_argument("--library", metavar="ID", help="an entry's, instead of a unit's")
    command.set_defaults(second=False)


def _add_calibrate(verbs: Any) -> None:
    words = "the torque sensor: start, setup, capture, drop, fit, write, verify, restore, close ..."
    group = _group(verbs, "calibrate", words)
    command = _asking(group, "start", calibration_job.start, help="open one, or find the open one")
    command.add_argument("unit", nargs="?", help="whose; may be left out when there is only one")
    command = _on_job(group, "setup", calibration_job.setup, "instruments and plan from a file")
    command.add_argument("file", type=Path, help="JSON, as in docs/calibration.md")
    command = _on_job(group, "capture", calibration_job.capture, "take what hangs there once still")
    command.add_argument("--zero", action="store_true", help="nothing hangs there")
    command.add_argument("--kg", type=float, help="what hangs there; the next step if absent")
    _add_place(command)
    command.add_argument("--stroke", type=int, default=1, help="1, 2 ... (1)")
    command.add_argument("--direction", choices=["loading", "unloading"], default="loading")
    words = "you looked: nothing is on the pedals, although the unit tells of a foot"
    command.add_argument("--pedals-free", action="store_true", help=words)
    command = _on_job(group, "drop", calibration_job.drop, "strike a capture out")
    command.add_argument("number", type=int, help="its number in `show`")
    command.add_argument("--reason", default="", help="why; kept with it")
    _on_job(group, "fit", calibration_job.fit, "what follows from the captures, and the judgement")
    for verb, words in (
        ("write", "what was fitted into the unit"),
        ("restore", "the old one"),
    ):
        command = _on_job(group, verb, calibration_job.change, words)
        command.add_argument("--reason", default="", help="why; kept with the revision")
        command.add_argument("--token", metavar="HEX", help="of `spindle unlock sign`")
        command.set_defaults(verb=verb)
    command = _on_job(group, "verify", calibration_job.verify, "compare a mass that was not fitted")
    command.add_argument("--kg", type=float, required=True, help="what hangs there")
    _add_place(command)
    _on_job(group, "close", calibration_job.close, "nothing of it changes any more")
    _on_job(group, "show", calibration_job.show, "all of one")
    command = _asking(group, "list", calibration_job.list_jobs, help="newest first")
    command.add_argument("--unit", help="of this one")
    words = "the file for `evaluate`, or a PDF to be signed"
    command = _on_job(group, "certificate", calibration_job.certificate, words)
    words = "number of the calibration, or a certificate's file, which needs no server"
    command.add_argument("which", nargs="?", metavar="JOB|FILE", help=words)
    command.add_argument("--output", "-o", type=Path, help="a file; standard output if absent")
    command.add_argument("--pdf", type=Path, metavar="OUT", help="on paper, into this file")
    command.add_argument("--language", choices=["en", "zh"], default="en", help="of the PDF (en)")
    command.add_argument("--zone", default="UTC", help="of its moments, like Europe/Zurich (UTC)")
    command.add_argument("--paper", choices=["a4", "letter"], default="a4", help="(a4)")
    words = "linearity, hysteresis, or a certificate again"
    command = _asking(group, "evaluate", _evaluate, help=words)
    words = "JSON: full_scale_nm, load_nm, forward, reverse; or a certificate, without a server"
    command.add_argument("file", type=Path, help=words)
    words = "the wheel's circumference: rolled out, or by the positions of a ride"
    bike_numbers.add_wheel_arguments(_asking(group, "wheel", bike_numbers.wheel, help=words))
    words = "the speed sensor's pulses in a turn of its wheel, turned by hand"
    bike_numbers.add_pulses_arguments(_asking(group, "pulses", bike_numbers.pulses, help=words))
    words = "the cadence of a ride against the turns of its crank"
    bike_numbers.add_cadence_arguments(_asking(group, "cadence", bike_numbers.cadence, help=words))
    words = "the torque gain by the energy of a climb and coast-downs"
    bike_numbers.add_climb_arguments(_asking(group, "climb", bike_numbers.climb, help=words))
    words = "the sensor's zero over a unit's rides, and when to calibrate it"
    command = _asking(group, "drift", drift.drift, help=words)
    command.add_argument("unit", nargs="?", help="may be left out when there is only one unit")


def _on_job(group: Any, name: str, run: Any, words: str) -> argparse.ArgumentParser:
    """A verb of one calibration."""
    command = _asking(group, name, run, help=words)
    words = "number of the calibration; may be left out when only one is open"
    command.add_argument("--job", type=int, metavar="N", help=words)
    return command


def _add_place(command: argparse.ArgumentParser) -> None:
    command.add_argument("--side", choices=["left", "right"], default="right")
    command.add_argument("--angle", type=float, default=0.0, help="of the crank: 0 level, forward")
    words = "seconds to wait until it is still (60)"
    command.add_argument("--wait", type=float, default=60.0, metavar="S", help=words)


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


def _keygen(options: Namespace) -> int:
    from backend.cli.unlock import keygen

    return keygen(options)


def _sign(options: Namespace) -> int:
    from backend.cli.unlock import sign

    return sign(options)
