"""Goal: whatever stands in a tus header, the answer is one of the specification's, never a 500.

Method: the application over a real store, in process; header values from hypothesis as bytes, since
a client may send any. Statuses: tus 1.0.0, core protocol, checksum and expiration.
"""

from __future__ import annotations

import base64
from collections.abc import Iterator
from email.utils import parsedate_to_datetime
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from backend.formats.outcome import rejected
from backend.imports.service import Uploads
from backend.store import Store
from tests import counts
from tests.fakes.uploading import CHUNK, TUS, UploadDesk, checksum

# A store for every test, or a crowd of requests: left out of `make test-fast`.
pytestmark = pytest.mark.slow

LENGTH = 10


@pytest.fixture
def bench(store: Store) -> UploadDesk:
    return UploadDesk(
        Uploads(store, reader=lambda path, name: rejected("unknown_format", "No ride."))
    )


@pytest.mark.parametrize(
    "value",
    [
        "sha256 é".encode("latin-1"),
        b"sha256",
        b"sha256 ???",
        b"sha256 " + base64.b64encode(b"short"),
        b"md5 " + base64.b64encode(bytes(16)),
        b"",
        b"\xff\xfe",
    ],
)
def test_a_checksum_that_is_none_is_a_400_and_keeps_nothing(
    bench: UploadDesk, value: bytes
) -> None:
    address = bench.begin(LENGTH)
    headers: dict[str, Any] = {**CHUNK, "upload-offset": "0", "upload-checksum": value}

    answer = bench.client.patch(address, headers=headers, content=b"12345")

    assert answer.status_code == 400
    assert "Upload-Checksum" in answer.json()["detail"]
    assert bench.stands(address) == 0


ODD_VALUES = [b"9" * 5000, b"-1", b"1.5", b"sha1 =", b"0x10", b"\xb2", b"filename \xc3\xa9"]
ANY_VALUE = st.binary(max_size=40).filter(lambda v: not set(v) & {0, 10, 13}) | st.sampled_from(
    [*ODD_VALUES, b"filename AA=="]
)


@pytest.mark.large_count
@settings(
    max_examples=counts.of(150),
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture],
)
@given(
    header=st.sampled_from(
        [
            "upload-length",
            "upload-metadata",
            "upload-offset",
            "upload-checksum",
            "tus-resumable",
            "content-type",
            "upload-defer-length",
        ]
    ),
    value=ANY_VALUE,
)
def test_no_value_of_a_tus_header_makes_the_server_fail(
    bench: UploadDesk, header: str, value: bytes
) -> None:
    known: dict[str, Any] = {**CHUNK, "upload-length": str(LENGTH), "upload-offset": "0"}

    created = bench.client.post("/api/v1/uploads", headers={**known, header: value}, content=b"ab")
    appended = bench.client.patch(
        bench.begin(LENGTH), headers={**known, header: value}, content=b"abcdefghij"
    )

    assert created.status_code in (201, 400, 409, 412, 413, 415, 422)
    assert appended.status_code in (204, 400, 409, 412, 413, 415, 422, 460)


def in_pieces(*pieces: bytes) -> Iterator[bytes]:
    """A body whose length nobody declares."""
    yield from pieces


@pytest.mark.parametrize("declared", [True, False])
@pytest.mark.parametrize("checked", [True, False])
def test_a_part_longer_than_its_upload_stores_nothing(
    bench: UploadDesk, declared: bool, checked: bool
) -> None:
    address = bench.begin(LENGTH)
    bench.client.patch(address, headers={**CHUNK, "upload-offset": "0"}, content=b"1234")
    body = b"567890 and more"
    headers = {**CHUNK, "upload-offset": "4"}
    if checked:
        headers |= checksum(body)

    answer = bench.client.patch(
        address, headers=headers, content=body if declared else in_pieces(body[:6], body[6:])
    )

    assert (answer.status_code, answer.json()["code"]) == (413, "too_long")
    assert bench.stands(address) == 4
    rest = bench.client.patch(address, headers={**CHUNK, "upload-offset": "4"}, content=b"567890")
    assert (rest.status_code, rest.headers["upload-offset"]) == (204, "10")


@pytest.mark.parametrize("length", ["+5", "5.0", " 5_0", "٥", "-1", "1e3", str(2**53 + 1)])
def test_a_length_is_written_in_digits(bench: UploadDesk, length: str) -> None:
    begun = TUS | {"upload-length": length.encode()}
    sent = CHUNK | {"upload-offset": length.encode()}

    created = bench.client.post("/api/v1/uploads", headers=begun)
    appended = bench.client.patch(bench.begin(LENGTH), headers=sent, content=b"1")

    assert (created.status_code, appended.status_code) == (422, 422)


