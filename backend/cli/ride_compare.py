"""`spindle ride compare A B`"""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from itertools import pairwise
from typing import Any

from backend.cli.client import print_json, print_table, text_of
from backend.cli.device import server_of

ROWS = 24
USUAL = "speed_kmh"
WHY_NOT = {
    "imported": "a file brought the ride",
    "not_told": "its unit told none",
    "not_kept": "nobody kept what its unit told",
}


def add_arguments(command: ArgumentParser) -> None:
    """What the verb takes."""
    command.add_argument("a", type=int)
    command.add_argument("b", type=int)
    for side in "ab":
        words = f"a part of {side.upper()}, seconds since its start"
        command.add_argument(
            f"--{side}-window", type=float, nargs=2, metavar=("FROM", "TO"), help=words
        )
    command.add_argument(
        "--by", choices=["time", "distance", "crank"], help="also both along this, side by side"
    )
    command.add_argument("--channel", default=USUAL, help=f"of --by time and distance ({USUAL})")


def compare(options: Namespace) -> int:
    """Two rides or windows side by side: figures, ways, settings; with --by also along it."""
    server = server_of(options)
    params: dict[str, Any] = {"a": options.a, "b": options.b}
    for side, window in (("a", options.a_window), ("b", options.b_window)):
        if window:
            params[f"{side}_from_s"], params[f"{side}_to_s"] = window
    answer = server.ask("GET", "/rides/compare", params=params)
    along = None
    if options.by == "crank":
        along = server.ask("GET", "/rides/compare/crank", params=params)
    elif options.by:
        asked = {**params, "by": options.by, "channels": options.channel, "px": ROWS}
        along = server.ask("GET", "/rides/compare/series", params=asked)
    if options.json:
        print_json(answer if along is None else {**answer, options.by: along})
        return 0
    print_figures(answer)
    print_ways(answer)
    print_settings(answer["settings"])
    if along is not None:
        print()
        print_crank(along) if options.by == "crank" else print_series(along)
    return 0


def print_figures(answer: dict[str, Any]) -> None:
    """Side by side; what is missing with its reason."""
    rows = [
        [
            one["name"],
            *(
                one[side]["missing"] if one[side]["value"] is None else one[side]["value"]
                for side in "ab"
            ),
            signed(one["difference"]),
        ]
        for one in answer["figures"]
    ]
    print_table(rows, ["", *(f"ride {answer[side]['ride_id']}" for side in "ab"), "difference"])
    if answer["motor_torque"] == "apart":
        print("One ride tells what its motor gave, the other only what was asked of it.")


def print_ways(answer: dict[str, Any]) -> None:
    """Whether they went the same way."""
    way = answer["same_way"]
    if way is None:
        who = {"a": "the first has", "b": "the second has", "neither": "neither has"}
        print(f"same way: not known, {who.get(answer['no_way'], 'one has too few')} positions")
        return
    shares = f"{way['a_near_b']:.0%} of the first, {way['b_near_a']:.0%} of the second"
    print(f"within {way['near_m']:g} m of the other's track: {shares}")
    if way["in_step"] is not None:
        print(f"as near at the same distance from their starts: {way['in_step']:.0%}")


def print_settings(settings: dict[str, Any]) -> None:
    """What differs, or whose settings nobody knows."""
    for name, side in (("first", settings["a"]), ("second", settings["b"])):
        if not side["known"]:
            print(f"settings of the {name}: not known, {WHY_NOT[side['why']]}")
    if settings["differences"] is None:
        return
    if not settings["differences"]:
        print("settings: the same")
        return
    rules = {
        "fuzzy_rules" if table["which"] == "first" else "second_rules": table["cells"]
        for table in settings["tables"]
    }
    rows = []
    for change in settings["differences"]:
        cells = rules.get(change["name"])
        if cells is None:
            rows.append([change["name"], change["old"], change["new"]])
        for cell in cells or []:
            place = f"{change['name']} {cell['row']},{cell['column']}"
            rows.append([place, cell["left"], cell["right"]])
    print_table(rows, ["setting", "first", "second"])


def print_series(series: dict[str, Any]) -> None:
    """One channel of both along the axis."""
    (channel,) = series["channels"]
    places = [f"{low:.0f} - {high:.0f} {series['unit']}" for low, high in pairwise(series["x"])]
    sides = [ranges(channel[side], len(places)) for side in "ab"]
    apart = channel["difference"] or [None] * len(places)
    rows = [list(row) for row in zip(places, *sides, map(signed, apart), strict=True)]
    print_table(rows, [channel["name"], "first", "second", "difference of means"])


def ranges(bins: dict[str, Any] | None, count: int) -> list[str | None]:
    """Least and greatest of each bin."""
    if bins is None:
        return [None] * count
    return [
        None if low is None else f"{text_of(low)} - {text_of(high)}"
        for low, high in zip(bins["min"], bins["max"], strict=True)
    ]


def print_crank(crank: dict[str, Any]) -> None:
    """Torque over the crank's angle of both."""
    for name, side in (("first", "a"), ("second", "b")):
        if crank[side] is None:
            print(f"crank of the {name}: not known ({crank[f'{side}_refused']})")
    for source in ("rider_nm", "motor_nm"):
        lines = [crank[side] and crank[side][source] for side in "ab"]
        count = next((len(line) for line in lines if line), 0)
        apart = crank["difference"][source] or [None] * count
        rows = [
            [f"{360 * at // count}", *(line[at] if line else None for line in lines), signed(one)]
            for at, one in enumerate(apart)
        ]
        if rows:
            print_table(rows, [f"{source} from degree", "first", "second", "difference"])


def signed(value: float | None) -> str | None:
    """A difference with its sign."""
    return None if value is None else f"{value:+.5g}"
