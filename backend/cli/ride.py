"""`spindle ride ...`"""

from __future__ import annotations

import sys
from argparse import Namespace
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from typing import Any
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from backend.cli.client import print_json, print_table, text_of, write_out
from backend.cli.device import server_of
from backend.cli.table_answer import answer_for_table
from backend.errors import RequestRefused

# From which hour on a ride is called what, as on the page.
PARTS_OF_DAY = (
    (0, "Night ride"),
    (5, "Morning ride"),
    (11, "Midday ride"),
    (14, "Afternoon ride"),
    (18, "Evening ride"),
    (22, "Night ride"),
)


def import_files(options: Namespace) -> int:
    """Sends files to become rides; 1 if any of them was refused."""
    server = server_of(options)
    answers = []
    for file in options.files:
        answer = {"file": str(file), **answer_for_table(server, options, import_file(server, file))}
        answers.append(answer)
        if not options.json:
            print_upload(answer)
    if options.json:
        print_json(answers[0] if len(answers) == 1 else {"items": answers, "next": None})
    return 1 if any(answer["state"] == "rejected" for answer in answers) else 0


def import_file(server: Any, file: Path) -> dict[str, Any]:
    """The server's verdict on one file; a file it refuses outright is a verdict too."""
    try:
        body = file.read_bytes()
    except OSError as error:
        return {"state": "rejected", "code": "unreadable", "detail": error.strerror, "ride_ids": []}
    try:
        answer: dict[str, Any] = server.ask(
            "POST",
            "/rides/import",
            params={"name": file.name},
            content=body,
            headers={"content-type": "application/octet-stream"},
        )
    except RequestRefused as error:
        return {"state": "rejected", "code": error.code, "detail": error.message, "ride_ids": []}
    return answer


def print_upload(answer: dict[str, Any]) -> None:
    """One line: the file, what became of it, and why."""
    rides = ", ".join(str(ride) for ride in answer["ride_ids"])
    became = f"ride {rides}" if rides else answer["state"]
    if answer.get("duplicate_of") is not None:
        became = f"already here as ride {answer['duplicate_of']}"
    detail = f": {answer['detail']}" if answer.get("detail") else ""
    stream = sys.stderr if answer["state"] == "rejected" else sys.stdout
    stream.write(f"{answer['file']}: {became}{detail}\n")
    stream.flush()


def list_rides(options: Namespace) -> int:
    """Rides, newest first: all, or those that are asked for."""
    filters = {
        "limit": options.limit,
        "bike": options.bike,
        "from": options.since,
        "longer_km": options.longer_km,
        "motor": options.motor or None,
        "events": options.events or None,
        "tag": options.tag,
        "q": " ".join(options.words) or None,
    }
    params = {name: value for name, value in filters.items() if value is not None}
    answer = server_of(options).ask("GET", "/rides", params=params)
    if options.json:
        print_json(answer)
        return 0
    rows = []
    for ride in answer["items"]:
        figures = ride["summary"] or {}
        rows.append(
            [ride["id"], ride["started_at"], ride["state"], title_of(ride)]
            + [figures.get(key) for key in ("distance_km", "moving_s", "rider_wh", "motor_wh")]
            + [", ".join(ride["tags"])]
        )
    headings = ["ride", "started", "state", "name", "km", "moving s", "rider Wh", "motor Wh"]
    headings.append("tags")
    print_table(rows, headings)
    return 0


def title_of(ride: dict[str, Any]) -> str:
    """Its name, else the time of day and the place it began at, by the clock there or here."""
    if ride["name"]:
        return str(ride["name"])
    place = ride["place"] or {}
    began = datetime.fromisoformat(ride["started_at"])
    local = began.astimezone()
    with suppress(ZoneInfoNotFoundError):
        local = began.astimezone(ZoneInfo(place["zone"])) if place.get("zone") else local
    part = next(name for hour, name in reversed(PARTS_OF_DAY) if local.hour >= hour)
    return ", ".join(filter(None, [part, place.get("name")]))


def show(options: Namespace) -> int:
    """One ride's figures."""
    ride = server_of(options).ask("GET", f"/rides/{options.ride}")
    if options.json:
        print_json(ride)
        return 0
    summary = ride.pop("summary") or {}
    channels = [channel["name"] for channel in ride.pop("channels")]
    for name, value in {**ride, **summary, "channels": ", ".join(channels)}.items():
        print(f"{name:28} {text_of(value)}")
    return 0


def export(options: Namespace) -> int:
    """A ride as a file."""
    blur = {} if options.blur is None else {"blur_m": options.blur}
    return save(options, f"{options.ride}/export", {"format": options.format, **blur})


def archive(options: Namespace) -> int:
    """Rides as one ZIP: those that are named, or all."""
    params: dict[str, Any] = {"formats": options.formats.split(",")}
    if options.rides:
        params["ids"] = ",".join(map(str, options.rides))
    if options.blur is not None:
        params["blur_m"] = options.blur
    return save(options, "archive", params)


def report(options: Namespace) -> int:
    """A ride as one HTML file."""
    names = ("language", "threshold_power_w", "heart_rate_bpm_max")
    params = {name: getattr(options, name) for name in names}
    return save(
        options, f"{options.ride}/report", {name: value for name, value in params.items() if value}
    )


def save(options: Namespace, what: str, params: dict[str, Any]) -> int:
    """What the server makes of rides, as a file or to standard output."""
    response = server_of(options).response("GET", f"/rides/{what}", params=params)
    write_out(response.content, options.output)
    if options.json and options.output is not None:
        print_json({"file": str(options.output), "bytes": len(response.content)})
    return 0


def delete(options: Namespace) -> int:
    """Deletes a ride and its samples; with the last ride of a file, the file too."""
    server_of(options).ask("DELETE", f"/rides/{options.ride}")
    if options.json:
        print_json({"deleted": options.ride})
    return 0
