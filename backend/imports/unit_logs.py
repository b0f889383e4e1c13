"""Collecting rides from a unit's flash: list, fetch, keep, and only then let the unit free them.

    waiting -> fetching -> checking -> keeping -> done
    any -> failed, with the reason; what is here stays, and the next try goes on from it

A log is written to `.part` in order, so whatever is in that file is a beginning of the log; the
unit's check value over it decides whether it may be gone on with. The log is confirmed to the unit
when its bytes are in the store, never before. What was fetched of a log that the unit has given up
since is all there will ever be of it: it becomes a ride as it is.
"""

from __future__ import annotations

import hashlib
import logging
import os
import re
import threading
import time
import zlib
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import BinaryIO

from backend.core.audit import Action, AuditEntry, Note, no_note
from backend.core.described import described
from backend.core.ride import iso_utc
from backend.core.unit_key import EBL, serial_of
from backend.device.readings import LogSegments, RideLog, RideLogs
from backend.device.unit import Unit
from backend.errors import (
    Conflict,
    DeviceRefused,
    LinkError,
    NoAnswer,
    NotFound,
    PeerProtocolError,
    RequestRefused,
    SpindleError,
    StoreError,
)
from backend.formats.blocks import BLOCKS_SUFFIX, PAGE_BYTES, sync_block
from backend.imports.service import Uploads
from backend.units.outcome import find_outcome, telling
from backend.units.service import Devices

LOG = logging.getLogger(__name__)

TAKE_EVERY_S = 0.050
# How long a unit that was unplugged is waited for, and how often that may happen without a byte.
RECONNECT_S = 600.0
FRUITLESS_MAX = 5
WORD_CHARACTERS = 24
RUNNING = ("waiting", "fetching", "checking", "keeping")


@dataclass(frozen=True)
class Download:
    """How far a log is. received, length: bytes. detail: what happened, for people, or None.

    upload_id, ride_id: what it became; duplicate_of: the ride that was here before.
    """

    state: str = "waiting"
    received: int = 0
    length: int = 0
    bytes_per_s: float | None = None
    detail: str | None = None
    upload_id: str | None = None
    ride_id: int | None = None
    duplicate_of: int | None = None
    confirmed: bool = False


@dataclass(frozen=True)
class UnitLog:
    """A log in a unit as people see it. state: recording, closed, or cut_off by a lost supply.

    started_at: None where the unit was started again since, so that it is unknown.
    """

    log_id: int
    generation: int
    state: str
    started_at: str | None
    duration_s: float
    length: int
    confirmed: bool
    download: Download | None


@dataclass(frozen=True)
class UnitLogs:
    """Every log of a unit; overwritten: how many it gave up before anybody fetched them."""

    items: tuple[UnitLog, ...]
    overwritten: int


@described
class ErasedLog:
    """A log that was freed.

    erases: blocks of the unit's flash for logs erased in its life; None where the unit's answer was
    lost and the log is gone.
    """

    log_id: int
    erases: int | None
    """Blocks of the flash for logs erased in its life; null if its answer was lost."""


@dataclass(frozen=True)
class _Source:
    """The unit that logs are fetched from, and no other that takes its place on the connection."""

    devices: Devices
    device_id: str
    key: str

    @property
    def unit(self) -> Unit:
        """To be asked now; raises NotFound once the connection is removed."""
        return self.devices.unit(self.device_id).only(serial_of(self.key))


class Stopping(SpindleError):
    """Spindle is closing; the download goes on at the next try."""

    default_code = "stopping"


