"""Goal: of a photograph its picture is kept, upright and bounded, and nothing else that was in the
file; what is no photograph is refused.

Method: pictures written by Pillow with what cameras add, the bytes of the result searched for it;
headers that lie, cut and flipped bytes.
"""

from __future__ import annotations

import hashlib
import io
import random
import struct
import zlib
from datetime import UTC, datetime

import pytest
from PIL import ExifTags, Image

from backend.errors import InvalidRequest
from backend.visits.photos import SIDE_PX_MAX, drawn_anew, require_as_drawn
from backend.visits.types import VisitPhoto
from tests import counts
from tests.unit.visits.kept_visits import picture

# Pillow says of damaged pictures what it met.
pytestmark = pytest.mark.filterwarnings("ignore::UserWarning", "ignore::RuntimeWarning")

HIDDEN = b"behind the picture"
CAMERA, COMMENT, PLACE = b"PhoneMaker 12", b"taken at home", (48.137, 11.575)


def as_file(image: Image.Image, kind: str, **how: object) -> bytes:
    file = io.BytesIO()
    image.save(file, kind, **how)
    return file.getvalue()


def of_a_camera() -> Image.Exif:
    """EXIF as a phone writes it: its name, how it was held, where it was."""
    exif = Image.Exif()
    exif[ExifTags.Base.Make] = CAMERA.decode()
    exif[ExifTags.Base.Orientation] = 6
    where = exif.get_ifd(ExifTags.IFD.GPSInfo)
    where[ExifTags.GPS.GPSLatitudeRef], where[ExifTags.GPS.GPSLongitudeRef] = "N", "E"
    where[ExifTags.GPS.GPSLatitude] = (PLACE[0], 0.0, 0.0)
    where[ExifTags.GPS.GPSAreaInformation] = b"Hauptstrasse 5"
    return exif


@pytest.mark.parametrize("kind", ["JPEG", "PNG", "WEBP"])
def test_nothing_is_left_of_what_a_camera_wrote(kind: str) -> None:
    image = Image.new("RGB", (40, 30), "white")
    with_words = as_file(image, kind, exif=of_a_camera(), comment=COMMENT, icc_profile=HIDDEN)
    assert CAMERA in with_words
    assert b"Hauptstrasse" in with_words

    jpeg, _, _ = drawn_anew(with_words + HIDDEN)

    for words in (CAMERA, COMMENT, HIDDEN, b"Hauptstrasse", b"Exif", b"ICC_PROFILE", b"http"):
        assert words not in jpeg
    with Image.open(io.BytesIO(jpeg)) as drawn:
        assert not drawn.getexif()
        assert drawn.info.keys() <= {"jfif", "jfif_version", "jfif_unit", "jfif_density"}


@pytest.mark.parametrize(
    ("orientation", "corner"),
    [(1, "tl"), (2, "tr"), (3, "br"), (4, "bl"), (5, "tl"), (6, "tr"), (7, "br"), (8, "bl")],
)
def test_a_photograph_stands_upright(orientation: int, corner: str) -> None:
    """The red corner is the first pixel of the file; where it belongs, EXIF 2.32, 4.6.4 A says."""
    image = Image.new("RGB", (64, 32), "blue")
    image.paste("red", (0, 0, 16, 16))
    exif = Image.Exif()
    exif[ExifTags.Base.Orientation] = orientation

    jpeg, width_px, height_px = drawn_anew(as_file(image, "PNG", exif=exif))

    assert (width_px, height_px) == ((64, 32) if orientation < 5 else (32, 64))
    with Image.open(io.BytesIO(jpeg)) as drawn:
        x = 4 if corner[1] == "l" else width_px - 5
        y = 4 if corner[0] == "t" else height_px - 5
        pixel = drawn.getpixel((x, y))
    assert isinstance(pixel, tuple)
    assert pixel[0] > 200
    assert pixel[2] < 60


@pytest.mark.parametrize("size", [(4000, 3000), (3000, 4000), (1600, 10), (5, 5)])
def test_a_photograph_is_bounded_and_keeps_its_shape(size: tuple[int, int]) -> None:
    _, width_px, height_px = drawn_anew(picture(size=size))

    assert max(width_px, height_px) == min(max(size), SIDE_PX_MAX)
    assert width_px / height_px == pytest.approx(size[0] / size[1], rel=0.01)


