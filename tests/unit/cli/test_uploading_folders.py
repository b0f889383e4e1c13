"""Goal: a folder reaches the server file by file, whole, once, though line and server come and go.

Method: a server in memory that fails as told and counts bytes, and folders on the disk; no waiting.
"""

from __future__ import annotations

import base64
import os
from pathlib import Path
from typing import Any

import httpx

from backend.cli.client import Server
from backend.cli.ride_upload import Folders, Sender

DATA = bytes(range(256)) * 10_000


class Desk:
    """A tus server. faults: what becomes of the next requests: away, lost (done, answer lost)."""

    def __init__(self, *faults: str | None) -> None:
        self.faults = list(faults)
        self.files: list[dict[str, Any]] = []
        self.known: list[dict[str, Any]] = []
        self.waited_s: list[float] = []
        transport = httpx.MockTransport(self.answer)
        self.sender = Sender(Server("http://desk", transport), self.waited_s.append)

    def answer(self, request: httpx.Request) -> httpx.Response:
        fault = self.faults.pop(0) if self.faults else None
        if fault == "away":
            raise httpx.ConnectError("away")
        response = self.done(request)
        if fault == "lost":
            raise httpx.ReadError("lost")
        return response

    def done(self, request: httpx.Request) -> httpx.Response:
        if request.method == "GET" and request.url.path.endswith("/uploads"):
            return httpx.Response(200, json={"items": self.known, "next": None})
        if request.method == "POST":
            told = dict(pair.split(" ") for pair in request.headers["upload-metadata"].split(","))
            self.files.append(
                {"told": told, "data": b"", "length": request.headers["upload-length"]}
            )
            return httpx.Response(201, headers={"location": f"/api/v1/uploads/{len(self.files)}"})
        file = self.files[int(request.url.path.rsplit("/", 1)[-1]) - 1]
        stands = {"upload-offset": str(len(file["data"]))}
        if request.method == "HEAD":
            return httpx.Response(200, headers=stands)
        if request.method == "GET":
            whole = len(file["data"]) == int(file["length"])
            state = "complete" if whole else file.get("state", "receiving")
            body = {"state": state, "code": None, "detail": "", "ride_ids": [1], "received": 1}
            return httpx.Response(200, json=body)
        if request.headers["upload-offset"] != stands["upload-offset"]:
            problem = {"code": "offset_mismatch", "detail": "no"}
            return httpx.Response(409, json=problem)
        if request.content.startswith(b"<html>"):
            file["state"] = "rejected"
            return httpx.Response(422, json={"code": "unsupported_format", "detail": "HTML"})
        file["data"] += request.content
        return httpx.Response(204, headers={"upload-offset": str(len(file["data"]))})


def written(folder: Path, name: str, data: bytes = DATA) -> Path:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)
    return path


def test_a_file_arrives_whole_though_the_server_goes_away_and_answers_are_lost(
    tmp_path: Path,
) -> None:
    desk = Desk("away", "away", None, None, "lost", None, "away", None)

    verdict = desk.sender.send(written(tmp_path, "ride.fit"))

    assert verdict["state"] == "complete"
    assert [file["data"] for file in desk.files] == [DATA]
    assert desk.waited_s[:2] == [1.0, 2.0]
    sha256 = base64.b64decode(desk.files[0]["told"]["sha256"]).decode()
    assert len(sha256) == 64


def test_a_server_that_stays_away_is_asked_once_a_minute(tmp_path: Path) -> None:
    desk = Desk(*["away"] * 9)

    desk.sender.send(written(tmp_path, "ride.fit"))

    assert desk.waited_s == [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 60.0, 60.0, 60.0]


def test_what_the_server_knows_by_its_hash_is_not_sent(tmp_path: Path) -> None:
    desk = Desk()
    desk.known = [{"ride_ids": [7], "parts": None, "state": "complete", "code": None}]

    verdict = desk.sender.send(written(tmp_path, "ride.fit"))

    assert (verdict["duplicate_of"], desk.files) == (7, [])


def test_what_another_run_began_goes_on_where_it_stood(tmp_path: Path) -> None:
    desk = Desk()
    desk.files = [{"told": {}, "data": DATA[:1_000_000], "length": str(len(DATA))}]
    begun = {"id": "1", "state": "receiving", "length": len(DATA), "received": 1_000_000}
    desk.known = [begun | {"ride_ids": [], "parts": None}]

    verdict = desk.sender.send(written(tmp_path, "ride.fit"))

    assert verdict["state"] == "complete"
    assert [file["data"] for file in desk.files] == [DATA]


def test_what_is_refused_by_its_first_part_is_not_sent_on(tmp_path: Path) -> None:
    desk = Desk()

    verdict = desk.sender.send(written(tmp_path, "ride.fit", b"<html>" + bytes(3_000_000)))

    assert (verdict["state"], desk.files[0]["data"]) == ("rejected", b"")


def test_a_file_that_went_is_a_verdict(tmp_path: Path) -> None:
    assert Desk().sender.send(tmp_path / "gone.fit")["code"] == "unreadable"


def test_folders_give_every_file_once_and_no_hidden_one(tmp_path: Path) -> None:
    seen = [written(tmp_path, name) for name in ("a.fit", "2024/b.fit", "2024/deep/c.gpx")]
    written(tmp_path, ".DS_Store")
    written(tmp_path, ".trash/d.fit")
    folders = Folders([tmp_path], watching=False)

    assert folders.new() == sorted(seen)
    assert folders.new() == []


def test_a_watched_file_is_given_when_it_stands_still_and_again_when_it_changes(
    tmp_path: Path,
) -> None:
    folders = Folders([tmp_path], watching=True)
    path = written(tmp_path, "a.fit", b"part")
    assert folders.new() == []
    path.write_bytes(b"part and more")
    assert folders.new() == []

    assert folders.new() == [path]
    assert folders.new() == []
    os.utime(path, ns=(1, 1))
    folders.new()
    assert folders.new() == [path]