def test_unfinished_uploads_are_so_many_and_no_more(
    bench: UploadDesk, store: Store, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("backend.store.uploads.UNFINISHED_MAX", 3)
    first, *_ = [bench.begin(LENGTH) for _ in range(3)]

    refused = bench.client.post("/api/v1/uploads", headers=TUS | {"upload-length": "10"})
    assert (refused.status_code, refused.json()["code"]) == (409, "uploads_full")
    assert bench.client.delete(first, headers=TUS).status_code == 204
    bench.begin(LENGTH)
    assert len(list((store.objects.root / ".spool").iterdir())) == 3


def test_a_first_part_longer_than_its_upload_begins_none(bench: UploadDesk) -> None:
    for body in (b"0123456789a", in_pieces(b"0123456789", b"a")):
        answer = bench.client.post(
            "/api/v1/uploads", headers={**CHUNK, "upload-length": "10"}, content=body
        )
        assert answer.status_code == 413

    assert bench.uploads.list()["items"] == ()


def test_the_checksum_of_a_first_part_is_compared_too(bench: UploadDesk) -> None:
    headers = CHUNK | {"upload-length": str(LENGTH)} | checksum(b"1234")

    damaged = bench.client.post("/api/v1/uploads", headers=headers, content=b"1834")
    none = bench.client.get("/api/v1/uploads").json()["items"]
    sound = bench.client.post("/api/v1/uploads", headers=headers, content=b"1234")

    assert (damaged.status_code, none) == (460, [])
    assert (sound.status_code, sound.headers["upload-offset"]) == (201, "4")


def test_an_unfinished_upload_says_until_when_it_is_waited_for(bench: UploadDesk) -> None:
    created = bench.client.post(
        "/api/v1/uploads", headers={"tus-resumable": "1.0.0", "upload-length": "10"}
    )
    address = created.headers["location"]
    appended = bench.client.patch(address, headers={**CHUNK, "upload-offset": "0"}, content=b"1")
    stands = bench.client.head(address)
    ended = bench.client.patch(
        address, headers={**CHUNK, "upload-offset": "1"}, content=b"234567890"
    )

    told = [answer.headers["upload-expires"] for answer in (created, appended, stands)]
    upload = bench.uploads.get(address.rsplit("/", 1)[-1])
    seven_days_s = upload.created_us // 1_000_000 + 7 * 86_400
    assert {int(parsedate_to_datetime(text).timestamp()) for text in told} == {seven_days_s}
    assert all(text.endswith(" GMT") for text in told)
    assert "upload-expires" not in ended.headers
    assert stands.headers["upload-length"] == "10"


def test_an_upload_given_up_is_gone(bench: UploadDesk) -> None:
    address = bench.begin(LENGTH)

    assert bench.client.delete(address, headers=TUS).status_code == 204
    assert bench.client.head(address, headers=TUS).status_code == 404


def test_another_version_of_tus_is_told_which_one_we_speak(bench: UploadDesk) -> None:
    headers = {"tus-resumable": "0.2.2", "upload-length": "10"}

    response = bench.client.post("/api/v1/uploads", headers=headers)

    assert response.status_code == 412
    assert response.headers["tus-version"] == "1.0.0"


PAGE = b"<!DOCTYPE html><html><body>502 Bad Gateway</body></html>".ljust(5000)
LARGE = TUS | {"upload-length": "200000000"}


def test_what_is_no_ride_is_refused_with_its_first_part(bench: UploadDesk) -> None:
    address = bench.begin(200_000_000, filename="ride.fit")

    answers = [
        bench.client.patch(address, headers={**CHUNK, "upload-offset": offset}, content=part)
        for offset, part in (("0", PAGE[:3000]), ("3000", PAGE[3000:]), ("5000", b"more"))
    ]

    assert [answer.status_code for answer in answers] == [204, 422, 422]
    assert {answer.json()["code"] for answer in answers[1:]} == {"unsupported_format"}
    upload = bench.verdict(address)
    told = (upload["state"], upload["code"], upload["received"])
    assert told == ("rejected", "unsupported_format", 5000)
    assert "HTML" in upload["detail"]
    assert upload["expires_at"]
    assert upload in bench.client.get("/api/v1/uploads").json()["items"]
    assert bench.client.delete(address).status_code == 204
    assert bench.client.get(address).status_code == 404
    assert bench.client.delete(address).status_code == 404


def test_a_first_part_of_no_ride_begins_an_upload_that_says_why(bench: UploadDesk) -> None:
    created = bench.client.post("/api/v1/uploads", headers={**CHUNK, **LARGE}, content=PAGE)

    assert (created.status_code, created.headers["upload-offset"]) == (201, "5000")
    assert bench.verdict(created.headers["location"])["state"] == "rejected"
