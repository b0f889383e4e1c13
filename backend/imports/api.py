"""Files on their way to becoming rides: resumable (tus 1.0.0), or whole in one request.

The tus specification gives the statuses: an offset that does not match is 409, a checksum that
does not match 460, one that cannot be read or is of another algorithm 400, a version we do not
speak 412, an upload that has gone 404. A part longer than what is left of its file is 413, as for
a file that is too large, and nothing of it is kept. `Upload-Expires` says until when an unfinished
upload is waited for.
"""

from __future__ import annotations

import asyncio
import base64
import hashlib
import hmac
import re
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from email.utils import formatdate
from typing import Annotated, Any

from fastapi import APIRouter, Header, HTTPException, Query, Request, Response
from fastapi.concurrency import run_in_threadpool
from pydantic import BeforeValidator

from backend.core.person import Sender
from backend.errors import BadFile, InvalidRequest
from backend.imports.models import Upload, UploadList
from backend.imports.service import Uploads
from backend.rides.models import Ride
from backend.rides.service import Rides
from backend.web.permissions import SenderOf, WhoseFiles
from backend.web.problem import problem_response, refusals
from backend.web.services import provided

TUS_VERSION = "1.0.0"
TUS_EXTENSIONS = "creation,creation-with-upload,checksum,termination,expiration"
TUS_CHUNK_MEDIA_TYPE = "application/offset+octet-stream"
TUS_CHECKSUMS = ("sha256", "sha1")
SHA256 = re.compile("[0-9a-f]{64}")
CHECKSUM_MISMATCH = 460
# A chunk with a checksum is held in memory until it is checked; clients use 0.25 to 1 MiB.
CHECKED_CHUNK_BYTES_MAX = 16 * 1024 * 1024

HEADERS = {
    name: {"description": words, "schema": {"type": kind}}
    for name, words, kind in (
        ("Location", "Of the upload; its parts are sent there.", "string"),
        ("Upload-Offset", "Bytes that have arrived.", "integer"),
        ("Upload-Length", "Bytes of the whole file.", "integer"),
        ("Upload-Expires", "Until when an unfinished upload is waited for.", "string"),
    )
}
MISMATCH: dict[int | str, dict[str, Any]] = {
    CHECKSUM_MISMATCH: {"description": "The part has not the digest it was sent with."}
}


def answered_with(*names: str) -> dict[str, Any]:
    """An answer of headers alone, for the description."""
    return {"headers": {name: HEADERS[name] for name in names}}


router = APIRouter(tags=["uploads"], responses=refusals(400, 404, 409, 412, 413, 415))
TheUploads = Annotated[Uploads, provided("uploads")]
TheRides = Annotated[Rides, provided("rides")]
UploadChecksum = Annotated[
    str | None, Header(max_length=200, description="Of the part in this request's body.")
]


def digits(text: object) -> object:
    """A number of bytes as tus writes it; `+5` and `5.0` are none. Raises ValueError."""
    if isinstance(text, str) and not (text.isascii() and text.isdecimal()):
        raise ValueError("is no number of bytes: digits only")
    return text


ByteCount = Annotated[int, Header(ge=0, le=2**53), BeforeValidator(digits)]
FileName = Annotated[str, Query(min_length=1, max_length=255, description="The file's own name.")]


@router.post("/rides/import", operation_id="import_ride", response_model=Upload)
async def import_ride(
    name: FileName, request: Request, uploads: TheUploads, sender: SenderOf
) -> Any:
    """A whole file as the request's body; answers when it has become a ride or been refused."""
    length = _declared_length(request)
    upload = await _begin(uploads, sender, name, length)
    with suppress(BadFile):
        await _append_stream(uploads, upload.id, 0, request.stream())
    return await run_in_threadpool(uploads.get, upload.id)


@router.post("/rides/sample", operation_id="sample_ride", response_model=Ride)
def make_sample_ride(
    rides: TheRides,
    sender: SenderOf,
    make: Annotated[Callable[[Sender], int], provided("sample_ride")],
) -> Any:
    """A sample ride, simulated and named so; the existing one, if there is one."""
    return rides.get(make(sender))


@router.options("/uploads", operation_id="describe_uploads", status_code=204)
async def describe_uploads(request: Request) -> Response:
    """Which version and extensions of tus this server speaks, and how large a file may be."""
    return _tus_response(
        204,
        tus_version=TUS_VERSION,
        tus_extension=TUS_EXTENSIONS,
        tus_checksum_algorithm=",".join(TUS_CHECKSUMS),
        tus_max_size=str(request.app.state.upload_bytes_max),
    )


