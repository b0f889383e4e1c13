"""`spindle ride upload`: files and whole folders to a server, once or as they appear.

    look at the folders -> files that stand still -> known by hash, or sent in parts -> verdict
A server that is away is waited for, and a file goes on where it stood, also where another run of
this command began it. What was done is not kept here: the server knows every file by its hash.
"""

from __future__ import annotations

import base64
import hashlib
import sys
import time
from argparse import Namespace
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from backend.cli.client import Server, print_json
from backend.cli.device import server_of
from backend.cli.ride import print_upload
from backend.errors import LinkError, RequestRefused

SCAN_EVERY_S = 2.0
PART_BYTES = 1 << 20
# A server that restarts is back in seconds; one that is off is asked once a minute.
WAIT_FIRST_S, WAIT_MAX_S = 1.0, 60.0
RETRY_S = 0.2
TUS = {"tus-resumable": "1.0.0"}
PART = {**TUS, "content-type": "application/offset+octet-stream"}
WORDS = {
    "complete": "read completely",
    "here": "already here",
    "partial": "read in part",
    "rejected": "not read",
}


@dataclass(frozen=True)
class FileState:
    """A file as it stood when it was looked at."""

    path: Path
    size: int
    mtime_ns: int


class Sender:
    """Sends files to one server, however often that goes away. wait: as `time.sleep`."""

    def __init__(self, server: Server, wait: Callable[[float], None] = time.sleep) -> None:
        self._server = server
        self._wait = wait

    def send(self, path: Path) -> dict[str, Any]:
        """The server's verdict on a file; one that it refuses or that is gone is a verdict too."""
        try:
            data = path.read_bytes()
        except OSError as error:
            return refused("unreadable", str(error.strerror))
        try:
            return self._sent(path.name, data)
        except RequestRefused as error:
            return refused(error.code, error.message)

    def _sent(self, name: str, data: bytes) -> dict[str, Any]:
        sha256 = hashlib.sha256(data).hexdigest()
        uploads = self._patiently("GET", "/uploads", params={"sha256": sha256}).json()["items"]
        for upload in uploads:
            if upload["ride_ids"] and upload["parts"] is None:
                return {**upload, "code": "duplicate", "duplicate_of": upload["ride_ids"][0]}
        for upload in uploads:
            if upload["state"] == "receiving" and upload["length"] == len(data):
                return self._go_on(f"/uploads/{upload['id']}", upload["received"], data)
        described = {"filename": name, "sha256": sha256}
        pairs = (f"{key} {base64.b64encode(v.encode()).decode()}" for key, v in described.items())
        headers = {**TUS, "upload-length": str(len(data)), "upload-metadata": ",".join(pairs)}
        location = self._patiently("POST", "/uploads", headers=headers).headers["location"]
        return self._go_on("/uploads/" + location.rsplit("/", 1)[-1], 0, data)

    def _go_on(self, path: str, offset: int, data: bytes) -> dict[str, Any]:
        """Send what is left of a file; the server's verdict."""
        while offset < len(data):
            part = data[offset : offset + PART_BYTES]
            try:
                answer = self._server.response(
                    "PATCH", path, headers={**PART, "upload-offset": str(offset)}, content=part
                )
            except LinkError:
                # Only the server knows how much of the part arrived.
                answer = self._patiently("HEAD", path, headers=TUS)
            except RequestRefused as error:
                if error.code != "offset_mismatch":
                    # Refused by its first bytes, which is a verdict; or something that is none.
                    verdict: dict[str, Any] = self._patiently("GET", path).json()
                    if verdict["state"] == "rejected":
                        return verdict
                    raise
                answer = self._patiently("HEAD", path, headers=TUS)
            offset = int(answer.headers["upload-offset"])
        return self._verdict(path)

    def _verdict(self, path: str) -> dict[str, Any]:
        while True:
            upload: dict[str, Any] = self._patiently("GET", path).json()
            if upload["state"] not in ("receiving", "queued") or upload["code"] == "ride_is_live":
                return upload
            self._wait(RETRY_S)

    def _patiently(self, method: str, path: str, **request: Any) -> Any:
        """An answer, whenever it comes. Raises RequestRefused."""
        wait_s = WAIT_FIRST_S
        while True:
            try:
                return self._server.response(method, path, **request)
            except LinkError as error:
                sys.stderr.write(f"{error.message} Tried again in {wait_s:g} s.\n")
            self._wait(wait_s)
            wait_s = min(2 * wait_s, WAIT_MAX_S)


class Folders:
    """Files of some folders, each once as it stands. watching: only those that stand still."""

    def __init__(self, paths: Sequence[Path], watching: bool) -> None:
        self._paths = paths
        self._watching = watching
        self._before: set[FileState] = set()
        self._sent_before: set[FileState] = set()

    def new(self) -> list[Path]:
        """Files that were not given yet, and have not grown since the look before."""
        states = {look for path in self._paths for look in file_states(path)}
        still = states & self._before if self._watching else states
        self._before = states
        fresh = sorted(still - self._sent_before, key=lambda look: look.path)
        self._sent_before |= set(fresh)
        return [look.path for look in fresh]


def file_states(path: Path) -> Iterator[FileState]:
    """A file, or every file below a folder but the hidden ones."""
    inside = path.rglob("*") if path.is_dir() else [path]
    for file in inside:
        if any(part.startswith(".") for part in file.relative_to(path).parts):
            continue
        try:
            if path.is_dir() and not file.is_file():
                continue
            status = file.stat()
        except OSError:
            # It went while it was looked at; the next look tells.
            continue
        yield FileState(file, status.st_size, status.st_mtime_ns)


def upload(options: Namespace) -> int:
    """Sends files and folders; with --watch also what appears in them. 1 if any was not read."""
    missing = [str(path) for path in options.paths if not path.exists()]
    if missing:
        raise RequestRefused(f"There is no {', '.join(missing)}.")
    answers: list[dict[str, Any]] = []
    sender, folders = Sender(server_of(options)), Folders(options.paths, options.watch)
    try:
        while True:
            for path in folders.new():
                answers.append({"file": str(path), **sender.send(path)})
                if not options.json:
                    print_upload(answers[-1])
            if not options.watch:
                break
            time.sleep(SCAN_EVERY_S)
    except KeyboardInterrupt:
        # The way to end a watch; what was done is printed as usual.
        pass
    counted = Counter(map(standing, answers))
    if options.json:
        print_json({"items": answers, "summary": {word: counted[word] for word in WORDS}})
    else:
        summary = ", ".join(f"{counted[word]} {WORDS[word]}" for word in WORDS if counted[word])
        files = "1 file" if len(answers) == 1 else f"{len(answers)} files"
        print(f"{files}: {summary}." if answers else "No file.")
    return 1 if counted["rejected"] else 0


def standing(answer: dict[str, Any]) -> str:
    """What became of a file, in one word."""
    if answer.get("duplicate_of") is not None or answer.get("code") == "duplicate":
        return "here"
    return str(answer["state"])


def refused(code: str, detail: str) -> dict[str, Any]:
    """A verdict without an upload."""
    return {"state": "rejected", "code": code, "detail": detail, "ride_ids": []}
