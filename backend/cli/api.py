"""`spindle api METHOD PATH [key=value ...]`: any request of the API; /docs describes them."""

from __future__ import annotations

import sys
from argparse import Namespace
from pathlib import Path
from typing import Any

from backend.cli.client import Server, print_json, print_table, text_of, write_out
from backend.cli.device import read_bytes, server_of, value_of
from backend.errors import InvalidRequest

METHODS = ("GET", "POST", "PUT", "PATCH", "DELETE", "HEAD", "OPTIONS")
WITH_BODY = frozenset({"POST", "PUT", "PATCH"})
UNIT = "{unit}"


def request(options: Namespace) -> int:
    """Send one request; print its answer, or write it to a file."""
    server = server_of(options)
    path = path_of(server, options.path, options.unit)
    query, body = fields_of(options.fields, options.method in WITH_BODY)
    sent: dict[str, Any] = {"params": query, "headers": dict(map(header, options.header))}
    if options.input is not None:
        if body:
            raise InvalidRequest("--input is the whole body: leave out key=value beside it.")
        sent["content"] = body_of(options.input)
        sent["headers"]["content-type"] = options.type
    elif options.method in WITH_BODY:
        sent["json"] = body
    response = server.response(options.method, path, **sent)
    is_json = response.content and "json" in response.headers.get("content-type", "")
    if options.output is not None or not is_json:
        write_out(response.content, options.output)
    elif options.json:
        print_json(response.json())
    else:
        print_answer(response.json())
    return 0


def header(word: str) -> tuple[str, str]:
    """Name and value of `name: value`. Raises InvalidRequest."""
    name, colon, value = word.partition(":")
    if not colon:
        raise InvalidRequest(f"{word}: write a header as name: value.")
    return name.strip(), value.strip()


def path_of(server: Server, path: str, unit: str | None) -> str:
    """The path below the API's prefix; `{unit}` in it becomes the id of the unit that is meant."""
    below = "/" + path.lstrip("/").removeprefix("api/v1/")
    return below.replace(UNIT, server.device_id(unit)) if UNIT in below else below


def fields_of(words: list[str], with_body: bool) -> tuple[list[tuple[str, str]], dict[str, Any]]:
    """Query and body of `key=value` and `key==value`; the latter is of the query whatever the
    method is, and may be repeated. `a.b=1` is `{"a": {"b": 1}}`; `@file` is what a file says.
    Raises InvalidRequest."""
    query: list[tuple[str, str]] = []
    body: dict[str, Any] = {}
    for word in words:
        key, equals, text = word.partition("=")
        if not equals or not key:
            raise InvalidRequest(f"{word}: write key=value, or key==value for the query.")
        if text.startswith("=") or not with_body:
            query.append((key, text.removeprefix("=")))
            continue
        *parents, name = key.split(".")
        place = body
        for parent in parents:
            place = place.setdefault(parent, {})
            if not isinstance(place, dict):
                raise InvalidRequest(f"{word}: {parent} has a value already, so it has no members.")
        place[name] = value_of(text_of_file(text[1:]) if text.startswith("@") else text)
    return query, body


def text_of_file(name: str) -> str:
    """What a file says; of other encodings than UTF-8 what is ASCII."""
    return read_bytes(Path(name)).decode("utf-8-sig", errors="replace")


def body_of(name: str) -> bytes:
    """A file's bytes, or standard input's."""
    return sys.stdin.buffer.read() if name == "-" else read_bytes(Path(name))


def print_answer(answer: Any, indent: str = "") -> None:
    """An answer for people: a list of things as a table, the rest as `name: value`."""
    if not isinstance(answer, dict):
        print(f"{indent}{text_of(answer)}")
        return
    for name, value in answer.items():
        if is_table(value):
            plain = [key for key in value[0] if not isinstance(value[0][key], dict | list)]
            print_table([[row.get(key) for key in plain] for row in value], plain)
        elif isinstance(value, dict) and value:
            print(f"{indent}{name}:")
            print_answer(value, indent + "  ")
        elif name != "next" or value is not None:
            print(f"{indent}{name}: {text_of(value)}")


def is_table(value: Any) -> bool:
    """Whether a value is a list of things that can stand below each other."""
    return isinstance(value, list) and bool(value) and all(isinstance(row, dict) for row in value)
