"""Objects in a bucket (S3): the same keys, with a folder that holds what was used lately.

    s3://bucket/prefix?endpoint=http://127.0.0.1:9000&region=eu-central-1

What is written is in the bucket before it counts. An object of several parts appears with the last
of them, so a stop on the way leaves none. Keys of access come from the environment, the files of
AWS or the machine (`AWS_ACCESS_KEY_ID`, `~/.aws`, instance role), never from the URL.

The folder beside (`cache`) may be removed while no server runs, but for `.spool/`, uploads that
still arrive: the rest are copies and files on their way. Only what never changes is read from it.
"""

from __future__ import annotations

import os
import shutil
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Any, BinaryIO
from urllib.parse import parse_qs, urlsplit
from urllib.request import url2pathname

from pyarrow.fs import AwsStandardS3RetryStrategy, FileInfo, FileSelector, FileType, S3FileSystem

from backend.errors import FieldError, InvalidRequest, ObjectsAway, StoreError
from backend.store.health import BUCKET_REFUSES, BUCKET_UNREACHABLE, WORDS
from backend.store.objects import (
    CALIBRATIONS,
    KINDS,
    LOST_FOUND,
    PART,
    READ_BYTES,
    SIDECAR_SUFFIX,
    VISITS,
    Arrived,
    Disk,
    FileObjects,
    json_object,
)

FORMS = "file:///folder or s3://bucket/prefix?endpoint=https://host&region=name"
# Tries of one request, with pauses that grow; then the write is refused and tried by its caller.
ATTEMPTS = 3
CONNECT_TIMEOUT_S, REQUEST_TIMEOUT_S = 5.0, 10.0
# Read whole before it is sent: what cannot be read is not sent in part.
SENT_AT_ONCE_BYTES = 16 << 20
CACHE_BYTES = 4 << 30
# What was opened so lately may be in use.
IN_USE_S = 600.0
PROBE = ".probe"
# What a bucket says of a request that will not succeed by waiting (S3 API, error responses).
REFUSALS = ("ACCESS_DENIED", "INVALID_ACCESS_KEY_ID", "SIGNATURE", "NO_SUCH_BUCKET", "TOKEN")


@dataclass(frozen=True)
class BucketPlace:
    """Where a bucket is. prefix: empty or ends with a slash."""

    bucket: str
    prefix: str
    endpoint: str | None
    region: str | None

    @property
    def shown(self) -> str:
        """For messages."""
        at = f" at {self.endpoint}" if self.endpoint else ""
        return f"s3://{self.bucket}/{self.prefix}{at}"


def bucket_place(url: str) -> BucketPlace:
    """Reads a bucket's URL. Raises InvalidRequest, which shows nothing of a key in it."""
    parts = urlsplit(url)
    if parts.username or parts.password:
        raise refused(
            "The URL of the objects must not have keys in it: set AWS_ACCESS_KEY_ID and "
            "AWS_SECRET_ACCESS_KEY in the environment."
        )
    query = parse_qs(parts.query, keep_blank_values=True)
    unknown = sorted(query.keys() - {"endpoint", "region"})
    if not parts.netloc or unknown:
        what = f"there is no option {', '.join(unknown)}" if unknown else "it names no bucket"
        raise refused(f"The URL of the objects: {what}. Write {FORMS}.")
    endpoint = query.get("endpoint", [""])[-1] or None
    if endpoint and urlsplit(endpoint).scheme not in ("http", "https"):
        raise refused(f"The endpoint {endpoint!r} is no address. Write {FORMS}.")
    region = query.get("region", [""])[-1] or None
    prefix = parts.path.strip("/")
    return BucketPlace(parts.netloc, f"{prefix}/" if prefix else "", endpoint, region)


def open_objects(url: str, cache: Path | None = None, disk: Disk | None = None) -> FileObjects:
    """The object store of a URL; makes no request yet.

    cache: folder for copies of a bucket's objects, which only a bucket needs. Raises
    InvalidRequest for a URL that is none.
    """
    parts = urlsplit(url)
    if parts.scheme == "file":
        return FileObjects(Path(url2pathname(parts.path)), disk)
    if parts.scheme == "s3" and cache is not None:
        return BucketObjects(bucket_place(url), cache, disk)
    raise refused(f"The URL of the objects: there is no scheme {parts.scheme!r}. Write {FORMS}.")


