"""Goal: the same content has the same hash for ever: ETags, certificates and revisions are known by
it. Method: the bytes that are hashed, written out by hand."""

from __future__ import annotations

import hashlib

from backend.core.canonical_json import sha256_of


def test_the_hash_is_of_the_names_in_order_without_blanks_in_ascii() -> None:
    written = rb'{"a":{"m":true,"z":null},"b":[1,2.5,"\u00e9"]}'

    assert sha256_of({"b": [1, 2.5, "é"], "a": {"z": None, "m": True}}) == (
        hashlib.sha256(written).hexdigest()
    )
