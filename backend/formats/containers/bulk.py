"""What Strava and Garmin send who asks for everything: which files are rides, what they are called.

Strava: `activities.csv` names the file of each activity (`activities/1.fit.gz`), its title and its
description. Its headings are in the language of the account; the columns stand in one order.
Garmin: `DI_CONNECT/DI-Connect-Uploaded-Files/UploadedFiles_*.zip` hold every FIT file that was ever
sent, and `*_summarizedActivities.json` the names, by the time of their start.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import Any

STRAVA_TABLE = "activities.csv"
STRAVA_FOLDER = "activities/"
# Columns where the headings are in another language.
TITLE_COLUMN, DESCRIPTION_COLUMN = 2, 4
GARMIN_ROOT = "DI_CONNECT"
GARMIN_FILES = "UploadedFiles"
SUMMARY = "summarizedactivities"
# A name or a text longer than this is none.
TITLE_LENGTH_MAX = 200
TEXT_LENGTH_MAX = 5000


@dataclass(frozen=True)
class Titles:
    """Title and description of rides: by the name of their file, or by Unix time of their start."""

    by_name: dict[str, tuple[str, str]]
    by_start_us: tuple[tuple[int, str, str], ...] = ()


def left_alone(names: Sequence[str]) -> frozenset[str]:
    """Files of an export that are no rides and need no word: photos, settings, messages."""
    table = next((n for n in names if PurePosixPath(n).name == STRAVA_TABLE), None)
    if table is not None:
        folder = table[: -len(STRAVA_TABLE)] + STRAVA_FOLDER
        return frozenset(name for name in names if not name.startswith(folder))
    if any(GARMIN_ROOT in PurePosixPath(name).parts for name in names):
        return frozenset(n for n in names if not PurePosixPath(n).name.startswith(GARMIN_FILES))
    return frozenset()


def strava(data: bytes, table: str) -> dict[str, tuple[str, str]]:
    """`activities.csv` -> title and description by the name of the file within the archive."""
    root = table[: -len(STRAVA_TABLE)]
    rows = csv.reader(io.StringIO(data.decode("utf-8-sig", errors="replace")))
    titles: dict[str, tuple[str, str]] = {}
    try:
        heading = next(rows, [])
        title, description = columns_of(heading)
        for row in rows:
            name = next((cell for cell in row if cell.startswith(STRAVA_FOLDER)), None)
            if name is not None and len(row) > title:
                text = row[description] if description and len(row) > description else ""
                titles[root + name] = (row[title][:TITLE_LENGTH_MAX], text[:TEXT_LENGTH_MAX])
    except csv.Error:
        # What was read of the table before stays.
        pass
    return titles


def columns_of(heading: Sequence[str]) -> tuple[int, int | None]:
    """Where title and description stand; no description where its heading is missing."""
    if "Activity Name" not in heading:
        return TITLE_COLUMN, DESCRIPTION_COLUMN
    description = "Activity Description"
    about = heading.index(description) if description in heading else None
    return heading.index("Activity Name"), about


def is_summary(name: str) -> bool:
    """Whether a file of a Garmin export tells the names of rides."""
    last = PurePosixPath(name).name.lower()
    return SUMMARY in last and last.endswith(".json")


def summaries(data: bytes) -> list[tuple[int, str, str]]:
    """Start in microseconds since 1970, title and description of a Garmin export's activities."""
    try:
        parts = json.loads(data)
    except (ValueError, RecursionError):
        return []
    titles = []
    for part in parts if isinstance(parts, list) else []:
        exported = part.get("summarizedActivitiesExport") if isinstance(part, dict) else None
        summary_of_each = map(summary, exported if isinstance(exported, list) else [])
        titles += [one for one in summary_of_each if one is not None]
    return titles


def summary(one: Any) -> tuple[int, str, str] | None:
    """One activity; None without a name or a time."""
    if not isinstance(one, dict):
        return None
    start_ms, name = one.get("beginTimestamp"), one.get("name")
    if not isinstance(start_ms, int | float) or not isinstance(name, str) or not name:
        return None
    if not 0 < start_ms < 1e14:
        return None
    text = one.get("description")
    about = text[:TEXT_LENGTH_MAX] if isinstance(text, str) else ""
    return int(start_ms) * 1000, name[:TITLE_LENGTH_MAX], about