@router.post(
    "/uploads",
    operation_id="create_upload",
    status_code=201,
    response_class=Response,
    responses=MISMATCH | {201: answered_with("Location", "Upload-Offset", "Upload-Expires")},
)
async def create_upload(
    request: Request,
    uploads: TheUploads,
    sender: SenderOf,
    upload_length: ByteCount,
    upload_metadata: Annotated[str, Header(max_length=4000)] = "",
    upload_checksum: UploadChecksum = None,
    tus_resumable: Annotated[str, Header()] = "",
) -> Response:
    """Begins an upload; a body with the tus chunk type is its first part already.

    `Upload-Metadata` may name the file (`filename`), and say what the whole of it hashes to
    (`sha256`, 64 hexadecimal digits): what arrives otherwise is rejected as `hash_mismatch`.
    """
    if refusal := _version_refusal(tus_resumable):
        return refusal
    if upload_length > request.app.state.upload_bytes_max:
        limit = request.app.state.upload_bytes_max
        return problem_response(413, "too_large", f"A file may have at most {limit} bytes.")
    described = metadata(upload_metadata)
    name = described.get("filename") or described.get("name") or "upload"
    sha256 = described.get("sha256")
    if sha256 is not None and not SHA256.fullmatch(sha256):
        raise HTTPException(400, "Upload-Metadata: sha256 is 64 hexadecimal digits.")
    with_part = request.headers.get("content-type") == TUS_CHUNK_MEDIA_TYPE
    if with_part and _part_length(request) > upload_length:
        return _too_long(upload_length)
    chunks: AsyncIterator[bytes] | None = None
    if with_part and upload_checksum is not None:
        chunk = await _collected(request.stream())
        if not agrees(chunk, upload_checksum):
            return _mismatch()
        if len(chunk) > upload_length:
            return _too_long(upload_length)
        chunks = _one(chunk)
    upload = await _begin(uploads, sender, name[:255], upload_length, sha256)
    offset = 0
    if with_part:
        try:
            offset = await _append_part(uploads, upload, 0, request, chunks)
        except PartTooLong:
            await run_in_threadpool(uploads.remove, upload.id)
            return _too_long(upload_length)
        except BadFile:
            # The upload is there, and says why; the next part is refused.
            offset = (await run_in_threadpool(uploads.get, upload.id)).received
    location = str(request.url_for("get_upload", upload_id=upload.id).path)
    return _tus_response(201, location=location, upload_offset=str(offset), **_expiry(upload))


@router.head(
    "/uploads/{upload_id}",
    operation_id="get_upload_offset",
    response_class=Response,
    responses={200: answered_with("Upload-Length", "Upload-Offset", "Upload-Expires")},
)
async def get_upload_offset(upload_id: str, uploads: TheUploads) -> Response:
    """How many bytes have arrived: where to go on after a break."""
    upload = await run_in_threadpool(uploads.get, upload_id)
    headers = {"upload_offset": str(upload.received), "upload_length": str(upload.length)}
    return _tus_response(200, **headers, **_expiry(upload))


@router.patch(
    "/uploads/{upload_id}",
    operation_id="append_upload",
    status_code=204,
    responses=MISMATCH | {204: answered_with("Upload-Offset", "Upload-Expires")},
)
async def append_upload(
    upload_id: str,
    request: Request,
    uploads: TheUploads,
    upload_offset: ByteCount,
    upload_checksum: UploadChecksum = None,
    tus_resumable: Annotated[str, Header()] = "",
) -> Response:
    """The next part of a file. What arrived before a break is kept.

    422 with the upload's code when its first 4 KiB are of no ride: the rest need not be sent.
    """
    if refusal := _version_refusal(tus_resumable):
        return refusal
    if request.headers.get("content-type") != TUS_CHUNK_MEDIA_TYPE:
        return problem_response(
            415, "unsupported_media_type", f"A part is sent as {TUS_CHUNK_MEDIA_TYPE}."
        )
    upload = await run_in_threadpool(uploads.get, upload_id)
    left = upload.length - upload_offset
    if upload_offset == upload.received and _part_length(request) > left:
        return _too_long(left)
    chunks: AsyncIterator[bytes] | None = None
    if upload_checksum is not None:
        chunk = await _collected(request.stream())
        if not agrees(chunk, upload_checksum):
            return _mismatch()
        if upload_offset == upload.received and len(chunk) > left:
            return _too_long(left)
        chunks = _one(chunk)
    try:
        offset = await _append_part(uploads, upload, upload_offset, request, chunks)
    except PartTooLong:
        return _too_long(left)
    return _tus_response(204, upload_offset=str(offset), **_expiry(upload, offset))


