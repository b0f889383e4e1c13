"""Photographs as they are kept: drawn anew, so that nothing is left of what a camera wrote into
the file (place, owner, serial number) or somebody hid behind the picture."""

from __future__ import annotations

import hashlib
import io

from PIL import Image, ImageOps, UnidentifiedImageError

from backend.errors import FieldError, InvalidRequest
from backend.visits.types import VisitPhoto

# What phones and tablets make, and no format with a rare decoder.
FORMATS = ("JPEG", "PNG", "WEBP")
# A phone of today has 50; 4 bytes each while it is drawn.
PIXELS_MAX = 60_000_000
SIDE_PX_MAX = 1_600
QUALITY = 82


def drawn_anew(data: bytes) -> tuple[bytes, int, int]:
    """A photograph as JPEG, upright, its longer side 1600 px at most; with width and height.

    Raises InvalidRequest for what is no picture, or one that is too large.
    """
    try:
        with Image.open(io.BytesIO(data), formats=FORMATS) as picture:
            if picture.width * picture.height > PIXELS_MAX:
                raise refused(f"A photograph has at most {PIXELS_MAX} pixels.", "too_large")
            # A JPEG is decoded in an eighth, a quarter or a half of its size where that is enough.
            picture.draft("RGB", (SIDE_PX_MAX, SIDE_PX_MAX))
            upright = ImageOps.exif_transpose(picture).convert("RGB")
    except (UnidentifiedImageError, OSError, ValueError, SyntaxError) as error:
        message = f"This is no JPEG, PNG or WebP that can be read: {error}."
        raise refused(message, "no_picture") from error
    upright.thumbnail((SIDE_PX_MAX, SIDE_PX_MAX))
    file = io.BytesIO()
    upright.save(file, "JPEG", quality=QUALITY, optimize=True)
    return file.getvalue(), upright.width, upright.height


def require_jpeg(data: bytes, photo: VisitPhoto) -> None:
    """Raises InvalidRequest for bytes that are not the photograph which a file names."""
    if hashlib.sha256(data).hexdigest() != photo.sha256 or not data.startswith(b"\xff\xd8\xff"):
        raise refused(f"The photograph {photo.name} is not as it was.", "no_picture")


def refused(message: str, code: str) -> InvalidRequest:
    """A photograph that is not taken, and why."""
    return InvalidRequest(message, fields=[FieldError("photo", code, message)])
