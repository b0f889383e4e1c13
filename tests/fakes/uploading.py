"""The API of uploads alone over a store, in this process, and the words of tus that it is sent."""

from __future__ import annotations

import base64
import hashlib
from pathlib import Path
from typing import Any

from backend.formats import Outcome
from backend.formats.formats import read_file
from backend.imports.service import Uploads
from tests.fakes.api import api_with, client_of

TUS = {"tus-resumable": "1.0.0"}
CHUNK = TUS | {"content-type": "application/offset+octet-stream"}


def read_here(path: Path, name: str) -> Outcome:
    """Reads a file in this process, not in a child."""
    return read_file(name, path.read_bytes())


def described(**told: str) -> dict[str, str]:
    """`Upload-Metadata`."""
    pairs = [f"{key} {base64.b64encode(value.encode()).decode()}" for key, value in told.items()]
    return {"upload-metadata": ",".join(pairs)}


def checksum(part: bytes) -> dict[str, str]:
    """`Upload-Checksum` of these bytes."""
    digest = base64.b64encode(hashlib.sha256(part).digest()).decode()
    return {"upload-checksum": f"sha256 {digest}"}


class UploadDesk:
    """What a tus client does. `client` for all else."""

    def __init__(self, uploads: Uploads) -> None:
        self.uploads = uploads
        self.client = client_of(api_with(uploads=uploads))

    def begin(self, length: int, **told: str) -> str:
        """The address of a new upload. told: as Upload-Metadata has it."""
        headers = TUS | {"upload-length": str(length)} | (described(**told) if told else {})
        created = self.client.post("/api/v1/uploads", headers=headers)
        assert created.status_code == 201
        return str(created.headers["location"])

    def send(self, address: str, offset: int, data: bytes, **more: str) -> int:
        """The status of the answer to a part. more: headers."""
        headers = CHUNK | {"upload-offset": str(offset)} | more
        return int(self.client.patch(address, headers=headers, content=data).status_code)

    def stands(self, address: str) -> int:
        """How many bytes have arrived."""
        return int(self.client.head(address, headers=TUS).headers["upload-offset"])

    def verdict(self, address: str) -> dict[str, Any]:
        """What became of an upload."""
        answer: dict[str, Any] = self.client.get(address).json()
        return answer