@router.get("/uploads", operation_id="list_uploads", response_model=UploadList)
def list_uploads(
    uploads: TheUploads,
    whose: WhoseFiles,
    limit: Annotated[int, Query(ge=1, le=500)] = 50,
    cursor: Annotated[str | None, Query(max_length=64)] = None,
    part_of: Annotated[str | None, Query(max_length=64)] = None,
    sha256: Annotated[str | None, Query(pattern="^[0-9a-f]{64}$")] = None,
) -> Any:
    """Every file that came, the latest first: also those that were refused and can be removed.

    Those within a container are listed with `part_of`, its upload. With `sha256` only files of
    these bytes: whether one is here already is known before it is sent, and one of which they are
    declared goes on where it stands.

    A key that sees no rides is shown what it sent itself.
    """
    return uploads.list(limit, cursor, part_of, sha256, whose)


@router.get("/uploads/{upload_id}", operation_id="get_upload", response_model=Upload)
async def get_upload(upload_id: str, uploads: TheUploads) -> Any:
    """Where a file stands, and which rides it became."""
    return await run_in_threadpool(uploads.get, upload_id)


@router.delete("/uploads/{upload_id}", operation_id="delete_upload", status_code=204)
async def delete_upload(upload_id: str, uploads: TheUploads) -> Response:
    """Removes an upload that no ride came from, and its bytes: unfinished, rejected or a copy.

    An original lives as long as a ride that came from it: 409 names these rides, and the file goes
    with the last of them. One that is being read is 409 `being_read` until then; one that only
    waits for its turn goes, and whoever sent it and waits is told 404. Uploads without rides also
    go by themselves when their time is over.
    """
    await run_in_threadpool(uploads.remove, upload_id, audited=True)
    return _tus_response(204)


def metadata(text: str) -> dict[str, str]:
    """`Upload-Metadata`: comma-separated pairs of a key and a base64 value.

    Raises: HTTPException 400, if a value is not base64 of UTF-8.
    """
    pairs: dict[str, str] = {}
    for pair in filter(None, (part.strip() for part in text.split(","))):
        key, _, value = pair.partition(" ")
        try:
            # Neither SQL nor a file system takes a name with a zero in it.
            pairs[key] = base64.b64decode(value, validate=True).decode().replace("\0", "")
        except ValueError:
            raise HTTPException(
                400, f"Upload-Metadata: the value of {key[:40]!r} is not base64 of UTF-8 text."
            ) from None
    return pairs


def agrees(part: bytes, upload_checksum: str) -> bool:
    """Whether a part has the digest of `Upload-Checksum: sha256 BASE64`.

    Raises: HTTPException 400, for an algorithm that is not offered and a value that is no digest.
    """
    algorithm, expected = checksum(upload_checksum)
    digest = hashlib.new(algorithm, part, usedforsecurity=False).digest()
    return hmac.compare_digest(digest, expected)


def checksum(text: str) -> tuple[str, bytes]:
    """Algorithm and digest of `Upload-Checksum`. Raises: HTTPException 400."""
    algorithm, _, value = text.partition(" ")
    algorithm = algorithm.lower()
    if algorithm not in TUS_CHECKSUMS:
        raise HTTPException(400, f"Upload-Checksum: use one of {', '.join(TUS_CHECKSUMS)}.")
    try:
        digest = base64.b64decode(value, validate=True)
    except ValueError:
        raise HTTPException(400, "Upload-Checksum: the value is not base64.") from None
    length = hashlib.new(algorithm, usedforsecurity=False).digest_size
    if len(digest) != length:
        raise HTTPException(
            400, f"Upload-Checksum: a digest of {algorithm} has {length} bytes, not {len(digest)}."
        )
    return algorithm, digest


class PartTooLong(Exception):
    """A part without a declared length went beyond its file's end; nothing of it was kept."""


