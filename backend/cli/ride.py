"""`spindle ride ...`"""

from __future__ import annotations

import sys
import time
from argparse import Namespace
from contextlib import suppress
from datetime import datetime
from pathlib import Path
from typing import Any
from zoneinfo import ZoneInfo, ZoneInfoNotFoundError

from backend.cli.client import print_json, print_table, text_of, write_out
from backend.cli.device import server_of
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


def answer_for_table(server: Any, options: Namespace, upload: dict[str, Any]) -> dict[str, Any]:
    """What became of a table once the options say what it does not; other files as they are."""
    if upload.get("code") == "part_asks":
        return answer_for_parts(server, options, upload)
    if upload.get("code") != "needs_mapping":
        return upload
    path = f"/uploads/{upload['id']}/mapping"
    question = server.ask("GET", path)
    by_channel = {
        "speed_kmh": options.speed_unit,
        "distance_m": options.distance_unit,
        "altitude_m": options.altitude_unit,
        "temperature_degc": options.temperature_unit,
        "motor_temperature_degc": options.temperature_unit,
        "rider_torque_nm": options.torque_unit,
        "motor_torque_nm": options.torque_unit,
    }
    lacks, units = [], {}
    for column in question["columns"]:
        if not column["units"]:
            continue
        option = by_channel.get(column["channel"])
        if option is None:
            name = column["channel"].split("_")[-2]
            lacks.append(f"--{name}-unit ({', '.join(column['units'])}) of {column['name']}")
        else:
            units[column["name"]] = option
    if question["time_zone"] and options.time_zone is None:
        lacks.append("--time-zone of its times")
    if question["rows_per_second"] and options.rows_per_second is None:
        lacks.append("--rows-per-second")
    if lacks:
        return {**upload, "detail": f"{upload['detail']} Lacking: {'; '.join(lacks)}."}
    body = {
        "time_zone": options.time_zone,
        "units": units,
        "rows_per_second": options.rows_per_second,
    }
    try:
        answer: dict[str, Any] = server.ask("PUT", path, json=body)
    except RequestRefused as error:
        return {**upload, "code": error.code, "detail": error.message}
    return answer


def answer_for_parts(server: Any, options: Namespace, upload: dict[str, Any]) -> dict[str, Any]:
    """What became of an archive once the options say what tables within it do not."""
    cursor: str | None = None
    while True:
        params = {"part_of": upload["id"], "limit": 500, **({"cursor": cursor} if cursor else {})}
        page = server.ask("GET", "/uploads", params=params)
        for part in page["items"]:
            # What was said of one may have read it since.
            now = server.ask("GET", f"/uploads/{part['id']}")
            answer = answer_for_table(server, options, now)
            if answer.get("code") == "needs_mapping":
                return {
                    **upload,
                    "detail": f"{upload['detail']} {part['name']}: {answer['detail']}",
                }
        cursor = page["next"]
        if cursor is None:
            return read_by_now(server, upload["id"])


def read_by_now(server: Any, upload_id: str) -> dict[str, Any]:
    """An upload when it is read, or how it stands after a minute."""
    for _ in range(120):
        upload: dict[str, Any] = server.ask("GET", f"/uploads/{upload_id}")
        if upload["state"] != "queued":
            break
        time.sleep(0.5)
    return upload


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
