"""Photographs as they are kept: drawn anew, so that nothing is left of what a camera wrote into
the file (place, owner, serial number) or somebody hid behind the picture."""

from __future__ import annotations

import hashlib
import io
from struct import error as StructError
from zlib import error as ZlibError

from PIL import ExifTags, Image

from backend.errors import FieldError, InvalidRequest
from backend.visits.types import VisitPhoto

# What phones and tablets make, and no format with a rare decoder.
FORMATS = ("JPEG", "PNG", "WEBP")
# A phone of today has 50; 4 bytes each while it is drawn.
PIXELS_MAX = 60_000_000
SIDE_PX_MAX = 1_600
QUALITY = 82
JPEG_END = b"\xff\xd9"
# What Pillow tells of a JPEG that has nothing but its picture.
OF_JFIF = {"jfif", "jfif_version", "jfif_unit", "jfif_density"}
# EXIF 2.32, 4.6.4 A: where the first row and column of the picture are.
TURNS = {
    2: Image.Transpose.FLIP_LEFT_RIGHT,
    3: Image.Transpose.ROTATE_180,
    4: Image.Transpose.FLIP_TOP_BOTTOM,
    5: Image.Transpose.TRANSPOSE,
    6: Image.Transpose.ROTATE_270,
    7: Image.Transpose.TRANSVERSE,
    8: Image.Transpose.ROTATE_90,
}
# What Pillow and its decoders raise on damage; UnidentifiedImageError is an OSError.
DAMAGE = (
    OSError,
    ValueError,
    SyntaxError,
    TypeError,
    ArithmeticError,
    LookupError,
    EOFError,
    RuntimeError,
    AttributeError,
    MemoryError,
    StructError,
    ZlibError,
    Image.DecompressionBombError,
)


def drawn_anew(data: bytes) -> tuple[bytes, int, int]:
    """A photograph as JPEG, upright, its longer side 1600 px at most; with width and height.

    Raises InvalidRequest for what is no picture, or one that is too large.
    """
    try:
        with Image.open(io.BytesIO(data), formats=FORMATS) as picture:
            require_pixels(picture)
            turn = TURNS.get(orientation_of(picture) or 0)
            # A JPEG is decoded in an eighth, a quarter or a half of its size where that is enough.
            picture.draft("RGB", (SIDE_PX_MAX, SIDE_PX_MAX))
            small = picture.convert("RGB")
    except DAMAGE as error:
        message = f"This is no JPEG, PNG or WebP that can be read: {error}."
        raise refused(message, "no_picture") from error
    small.thumbnail((SIDE_PX_MAX, SIDE_PX_MAX))
    upright = small if turn is None else small.transpose(turn)
    # The writer would take a comment along.
    upright.info.clear()
    file = io.BytesIO()
    upright.save(file, "JPEG", quality=QUALITY, optimize=True)
    return file.getvalue(), upright.width, upright.height


def require_as_drawn(data: bytes, photo: VisitPhoto) -> None:
    """Raises InvalidRequest for bytes that are not the photograph which a file names, or that
    `drawn_anew` would not have made: another format, larger, with words of a camera."""
    sound = hashlib.sha256(data).hexdigest() == photo.sha256 and len(data) == photo.size_bytes
    sound = sound and data.endswith(JPEG_END)
    try:
        with Image.open(io.BytesIO(data), formats=("JPEG",)) as picture:
            require_pixels(picture)
            sound = sound and picture.size == (photo.width_px, photo.height_px)
            sound = sound and max(picture.size) <= SIDE_PX_MAX and picture.info.keys() <= OF_JFIF
            picture.load()
    except DAMAGE:
        sound = False
    if not sound:
        raise refused(f"The photograph {photo.name} is not as it was.", "no_picture")


def require_pixels(picture: Image.Image) -> None:
    """Raises InvalidRequest for a picture that would take too much memory; nothing of it is decoded
    yet."""
    if picture.width * picture.height > PIXELS_MAX:
        raise refused(f"A photograph has at most {PIXELS_MAX} pixels.", "too_large")


def orientation_of(picture: Image.Image) -> int | None:
    """How the camera was held, as EXIF counts it; None where its words cannot be read."""
    try:
        found = picture.getexif().get(ExifTags.Base.Orientation)
    except DAMAGE:
        return None
    return found if isinstance(found, int) else None


def refused(message: str, code: str) -> InvalidRequest:
    """A photograph that is not taken, and why."""
    return InvalidRequest(message, fields=[FieldError("photo", code, message)])
