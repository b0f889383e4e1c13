"""Asking a server, and telling people what it said."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Mapping
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

from backend.core.quantities import plain
from backend.errors import (
    FieldError,
    InvalidRequest,
    LinkError,
    NoAnswer,
    RequestRefused,
    SpindleError,
    TokenNeeded,
)

if TYPE_CHECKING:
    import ssl

    import httpx

CONNECT_S = 10.0
# A unit that is slow to answer is given up by the server after a few seconds; a large file takes
# its time to be read and stored.
TRANSFER_S = 300.0


def default_server(environment: Mapping[str, str] | None = None) -> str:
    """Where a server of this machine listens unless told otherwise."""
    env = os.environ if environment is None else environment
    host = env.get("SPINDLE_HOST") or "127.0.0.1"
    scheme = "https" if env.get("SPINDLE_TLS") in ("own", "files") else "http"
    shown = "127.0.0.1" if host == "0.0.0.0" else host
    return f"{scheme}://{shown}:{env.get('SPINDLE_PORT') or 8750}"


def default_key(environment: Mapping[str, str] | None = None) -> str:
    """The key that a server with accounts asks for; empty where none is set."""
    env = os.environ if environment is None else environment
    return env.get("SPINDLE_KEY", "")


def default_ca(environment: Mapping[str, str] | None = None) -> str:
    """The file with the certificate of a server that no authority signed; empty if none is set."""
    env = os.environ if environment is None else environment
    return env.get("SPINDLE_CA", "")


class Server:
    """One server's API.

    transport: stands in for the network in tests. author: whose changes these are; the server's own
    word for it if empty. key: what is sent to a server that asks who this is. ca: a file with the
    certificate to believe; those of the public authorities if empty. Raises InvalidRequest.
    """

    def __init__(
        self,
        url: str,
        transport: httpx.BaseTransport | None = None,
        author: str = "",
        key: str = "",
        ca: str = "",
    ) -> None:
        # Verbs that ask no server start without it: it takes longer to load than all of ours.
        import httpx

        self.url = url.rstrip("/")
        headers = {"spindle-author": quote(author)} if author else {}
        if key:
            headers["authorization"] = f"Bearer {key.strip()}"
        self._client = httpx.Client(
            base_url=f"{self.url}/api/v1",
            timeout=httpx.Timeout(CONNECT_S, read=TRANSFER_S, write=TRANSFER_S),
            transport=transport,
            trust_env=False,
            verify=trusting(ca) if ca else True,
            headers=headers,
        )

    def ask(self, method: str, path: str, **request: Any) -> Any:
        """The answer's JSON, None where there is none. Raises as `response`."""
        response = self.response(method, path, **request)
        return response.json() if response.content else None

    def response(self, method: str, path: str, **request: Any) -> httpx.Response:
        """The whole response.

        Raises LinkError when no server answers, RequestRefused with every field when it refuses,
        NoAnswer when the unit did not answer the server, with the outcome of a change.
        """
        import httpx

        try:
            response = self._client.request(method, path, **request)
        except httpx.InvalidURL as error:
            raise InvalidRequest(f"{self.url} is no address of a server: {error}.") from None
        except httpx.HTTPError as error:
            if "CERTIFICATE_VERIFY_FAILED" in str(error):
                raise LinkError(
                    f"{self.url} shows a certificate that is not believed ({error}). If the server "
                    "made it, name a copy of its data/tls/certificate.pem with --ca or SPINDLE_CA."
                ) from None
            raise LinkError(
                f"No server answers at {self.url} ({error}). Start one with `spindle serve`, or "
                "name another with --server."
            ) from None
        if response.is_error:
            raise refusal(response)
        return response

    def device_id(self, name: str | None) -> str:
        """The id of the device of this id, url, unit key or serial number; of the only one if None.

        Raises RequestRefused when there is none, or several to choose from.
        """
        devices = self.ask("GET", "/devices")["items"]
        for device in devices:
            serial = (device["identity"] or {}).get("serial_number")
            names = (device["id"], device["url"], device["unit_key"], serial)
            if name is not None and name in names:
                return str(device["id"])
        if name is None and len(devices) == 1:
            return str(devices[0]["id"])
        ids = ", ".join(device["id"] for device in devices) or "none"
        question = f"There is no unit {name}" if name else "Say which unit"
        raise RequestRefused(f"{question}. The server has: {ids}.")


def trusting(ca: str) -> ssl.SSLContext:
    """TLS that believes this certificate and no other. Raises InvalidRequest."""
    import ssl

    try:
        return ssl.create_default_context(cafile=ca)
    except OSError as error:
        reason = error.strerror or error
        raise InvalidRequest(f"{ca} cannot be read as a certificate in PEM: {reason}.") from None


def refusal(response: httpx.Response) -> SpindleError:
    """What a problem+json response says, as an error."""
    try:
        problem = response.json()
        fields = [FieldError(**item) for item in problem.get("errors", [])]
        if "challenge" in problem:
            return TokenNeeded(problem["detail"], problem["challenge"], fields)
        if response.status_code == HTTPStatus.GATEWAY_TIMEOUT:
            outcome = problem.get("outcome")
            return NoAnswer(problem["detail"], problem.get("code"), fields, outcome)
        return RequestRefused(problem["detail"], problem.get("code"), fields)
    except (ValueError, KeyError, TypeError, AttributeError):
        return RequestRefused(f"The server answered {response.status_code}: {response.text[:200]}")


def write_out(content: bytes, output: Path | None) -> None:
    """Bytes to a file, which is there whole or not at all; to standard output without one.

    Raises InvalidRequest where it cannot be written.
    """
    if output is None:
        sys.stdout.buffer.write(content)
        return
    partial = output.with_name(output.name + ".part")
    try:
        partial.write_bytes(content)
        partial.replace(output)
    except OSError as error:
        raise InvalidRequest(f"{output} cannot be written: {error.strerror}.") from None


def print_json(value: Any) -> None:
    """One JSON object on standard output."""
    json.dump(value, sys.stdout, indent=2, ensure_ascii=False)
    sys.stdout.write("\n")


def print_table(rows: list[list[Any]], headings: list[str]) -> None:
    """Columns as wide as their widest cell; missing is a dash."""
    cells = [headings, *([text_of(value) for value in row] for row in rows)]
    widths = [max(len(row[column]) for row in cells) for column in range(len(headings))]
    for row in cells:
        line = "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True))
        print(line.rstrip())


def text_of(value: Any) -> str:
    """A value as a person reads it."""
    if value is None:
        return "-"
    if isinstance(value, float):
        return plain(value, 6)
    if isinstance(value, dict | list):
        return json.dumps(value, ensure_ascii=False)
    return str(value)
