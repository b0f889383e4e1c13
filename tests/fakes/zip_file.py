"""ZIP files by Python's own zipfile, also as a server packs them while it sends."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Mapping


class NoSeeking(io.BytesIO):
    """As a download that is packed while it is sent: sizes stand behind each file."""

    def seekable(self) -> bool:
        return False

    def seek(self, *_: int) -> int:
        raise io.UnsupportedOperation

    def tell(self) -> int:
        raise io.UnsupportedOperation


def zipped(
    files: Mapping[str, bytes], packing: int = zipfile.ZIP_DEFLATED, streamed: bool = False
) -> bytes:
    """Files by name."""
    held = NoSeeking() if streamed else io.BytesIO()
    with zipfile.ZipFile(held, "w", packing) as made:
        for name, data in files.items():
            made.writestr(name, data)
    return held.getvalue()