def filesystem(place: BucketPlace) -> S3FileSystem:
    """The bucket's door; makes no request."""
    endpoint = urlsplit(place.endpoint or "")
    return S3FileSystem(
        region=place.region or ("us-east-1" if place.endpoint else None),
        scheme=endpoint.scheme or "https",
        endpoint_override=endpoint.netloc or None,
        connect_timeout=CONNECT_TIMEOUT_S,
        request_timeout=REQUEST_TIMEOUT_S,
        # What fits in one request is one.
        allow_delayed_open=True,
        retry_strategy=AwsStandardS3RetryStrategy(max_attempts=ATTEMPTS),
    )


def is_lasting(key: str) -> bool:
    """Whether an object never changes: its name is a hash of it."""
    return not key.endswith(SIDECAR_SUFFIX) or key.startswith(f"{CALIBRATIONS}/")


def free_key(key: str, taken: set[str]) -> str:
    """The key, or the first of key.1, key.2 ... that is not taken."""
    numbered = (f"{key}.{number}" for number in count(1))
    return key if key not in taken else next(one for one in numbered if one not in taken)


def refused(message: str) -> InvalidRequest:
    """The refusal of the setting `objects`."""
    return InvalidRequest(message, fields=[FieldError("objects", "not_accepted", message)])