class Collect:
    """Downloads of ride logs, one at a time for each unit. For any thread.

    folder: where unfinished downloads stay. note: adds to the audit.
    """

    def __init__(
        self, devices: Devices, uploads: Uploads, folder: Path, note: Note = no_note
    ) -> None:
        self._devices = devices
        self._note_done = note
        self._uploads = uploads
        self._folder = folder
        self._lock = threading.Lock()
        self._stopping = threading.Event()
        self._workers: dict[str, ThreadPoolExecutor] = {}
        self._downloads: dict[tuple[str, int], Download] = {}

    def logs(self, device_id: str) -> UnitLogs:
        """What a unit has. Raises NotFound, NoAnswer, Conflict for a unit that keeps no logs."""
        source = self._source(device_id)
        listed = source.unit.logs()
        now_us = time.time_ns() // 1000
        items = []
        for log in listed.logs:
            same_boot = log.boot_id == listed.boot_id
            started_us = now_us - (listed.now_us - log.t0_us)
            with self._lock:
                download = self._downloads.get((source.key, log.log_id))
            items.append(
                UnitLog(
                    log_id=log.log_id,
                    generation=log.generation,
                    state=state_of(log),
                    started_at=iso_utc(started_us) if same_boot else None,
                    duration_s=(log.t1_us - log.t0_us) / 1e6,
                    length=log.length,
                    confirmed=log.confirmed,
                    download=download,
                )
            )
        return UnitLogs(tuple(items), listed.overwritten)

    def start(self, device_id: str, log_id: int) -> Download:
        """Begin to fetch a log, or go on; the same download if one is running.

        Beginnings of logs that the unit no longer has become rides meanwhile. Raises NotFound,
        NoAnswer, Conflict while the log is still being written.
        """
        source = self._source(device_id)
        with self._lock:
            running = self._downloads.get((source.key, log_id))
            if running is not None and running.state in RUNNING:
                return running
        listed = source.unit.logs()
        for path in self._orphans(source.key, listed):
            self._worker(source.device_id).submit(self._salvage, path)
        log = _find(listed, log_id, source.device_id)
        if log.recording:
            raise Conflict(
                f"Ride log {log_id} is still being written. It is closed after the bike has stood "
                "for twenty seconds.",
                code="recording",
            )
        download = Download(length=log.length)
        worker = self._worker(source.device_id)
        with self._lock:
            self._downloads[source.key, log_id] = download
        worker.submit(self._run, source, log)
        return download

    def get(self, device_id: str, log_id: int) -> Download:
        """How far a download is. Raises NotFound when none was begun."""
        key = self._devices.last_known_key(device_id)
        with self._lock:
            download = self._downloads.get((key, log_id))
        if download is None:
            raise NotFound(f"Nobody has begun to fetch ride log {log_id} of {key}.")
        return download

    def erase(self, device_id: str, log_id: int) -> ErasedLog:
        """Have the unit free a log that is safe here. Raises NotFound, Conflict, NoAnswer that says
        whether it is erased as far as could be found out.

        Conflict while it is being written or fetched, or before the unit knows that it is safe.
        NameFirst.
        """
        with telling("unchanged"):
            key, unit = self._devices.own(device_id)
            log = _find(unit.logs(), log_id, device_id)
        with self._lock:
            download = self._downloads.get((key, log_id))
        if log.recording or (download is not None and download.state in RUNNING):
            raise Conflict(f"Ride log {log_id} is being written or fetched.", code="recording")
        if not log.confirmed:
            raise Conflict(
                f"Ride log {log_id} is not fetched and confirmed: erasing it would lose the ride. "
                "Fetch it first.",
                code="not_confirmed",
            )
        try:
            with telling("unknown"):
                erases = unit.erase_log(log)
        except NoAnswer as error:
            if error.outcome != "unknown":
                raise
            find_outcome(
                self._devices, device_id, key, lambda unit: unit.outcome_of_erase(log), error
            )
            erases = None
        with self._lock:
            self._downloads.pop((key, log_id), None)
        facts = {"log_id": log_id, "bytes": log.length}
        entry = AuditEntry(Action.UNIT_LOG_ERASED, key, before=facts, unit_key=key)
        self._note_done(entry)
        return ErasedLog(log_id, erases)

    def close(self) -> None:
        """Break off; what has come stays on the disk."""
        with self._lock:
            self._stopping.set()
            workers = list(self._workers.values())
        for worker in workers:
            worker.shutdown(wait=True, cancel_futures=True)

    # ------------------------------------------------------------------ one download

    def _run(self, source: _Source, log: RideLog) -> None:
        try:
            path = self._fetch(source, log)
            self._store_log(source, log, path)
        except SpindleError as error:
            self._note(source, log, state="failed", detail=error.message)
        except Exception as error:
            LOG.exception("Ride log %d of %s was not fetched.", log.log_id, source.key)
            self._note(source, log, state="failed", detail=f"A fault in Spindle: {error}")

    def _fetch(self, source: _Source, log: RideLog) -> Path:
        """The whole log on the disk, checked by the unit."""
        self._folder.mkdir(parents=True, exist_ok=True)
        stem = stem_of(source.key, log)
        part, complete = self._folder / f"{stem}.part", self._folder / f"{stem}{BLOCKS_SUFFIX}"
        with storing(part), part.open("a+b") as file:
            fruitless = 0
            while True:
                before = file.seek(0, os.SEEK_END)
                try:
                    self._continue(source, log, file)
                    break
                except LinkError as error:
                    fruitless = 0 if file.seek(0, os.SEEK_END) > before else fruitless + 1
                    if fruitless > FRUITLESS_MAX:
                        raise
                    self._note(source, log, detail=f"{error.message} Waiting to go on.")
                    self._wait_connected(source.device_id)
            file.flush()
            os.fsync(file.fileno())
        part.replace(complete)
        return complete

    def _continue(self, source: _Source, log: RideLog, file: BinaryIO) -> None:
        """From what is in the file to the whole log. Raises LinkError where that breaks off."""
        have = self._proven_prefix(source, log, file)
        if have < log.length:
            self._note(source, log, state="fetching", received=have, detail=None)
            with source.unit.fetch_log(log, have) as segments:
                self._take(source, log, segments, file)
        self._note(source, log, state="checking", received=log.length, bytes_per_s=None)
        if self._proven_prefix(source, log, file) != log.length:
            raise PeerProtocolError(
                f"Ride log {log.log_id} does not have the check value the unit gives for it. Fetch "
                "it again; if it stays so, the unit's flash is defective."
            )

    def _proven_prefix(self, source: _Source, log: RideLog, file: BinaryIO) -> int:
        """How much of the file is the beginning of the log; anything else is cut away."""
        size = file.seek(0, os.SEEK_END)
        have = min(size - size % PAGE_BYTES, log.length)
        if have > 0:
            file.seek(0)
            local = zlib.crc32(file.read(have))
            if source.unit.log_crc(log, have) != local:
                have = 0
        file.truncate(have)
        return have

    def _take(self, source: _Source, log: RideLog, segments: LogSegments, file: BinaryIO) -> None:
        """Write pieces as they come, until the last."""
        began_s, had = time.monotonic(), segments.received
        while True:
            over = segments.done or segments.failure is not None
            file.writelines(segments.take_segments())
            received = segments.received
            taken_s = time.monotonic() - began_s
            rate = (received - had) / taken_s if taken_s > 0 else None
            self._note(source, log, received=received, bytes_per_s=rate)
            if over:
                break
            if self._stopping.wait(TAKE_EVERY_S):
                raise Stopping("Spindle was closed; fetching goes on at the next try.")
        if segments.failure is not None:
            raise NoAnswer(segments.failure)

    def _store_log(self, source: _Source, log: RideLog, path: Path) -> None:
        """Into the store, and then the unit may free it."""
        self._note(source, log, state="keeping")
        with storing(path):
            crc32 = zlib.crc32(path.read_bytes())
            with path.open("ab") as file:
                file.write(self._wall_time(source, log))
        upload = self._uploads.receive_file(f"log {log.log_id}{BLOCKS_SUFFIX}", path)
        if upload.object_key is None:
            raise StoreError(f"Ride log {log.log_id} was not kept: {upload.detail}")
        path.unlink(missing_ok=True)
        self._note(
            source,
            log,
            upload_id=upload.id,
            ride_id=upload.ride_ids[0] if upload.ride_ids else None,
            duplicate_of=upload.duplicate_of,
            detail=upload.detail,
        )
        try:
            self._devices.own(source.device_id, source.key)
            self._again(source, lambda unit: unit.confirm_log(log, crc32))
            self._note(source, log, state="done", confirmed=True)
        except (LinkError, DeviceRefused, RequestRefused) as error:
            sentence = f"The ride is kept; the unit does not know it yet: {error.message}"
            self._note(source, log, state="done", detail=sentence)

    def _wall_time(self, source: _Source, log: RideLog) -> bytes:
        """When it was ridden, for a file that does not say: known for the unit's present start."""
        try:
            listed = source.unit.logs()
        except SpindleError:
            return b""
        if listed.boot_id != log.boot_id:
            return b""
        started_us = time.time_ns() // 1000 - (listed.now_us - log.t0_us)
        return sync_block(log.log_id, log.boot_id, log.t0_us, started_us)

    # ------------------------------------------------------------------ what was left behind

    def _orphans(self, key: str, listed: RideLogs) -> list[Path]:
        """Files of logs that this unit no longer has, or whose end Spindle's own end prevented."""
        stems = {stem_of(key, log) for log in listed.logs}
        return [
            path
            for path in sorted(self._folder.glob(f"{word_of(key)}-*"))
            if path.suffix in (".part", BLOCKS_SUFFIX) and path.stem not in stems
        ]

    def _salvage(self, path: Path) -> None:
        """Make a ride of what is here; the file goes once its bytes are in the store."""
        try:
            with storing(path):
                if not path.exists():
                    return
                name = f"log {path.stem.split('-')[2]}{BLOCKS_SUFFIX}"
                upload = self._uploads.receive_file(name, path)
                if upload.object_key is not None or path.stat().st_size == 0:
                    path.unlink()
        except SpindleError as error:
            LOG.warning("%s stays where it is: %s", path, error.message)
        except Exception:
            LOG.exception("%s stays where it is.", path)

    # ------------------------------------------------------------------ inside

    def _worker(self, unit_id: str) -> ThreadPoolExecutor:
        """The one thread that fetches from a unit. Raises Stopping."""
        with self._lock:
            if self._stopping.is_set():
                raise Stopping("Spindle is closing.")
            worker = self._workers.get(unit_id)
            if worker is None:
                worker = ThreadPoolExecutor(1, thread_name_prefix=f"collect {unit_id}")
                self._workers[unit_id] = worker
            return worker

    def _source(self, device_id: str) -> _Source:
        """The unit that is on a connection now. Raises NotFound, NoAnswer."""
        key = self._devices.unit_key(device_id)
        return _Source(self._devices, self._devices.get(device_id).id, key)

    def _again(self, source: _Source, work: Callable[[Unit], None]) -> None:
        """Ask the unit something; once more when it was away."""
        try:
            work(source.unit)
        except LinkError:
            self._wait_connected(source.device_id)
            work(source.unit)

    def _wait_connected(self, unit_id: str) -> None:
        """Wait for the unit to come back. Raises NoAnswer when it does not, Stopping."""
        until_s = time.monotonic() + RECONNECT_S
        while not self._devices.wait_connected(unit_id, 0.5):
            if self._stopping.is_set():
                raise Stopping("Spindle was closed; fetching goes on at the next try.")
            if time.monotonic() > until_s:
                raise NoAnswer(f"{unit_id} did not come back. Fetch the log again when it is here.")

    def _note(self, source: _Source, log: RideLog, **changes: object) -> None:
        with self._lock:
            key = (source.key, log.log_id)
            changed = replace(self._downloads[key], **changes)  # type: ignore[arg-type]
            self._downloads[key] = changed


