"""The unit's own C codec, called from Python so that the two can be held against each other.

The conformance tests use it and nothing else: the backend speaks through firmware_protocol.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from firmware_protocol.framing import CHECK_LENGTH, Counts
from sim_device.firmware.python._native import ffi, lib


class WireRefused(ValueError):
    """A C call answered with one of its errors; `result` is the ebl_result."""

    def __init__(self, result: int) -> None:
        super().__init__(f"The C codec answered {result}.")
        self.result = result


def _must(result: int) -> None:
    if result != lib.EBL_OK:
        raise WireRefused(result)


def encode_frame(frame: bytes) -> bytes:
    """The wire bytes of a frame, as the unit sends them."""
    capacity = lib.ebl_wire_length_max(len(frame))
    wire = ffi.new("uint8_t[]", capacity)
    length = ffi.new("size_t *")
    _must(lib.ebl_frame_encode(frame, len(frame), wire, capacity, length))
    return bytes(ffi.buffer(wire, length[0]))


def encode_frames(frames: Iterable[bytes]) -> bytes:
    """The wire bytes of many frames one after the other, with one buffer for all of them."""
    capacity = lib.ebl_wire_length_max(lib.EBL_MTU)
    wire = ffi.new("uint8_t[]", capacity)
    length = ffi.new("size_t *")
    encode, everything = lib.ebl_frame_encode, ffi.buffer(wire)
    out = bytearray()
    for frame in frames:
        _must(encode(frame, len(frame), wire, capacity, length))
        out += everything[: length[0]]
    return bytes(out)


class FrameDecoder:
    """The unit's receiver, with the interface of firmware_protocol.framing.FrameDecoder."""

    def __init__(self, mtu: int = 544) -> None:
        self._buffer = ffi.new("uint8_t[]", mtu)
        self._decoder = ffi.new("ebl_decoder *")
        lib.ebl_decoder_init(self._decoder, self._buffer, mtu)

    @property
    def stats(self) -> Counts:
        """What was counted so far."""
        counts = self._decoder.counts
        return Counts(counts.frames_ok, counts.crc_errors, counts.cobs_errors, counts.overflows)

    def feed(self, data: bytes) -> list[bytes]:
        """The good frames that end in `data`, without their check values."""
        source = ffi.from_buffer("uint8_t[]", data)
        frame = ffi.new("const uint8_t **")
        length = ffi.new("size_t *")
        frames = []
        at = 0
        while at < len(data):
            at += lib.ebl_decoder_feed(self._decoder, source + at, len(data) - at, frame, length)
            if frame[0] != ffi.NULL:
                frames.append(bytes(ffi.buffer(frame[0], length[0])))
        return frames


@dataclass(frozen=True, slots=True)
class Header:
    """What ebl_header holds after a check."""

    kind: int
    flags: int
    tag: int
    word: int
    payload: bytes


def check_frame(frame: bytes) -> tuple[int, Header]:
    """The unit's verdict on a frame (ebl_result) and the header it read."""
    source = ffi.from_buffer("uint8_t[]", frame)
    header = ffi.new("ebl_header *")
    result = lib.ebl_frame_check(header, source, len(frame))
    payload = b""
    if header.payload != ffi.NULL:
        payload = bytes(ffi.buffer(header.payload, header.payload_length))
    return result, Header(header.kind, header.flags, header.tag, header.word, payload)


def copy_message(struct_name: str, payload: bytes) -> bytes:
    """The payload read into the C struct (`ebl_hello_request`) and written out again.

    Raises WireRefused if the payload is too short.
    """
    layout = getattr(lib, f"{struct_name}_layout")
    source = ffi.from_buffer("uint8_t[]", payload)
    message: Any = ffi.new(f"{struct_name} *")
    _must(lib.ebl_layout_get(layout, message, source, len(payload)))
    target = ffi.new("uint8_t[]", len(payload) + CHECK_LENGTH)
    length = ffi.new("size_t *")
    _must(lib.ebl_layout_put(layout, message, target, len(target), length))
    return bytes(ffi.buffer(target, length[0]))


def read_message(struct_name: str, payload: bytes) -> dict[str, Any]:
    """The fields the C struct holds after reading `payload`; byte arrays and tails as hex.

    Raises WireRefused if the payload is too short.
    """
    layout = getattr(lib, f"{struct_name}_layout")
    source = ffi.from_buffer("uint8_t[]", payload)
    message: Any = ffi.new(f"{struct_name} *")
    _must(lib.ebl_layout_get(layout, message, source, len(payload)))
    fields: dict[str, Any] = {}
    for name, column in ffi.typeof(struct_name).fields:
        value = getattr(message, name)
        if column.type.kind == "pointer":
            fields[name] = bytes(ffi.buffer(value, getattr(message, f"{name}_length"))).hex()
        elif column.type.kind == "array":
            bytewise = column.type.item.cname == "uint8_t"
            fields[name] = bytes(ffi.buffer(value)).hex() if bytewise else list(value)
        elif not name.endswith("_length") or name.removesuffix("_length") not in fields:
            fields[name] = value
    return fields


def default_image() -> bytes:
    """The image of the unit's factory configuration."""
    config = ffi.new("ebl_config *")
    lib.ebl_config_default(config)
    image = ffi.new("uint8_t[]", lib.EBL_IMAGE_LENGTH)
    lib.ebl_config_pack(config, image)
    return bytes(ffi.buffer(image))


def copy_image(image: bytes) -> bytes:
    """An image unpacked into ebl_config and packed again."""
    config = ffi.new("ebl_config *")
    lib.ebl_config_unpack(config, ffi.from_buffer("uint8_t[]", image))
    copy = ffi.new("uint8_t[]", lib.EBL_IMAGE_LENGTH)
    lib.ebl_config_pack(config, copy)
    return bytes(ffi.buffer(copy))


def image_violations(image: bytes, capacity: int = 255) -> list[tuple[int, int, int]]:
    """What the unit refuses about an image: parameter id, element, ebl_violation."""
    found = ffi.new("ebl_refusal[]", capacity)
    count = lib.ebl_image_violations(ffi.from_buffer("uint8_t[]", image), found, capacity)
    return [(row.id, row.index, row.code) for row in found[0 : min(count, capacity)]]


def band_holds(number: int, image: bytes) -> bool:
    """Whether the unit finds an image's value inside the band of this number."""
    return bool(lib.ebl_band_holds(lib.ebl_bands + number, ffi.from_buffer("uint8_t[]", image)))


def channel_counts(scale: float, value: float) -> int:
    """The telemetry count of a value, -32768 for none."""
    counts: int = lib.ebl_channel_counts(scale, value)
    return counts


def schema() -> tuple[bytes, bytes]:
    """The hash and the compressed schema the unit carries."""
    return bytes(ffi.buffer(lib.ebl_schema_hash)), bytes(ffi.buffer(lib.ebl_schema))