async def _append_part(
    uploads: Uploads,
    upload: Any,
    offset: int,
    request: Request,
    chunks: AsyncIterator[bytes] | None = None,
) -> int:
    """Add a part of a tus upload; the new offset.

    Of one whose length is declared, and was compared, every piece is kept as it arrives. Another
    is collected first: only its end tells whether it fits.
    """
    if chunks is None:
        chunks = request.stream()
        if "content-length" not in request.headers:
            chunks = _one(await _fitting(chunks, upload.length - offset))
    return await _append_stream(uploads, upload.id, offset, chunks)


async def _fitting(chunks: AsyncIterator[bytes], left: int) -> bytes:
    """A whole part in memory. Raises PartTooLong, InvalidRequest."""
    body = bytearray()
    async for chunk in chunks:
        body += chunk
        if len(body) > left:
            raise PartTooLong
        if len(body) > CHECKED_CHUNK_BYTES_MAX:
            raise InvalidRequest(
                "A part without Content-Length may have at most "
                f"{CHECKED_CHUNK_BYTES_MAX} bytes: say its length."
            )
    return bytes(body)


def _part_length(request: Request) -> int:
    """The declared length of a part, 0 where it is not declared."""
    text = request.headers.get("content-length", "0")
    return int(text) if text.isdecimal() else 0


def _too_long(left: int) -> Response:
    detail = f"The part is longer than the {left} bytes its file still lacks: nothing was kept."
    return problem_response(413, "too_long", detail, headers=_tus_headers())


def _mismatch() -> Response:
    return Response("Checksum Mismatch", CHECKSUM_MISMATCH, _tus_headers())


def _expiry(upload: Any, received: int | None = None) -> dict[str, str]:
    """`Upload-Expires` of an upload that has not arrived, as RFC 9110 writes a time."""
    offset = upload.received if received is None else received
    if upload.expires_us is None or offset >= upload.length:
        return {}
    return {"upload_expires": formatdate(upload.expires_us // 1_000_000, usegmt=True)}


async def _begin(
    uploads: Uploads, sender: Sender, name: str, length: int, sha256: str | None = None
) -> Any:
    """A new upload; a file without bytes has arrived with it."""
    upload = await run_in_threadpool(uploads.begin, name, length, sha256, sender=sender)
    if length == 0:
        await _add(uploads, upload.id, 0, b"")
    return upload


async def _append_stream(
    uploads: Uploads, upload_id: str, offset: int, chunks: AsyncIterator[bytes]
) -> int:
    """Hands over what arrives piece by piece, so that a break loses nothing; the new offset."""
    try:
        async for chunk in chunks:
            if chunk:
                offset = await _add(uploads, upload_id, offset, chunk)
    except BadFile:
        # Who is still sending would not hear the answer: what comes is read, and kept nowhere.
        async for _ in chunks:
            pass
        raise
    return offset


async def _add(uploads: Uploads, upload_id: str, offset: int, data: bytes) -> int:
    """Add bytes, and with the last one wait until the file is read, on no thread meanwhile."""
    arrival = await run_in_threadpool(uploads.add, upload_id, offset, data)
    if arrival.reading is not None:
        await asyncio.wrap_future(arrival.reading)
    return arrival.offset


async def _collected(chunks: AsyncIterator[bytes]) -> bytes:
    body = bytearray()
    async for chunk in chunks:
        body += chunk
        if len(body) > CHECKED_CHUNK_BYTES_MAX:
            raise InvalidRequest(
                f"A part with a checksum may have at most {CHECKED_CHUNK_BYTES_MAX} bytes."
            )
    return bytes(body)


async def _one(chunk: bytes) -> AsyncIterator[bytes]:
    yield chunk


def _declared_length(request: Request) -> int:
    text = request.headers.get("content-length", "")
    if not text.isdecimal():
        raise InvalidRequest("Say the file's size with Content-Length, or use POST /uploads.")
    return int(text)


def _version_refusal(version: str) -> Response | None:
    if version == TUS_VERSION:
        return None
    detail = f"This server speaks tus {TUS_VERSION}; send Tus-Resumable: {TUS_VERSION}."
    return problem_response(412, "tus_version", detail, headers={"tus-version": TUS_VERSION})


def _tus_headers(**more: str) -> dict[str, str]:
    named = {name.replace("_", "-"): value for name, value in more.items()}
    return {"tus-resumable": TUS_VERSION, "cache-control": "no-store", **named}


def _tus_response(code: int, **headers: str) -> Response:
    return Response(status_code=code, headers=_tus_headers(**headers))