class BucketObjects(FileObjects):
    """Objects of a bucket. root: the folder of copies, of this server alone.

    cache_bytes: how much of them is left; copies that may be in use stay beyond it.
    """

    is_folder = False

    def __init__(
        self,
        place: BucketPlace,
        cache: Path,
        disk: Disk | None = None,
        cache_bytes: int = CACHE_BYTES,
    ) -> None:
        super().__init__(cache, disk)
        self.where = place.shown
        self._place = place
        self._cache_bytes = cache_bytes
        self._s3 = filesystem(place)
        self._tidying = threading.Lock()

    def prepare(self) -> None:
        """Make the folder of copies; see that the bucket is there. Raises StoreError."""
        super().prepare()
        with self._asking("The store was not opened"):
            if self._s3.get_file_info(self._place.bucket).type is FileType.NotFound:
                raise StoreError(
                    f"There is no bucket {self._place.bucket} in {self.where}. Make it, or correct "
                    "SPINDLE_OBJECTS."
                )

    def publish(self, staged: Path, key: str) -> None:
        """Make a staged file the object `key`, in the bucket once this returns. Raises StoreError;
        then the key is as it was, or whole."""
        self._send(staged, key)
        if is_lasting(key):
            with self.watch.writing(PART, f"The copy of {key} was not saved"):
                self._move(staged, self.root / key)
            self._make_room()
        else:
            staged.unlink(missing_ok=True)

    def try_write(self, part: str) -> None:
        """Write a little where `part` is written, for the watch to see how that goes."""
        super().try_write(part)
        if part == PART:
            with suppress(StoreError), self._writing("Nothing was lost"):
                self._put(PROBE, b"")

    def read_json(self, key: str) -> dict[str, Any] | None:
        """As of a folder, always from the bucket: another server may have written it."""
        with self._asking(f"{key} was not read"):
            try:
                with self._s3.open_input_stream(self._at(key)) as stream:
                    text = stream.read()
            except FileNotFoundError:
                return None
        return json_object(text, f"{self.where}: {key}")

    def find(self, key: str) -> Path | None:
        """Where a copy of the object is, fetched if need be. Raises StoreError."""
        path = self.here(key)
        if path is None:
            return self._fetched(key)
        with suppress(OSError):
            os.utime(path)
        return path

    def here(self, key: str) -> Path | None:
        """The copy on this machine of what never changes."""
        path = self.root / key
        return path if is_lasting(key) and path.is_file() else None

    def arrived(self, key: str) -> Arrived | None:
        """Size and age of an object in the bucket."""
        with self._asking(f"{key} was not looked for"):
            info = self._s3.get_file_info(self._at(key))
        if info.type is not FileType.File:
            return None
        return Arrived(info.size, info.mtime_ns // 1000)

    def remove(self, key: str) -> None:
        """As of a folder: from the bucket, then here. What never was an object is only here."""
        with self._asking(f"The object {key} was not removed"), suppress(FileNotFoundError):
            self._s3.delete_file(self._at(key))
        super().remove(key)

    def move_to_lost_found(self, key: str, name: str | None = None) -> str:
        """As of a folder, within the bucket; a file that is only here is sent there."""
        taken = {free.removeprefix(f"{LOST_FOUND}/") for free in self.lost_keys()}
        target = free_key(name or key, taken)
        moved = f"{LOST_FOUND}/{target}"
        here = self.root / key
        if self.arrived(key) is None and here.is_file():
            self._send(here, moved)
            super().remove(key)
            return moved
        with self._asking(f"{key} was not moved to {LOST_FOUND}/"):
            self._s3.copy_file(self._at(key), self._at(moved))
            self._s3.delete_file(self._at(key))
        return moved

    def size_bytes(self) -> int:
        """As of a folder, from the bucket's list."""
        return sum(one.size for kind in KINDS for one in self._listed(kind))

    def _files(self, folders: tuple[str, ...]) -> Iterator[str]:
        """Keys below some folders of the bucket, in their order."""
        start = len(self._at(""))
        for folder in folders:
            yield from sorted(one.path[start:] for one in self._listed(folder))

    def _listed(self, folder: str) -> list[FileInfo]:
        selector = FileSelector(self._at(folder), allow_not_found=True, recursive=True)
        with self._asking(f"{folder}/ was not listed"):
            found = self._s3.get_file_info(selector)
        return [one for one in found if one.type is FileType.File]

    def _at(self, key: str) -> str:
        return f"{self._place.bucket}/{self._place.prefix}{key}"

    def _send(self, staged: Path, key: str) -> None:
        """Copy a file to the bucket. Raises StoreError."""
        with self._writing(f"The object {key} was not saved"):
            if staged.stat().st_size <= SENT_AT_ONCE_BYTES:
                self._put(key, staged.read_bytes())
                return
            with staged.open("rb") as file:
                self._put_in_parts(key, file)

    def _put(self, key: str, data: bytes) -> None:
        with self._s3.open_output_stream(self._at(key)) as stream:
            stream.write(data)

    def _put_in_parts(self, key: str, file: BinaryIO) -> None:
        """A large file, a part at a time: named by its content, so nothing else has this key."""
        stream = self._s3.open_output_stream(self._at(key))
        try:
            shutil.copyfileobj(file, stream, READ_BYTES)
        except BaseException:
            # Closing makes an object of what was sent.
            with suppress(OSError):
                stream.close()
            with suppress(OSError):
                self._s3.delete_file(self._at(key))
            raise
        stream.close()

    def _fetched(self, key: str) -> Path | None:
        """A copy of an object, whole; None where there is none. Raises StoreError."""
        staged = self.stage()
        try:
            with self._asking(f"The object {key} was not read"):
                try:
                    size = self._fetch(key, staged)
                except FileNotFoundError:
                    return None
                if staged.stat().st_size != size:
                    raise ObjectsAway(f"The object {key} came in part from {self.where}.")
                self._move(staged, self.root / key)
        finally:
            staged.unlink(missing_ok=True)
        self._make_room()
        return self.root / key

    def _fetch(self, key: str, staged: Path) -> int:
        with self._s3.open_input_file(self._at(key)) as source, staged.open("wb") as target:
            shutil.copyfileobj(source, target, READ_BYTES)
            return int(source.size())

    def _make_room(self) -> None:
        """Remove the copies that were opened longest ago, beyond what may lie here."""
        if not self._tidying.acquire(blocking=False):
            return
        try:
            copies = []
            folders = (self.root / kind for kind in (*KINDS, VISITS))
            for path in (found for folder in folders for found in folder.rglob("*")):
                with suppress(OSError):
                    if path.is_file():
                        status = path.stat()
                        copies.append((status.st_mtime, status.st_size, path))
            size = sum(one[1] for one in copies)
            for written_s, size_bytes, path in sorted(copies):
                if size <= self._cache_bytes or time.time() - written_s < IN_USE_S:
                    return
                with suppress(OSError):
                    path.unlink()
                    size -= size_bytes
        finally:
            self._tidying.release()

    @contextmanager
    def _asking(self, lost: str) -> Iterator[None]:
        """Turn what the bucket refuses into ObjectsAway. lost: a sentence's start."""
        try:
            yield
        except FileNotFoundError:
            raise
        except OSError as error:
            raise self._refusal(error, lost) from error

    @contextmanager
    def _writing(self, lost: str) -> Iterator[None]:
        """As `_asking`, and the watch notes how a write went."""
        try:
            yield
        except OSError as error:
            if error.errno is not None and not isinstance(error, FileNotFoundError):
                raise self.watch.refused(PART, error, lost) from error
            refusal = self._refusal(error, lost)
            self.watch.note(PART, refusal.code)
            raise refusal from error
        self.watch.worked(PART)

    def _refusal(self, error: OSError, lost: str) -> ObjectsAway:
        said = str(error)
        code = BUCKET_REFUSES if any(word in said for word in REFUSALS) else BUCKET_UNREACHABLE
        return ObjectsAway(f"{lost}: {self.where}: {WORDS[code]}. {said}", code)
