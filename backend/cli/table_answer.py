"""What `spindle ride import` says of tables that do not say it themselves."""

from __future__ import annotations

import time
from argparse import ArgumentTypeError, Namespace
from typing import Any

from backend.errors import RequestRefused

NONE = "none"
"""What `--column` calls a column that is to be none of ours."""
# What is asked of a table beside its columns.
OF_THE_TABLE = ("time_zone", "rows_per_second", "date_order")
QUANTITIES = ("speed", "distance", "altitude", "temperature", "torque")
"""What `--speed-unit` and its like say the unit of."""
SAYING = (
    *("column", "time_zone", "rows_per_second", "dates"),
    *(f"{quantity}_unit" for quantity in QUANTITIES),
)
"""Options that say something of tables."""
# What is said of one column can open a question about another.
QUESTIONS_MAX = 3


def column_meaning(text: str) -> tuple[str, str]:
    """`NAME=CHANNEL` -> the two; a name may hold the sign."""
    name, sign, channel = text.rpartition("=")
    if not (name and sign and channel):
        raise ArgumentTypeError(f"{text!r} is not NAME=CHANNEL")
    return name, "" if channel == NONE else channel


def answer_for_table(server: Any, options: Namespace, upload: dict[str, Any]) -> dict[str, Any]:
    """What became of a table once the options say what it does not, or what its columns are; other
    files as they are."""
    says = any(getattr(options, name) for name in SAYING)
    if upload.get("code") == "part_asks" or (upload.get("parts") and says):
        return answer_for_parts(server, options, upload)
    is_ride = bool(says and upload.get("has_columns") and upload["ride_ids"])
    for _ in range(QUESTIONS_MAX):
        if not is_ride and upload.get("code") != "needs_mapping":
            break
        path = f"/uploads/{upload['id']}/mapping"
        try:
            question = server.ask("GET", path)
            answer, lacks = answer_of(options, question)
            if is_ride and not differs(question, answer):
                break
            if lacks:
                detail = f"{upload['detail'] or ''} Lacking: {'; '.join(lacks)}.".lstrip()
                return {**upload, "detail": detail}
            upload = server.ask("PUT", path, json=answer)
        except RequestRefused as error:
            return {**upload, "code": error.code, "detail": error.message}
        is_ride = False
    return upload


def differs(question: dict[str, Any], answer: dict[str, Any]) -> bool:
    """Whether an answer says anything else of a table than what was said before."""
    before = question["answer"] or {}
    asked = [column["name"] for column in question["columns"] if column["units"]]
    units = before.get("units", {})
    return (
        answer["channels"] != before.get("channels", {})
        or any(answer["units"].get(name) != units.get(name) for name in asked)
        or any(question[name] and answer[name] != before.get(name) for name in OF_THE_TABLE)
    )


def answer_of(options: Namespace, question: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """The answer of the options, with what was said before; and which options it lacks."""
    before = question["answer"] or {}
    names = {column["name"] for column in question["columns"]}
    meanings = {name: channel for name, channel in options.column if name in names}
    answer: dict[str, Any] = {
        "time_zone": options.time_zone or before.get("time_zone"),
        "rows_per_second": options.rows_per_second or before.get("rows_per_second"),
        "date_order": options.dates or before.get("date_order"),
        "channels": {**before.get("channels", {}), **meanings},
        "units": dict(before.get("units", {})),
    }
    lacks = []
    offered = {channel["name"]: channel["units"] for channel in question["offered_channels"]}
    for column in question["columns"]:
        name, channel, units = column["name"], column["channel"], column["units"]
        if column["channels"] and name not in answer["channels"]:
            choices = ", ".join(channel or NONE for channel in column["channels"])
            lacks.append(f"--column '{name}=CHANNEL' ({choices})")
            continue
        stated = answer["channels"].get(name, channel)
        if stated != channel:
            units = offered.get(stated, [])
        if not units:
            continue
        unit = unit_option(options, stated) or answer["units"].get(name)
        unit = unit or (column["unit"] if column["unit"] in units else None)
        if unit is None:
            lacks.append(f"--{quantity_of(stated)}-unit ({', '.join(units)}) of {name}")
        else:
            answer["units"][name] = unit
    if question["time_zone"] and answer["time_zone"] is None:
        lacks.append("--time-zone of its times")
    if question["rows_per_second"] and answer["rows_per_second"] is None:
        lacks.append("--rows-per-second")
    if question["date_order"] and answer["date_order"] is None:
        lacks.append("--dates (day_first, month_first)")
    return answer, lacks


def quantity_of(channel: str) -> str:
    """`motor_torque_nm` -> `torque`."""
    return channel.split("_")[-2]


def unit_option(options: Namespace, channel: str) -> str | None:
    """What an option says of the unit of a channel."""
    unit: str | None = getattr(options, f"{quantity_of(channel)}_unit", None)
    return unit


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