def _find(listed: RideLogs, log_id: int, device_id: str) -> RideLog:
    """The log with this number. Raises NotFound."""
    for log in listed.logs:
        if log.log_id == log_id:
            return log
    raise NotFound(f"{device_id} has no ride log {log_id}; it may have been overwritten.")


def stem_of(key: str, log: RideLog) -> str:
    """Name of a log's files without their ending: no other log of any unit has it."""
    return f"{word_of(key)}-{log.boot_id:08x}-{log.log_id}-{log.generation:08x}"


def word_of(key: str) -> str:
    """A unit's key as every disk takes it: our own serial numbers as they are, else a hash."""
    serial_number = key.removeprefix(f"{EBL}:")
    if re.fullmatch(r"[0-9a-f]+", serial_number):
        return serial_number
    return hashlib.sha256(key.encode()).hexdigest()[:WORD_CHARACTERS]


def state_of(log: RideLog) -> str:
    """Where a log stands, in a word."""
    if log.recording:
        return "recording"
    return "closed" if log.ended else "cut_off"


@contextmanager
def storing(path: Path) -> Iterator[None]:
    """Say which file a disk refused. Raises StoreError."""
    try:
        yield
    except OSError as error:
        raise StoreError(f"{path} cannot be written: {error.strerror or error}.") from None
