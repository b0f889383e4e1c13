"""The schema a unit carries: canonical JSON of the registry, compressed, and its hash."""

import hashlib
import re
import zlib


def schema_hash(schema: str) -> bytes:
    """The first 8 bytes of SHA-256 over the canonical JSON."""
    return hashlib.sha256(schema.encode()).digest()[:8]


def compress(schema: str, committed: str) -> bytes:
    """zlib bytes of the schema; those in the `committed` ebl_schema.c while they still fit.

    Implementations of zlib differ in the bytes they choose for one text. Keeping what is committed
    lets a machine with another zlib regenerate without a difference.
    """
    array = re.search(r"ebl_schema\[\w+\] = \{(.*?)\}", committed, flags=re.S)
    if array is not None:
        old = bytes(int(byte, 16) for byte in re.findall(r"0x([0-9a-f]{2})", array[1]))
        try:
            if zlib.decompress(old) == schema.encode():
                return old
        except zlib.error:
            return zlib.compress(schema.encode(), 9)
    return zlib.compress(schema.encode(), 9)