@pytest.mark.parametrize("mode", ["L", "P", "RGBA", "CMYK", "I;16", "1"])
def test_pictures_of_every_kind_of_colour_are_taken(mode: str) -> None:
    kind = "JPEG" if mode == "CMYK" else "PNG"

    assert drawn_anew(as_file(Image.new(mode, (8, 6)), kind))[1:] == (8, 6)


def huge_png(width_px: int, height_px: int) -> bytes:
    """A PNG of a few bytes that claims a size."""

    def chunk(kind: bytes, body: bytes) -> bytes:
        checked = struct.pack(">I", zlib.crc32(kind + body))
        return struct.pack(">I", len(body)) + kind + body + checked

    header = chunk(b"IHDR", struct.pack(">IIBBBBB", width_px, height_px, 8, 2, 0, 0, 0))
    rows = chunk(b"IDAT", zlib.compress(bytes(1_000_000)))
    return b"\x89PNG\r\n\x1a\n" + header + rows + chunk(b"IEND", b"")


@pytest.mark.parametrize("side_px", [8_000, 10_000, 50_000, 2**31 - 1])
def test_a_picture_that_becomes_too_large_is_refused_before_it_is_drawn(side_px: int) -> None:
    with pytest.raises(InvalidRequest) as refused:
        drawn_anew(huge_png(side_px, side_px))

    assert refused.value.fields[0].code in ("too_large", "no_picture")


NO_PICTURES = {
    "nothing": b"",
    "words": b"no picture at all",
    "an SVG": b'<svg xmlns="http://www.w3.org/2000/svg"><script>alert(1)</script></svg>',
    "a GIF": as_file(Image.new("P", (4, 4)), "GIF"),
    "a TIFF": as_file(Image.new("RGB", (4, 4)), "TIFF"),
    "a cut JPEG": picture()[:-200],
    "half a header": picture()[:10],
    "a cut PNG": as_file(Image.effect_noise((64, 64), 50), "PNG")[:-900],
}


@pytest.mark.parametrize("data", NO_PICTURES.values(), ids=NO_PICTURES)
def test_what_is_no_photograph_is_refused(data: bytes) -> None:
    with pytest.raises(InvalidRequest) as refused:
        drawn_anew(data)

    assert [field.code for field in refused.value.fields] == ["no_picture"]


@pytest.mark.parametrize("kind", ["JPEG", "PNG", "WEBP"])
@pytest.mark.large_count
def test_no_damage_does_more_than_refuse_a_photograph(kind: str) -> None:
    numbers = random.Random(kind)
    image = Image.effect_noise((32, 24), 50).convert("RGB")
    sound = as_file(image, kind, exif=of_a_camera())
    refused = 0
    for _ in range(counts.of(2000)):
        data = bytearray(sound)
        for _ in range(numbers.choice((1, 3, 9))):
            data[numbers.randrange(min(len(data), 600))] = numbers.randrange(256)
        del data[numbers.choice((len(data), numbers.randrange(len(data)))) :]
        try:
            drawn_anew(bytes(data))
        except InvalidRequest:
            refused += 1
    assert refused > 0


def kept(data: bytes) -> VisitPhoto:
    """What a visit has of a photograph."""
    with Image.open(io.BytesIO(data)) as image:
        width_px, height_px = image.size
    sha256 = hashlib.sha256(data).hexdigest()
    return VisitPhoto(sha256, "a.jpg", width_px, height_px, len(data), datetime.now(UTC))


def test_what_was_drawn_here_is_taken_elsewhere_and_nothing_else() -> None:
    drawn, _, _ = drawn_anew(picture())
    require_as_drawn(drawn, kept(drawn))

    others = [
        as_file(Image.new("RGB", (40, 30)), "JPEG", exif=of_a_camera()),
        as_file(Image.new("RGB", (40, 30)), "JPEG", comment=COMMENT),
        as_file(Image.new("RGB", (1601, 30)), "JPEG"),
        as_file(Image.new("RGB", (40, 30)), "PNG"),
        drawn + HIDDEN,
    ]
    for data in others:
        with pytest.raises(InvalidRequest):
            require_as_drawn(data, kept(data))
    with pytest.raises(InvalidRequest):
        require_as_drawn(drawn[:-30] + drawn[-2:], kept(drawn))
