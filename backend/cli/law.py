"""`spindle surface`, `spindle lint` and `spindle certificate`."""

from __future__ import annotations

from argparse import Namespace
from typing import Any

from backend.cli.client import Server, print_json, print_table, text_of
from backend.cli.device import read_json, server_of
from backend.core.quantities import plain
from backend.errors import InvalidRequest

POINTS_MAX = 512


def surface(options: Namespace) -> int:
    """The gain over a grid, by the unit's own law."""
    server = server_of(options)
    speeds_kmh, torque_rates = axis(options.speeds, "--speeds"), axis(options.rates, "--rates")
    question = {
        "fuzzy_table": table_of(server, options),
        "speeds_kmh": speeds_kmh,
        "torque_rates": torque_rates,
    }
    answer = server.ask("POST", "/surface", json=question)
    if options.json:
        print_json({**question, **answer})
        return 0
    rows = [
        [f"{speed:.1f}", *(f"{gain:.4f}" for gain in row)]
        for speed, row in zip(speeds_kmh, answer["gain"], strict=True)
    ]
    print_table(rows, ["km/h", *(f"{rate:.3f}" for rate in torque_rates)])
    return 0


def lint(options: Namespace) -> int:
    """Findings about a table; 1 if one of them forbids writing it."""
    server = server_of(options)
    answer = server.ask("POST", "/lint", json=lint_question(server, options))
    if options.json:
        print_json(answer)
    else:
        for level in ("errors", "warnings", "notes"):
            for finding in answer[level]:
                print(f"{level[:-1]} {finding['code']} {text_of(finding['where'])}")
                print(f"  {finding['message']}")
    return 1 if answer["errors"] else 0


def certificate(options: Namespace) -> int:
    """What is proven of a configuration; 1 unless all of it keeps the market's law."""
    server = server_of(options)
    question: dict[str, Any] = {}
    if options.table is not None:
        question["fuzzy_table"] = table_of(server, options)
    if options.library is not None:
        question["library"] = options.library
    elif options.table is None or options.unit is not None:
        question |= {"device_id": server.device_id(options.unit), "revision": options.revision}
    answer = server.ask("POST", "/certificates", json=question)
    print_json(answer) if options.json else print_certificate(answer)
    return 0 if answer["holds"] else 1


def print_certificate(answer: dict[str, Any]) -> None:
    """As a sheet of paper would have it."""
    state = "holds" if answer["holds"] else f"NOT PROVEN ({answer['unproven'] or 'see below'})"
    print(f"Certificate {answer['sha256']}: {state}")
    for name in ("config_sha256", "table_sha256", "market", "market_sha256", "firmware_version"):
        print(f"  {name:17} {answer[name]}")
    print(f"  {'method':17} {answer['method']}, {text_of(answer['created_at'])}")
    for claim in answer["claims"]:
        margin = "" if claim["margin"] is None else f", margin {plain(claim['margin'], 4)}"
        mark = "" if claim["holds"] else "NOT KEPT: "
        print(f"{mark}{claim['message']}")
        print(f"  by {claim['how']}{margin} {claim['unit'] if margin else ''}".rstrip())
    print(f"Not covered: {', '.join(answer['not_covered'])}")


def table_of(server: Server, options: Namespace) -> Any:
    """The table of the file named, or the unit's own: its first, or its second if asked for."""
    if options.table is not None:
        table = read_json(options.table)
        return table.get("fuzzy_table", table) if isinstance(table, dict) else table
    path = f"/devices/{server.device_id(options.unit)}/fuzzy-table"
    return server.ask("GET", path, params={"table": which_of(options)})


def which_of(options: Namespace) -> str:
    """The word for the unit's table that is meant."""
    return "second" if options.second else "first"


def lint_question(server: Server, options: Namespace) -> dict[str, Any]:
    """A table to be judged; with the modes and limits of its unit where one is meant."""
    table = {"fuzzy_table": table_of(server, options), "table": which_of(options)}
    if options.table is not None and options.unit is None:
        return table
    path = f"/devices/{server.device_id(options.unit)}"
    parameters = server.ask("GET", f"{path}/config")["parameters"]
    return {
        **table,
        "assist_modes": server.ask("GET", f"{path}/assist-modes"),
        "limits": server.ask("GET", f"{path}/limits"),
        "taper_speeds_kmh": [parameters[f"fixed_taper_{end}_kmh"] for end in ("start", "end")],
        "gear_ratio": parameters["gear_ratio"],
    }


def axis(text: str, flag: str) -> list[float]:
    """`from:to:count` as evenly spaced values. Raises InvalidRequest if it is not that."""
    try:
        low, high, count = text.split(":")
        number = int(count)
        first, last = float(low), float(high)
    except ValueError:
        raise InvalidRequest(f"{flag} {text}: write from:to:count, such as 0:25:11.") from None
    if not 2 <= number <= POINTS_MAX:
        raise InvalidRequest(f"{flag} {text}: the count must be from 2 to {POINTS_MAX}.")
    return [first + (last - first) * i / (number - 1) for i in range(number)]
