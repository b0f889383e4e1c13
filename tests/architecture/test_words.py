"""Goal: names are the field's terms; words that stood for too many things stay out of them.

Method: every name that Python defines (classes, functions, parameters, fields, constants) and every
one that the pages define (functions, classes, types, constants, state). Local variables of Python,
keys of stored documents and the routes' words are not looked at. The words that took their places:
`reported`, `described`, `stored`, `existing`, `requested`, `result`, `distance`, `error` and others
of docs/glossary.md.
"""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.fakes.sources import is_generated, relative, tracked

RETIRED = [
    "told",
    "asked",
    "kept",
    "came",
    "felt",
    "said",
    "beside",
    "noted",
    "keeping",
    "trouble",
    "wanted",
    "kin",
    "tells",
    "whole",
    "lose",
]
STORED_OR_WIRE = {"rows_kept"}
"""Names that a stored file, a table or a frame has."""
PYTHON = ("backend", "spindle", "sim_device", "firmware_protocol", "tools")
DEFINED = re.compile(r"\b(?:function|class|interface|type|const|let)\s+(\w+)")


def words_of(name: str) -> set[str]:
    return {word.lower() for word in re.findall(r"[A-Z]?[a-z]+|[A-Z]+", name)}


def defined_in_python(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef() | ast.AsyncFunctionDef():
                yield node.name
                yield from (one.arg for one in (*node.args.args, *node.args.kwonlyargs))
            case ast.ClassDef():
                yield node.name
                yield from constants(node.body)
            case ast.Module():
                yield from constants(node.body)


def constants(body: list[ast.stmt]) -> Iterator[str]:
    for statement in body:
        targets = statement.targets if isinstance(statement, ast.Assign) else []
        if isinstance(statement, ast.AnnAssign):
            targets = [statement.target]
        yield from (one.id for one in targets if isinstance(one, ast.Name))


def names() -> Iterator[tuple[str, Path]]:
    for path in tracked(*PYTHON):
        if path.suffix == ".py" and not is_generated(path):
            tree = ast.parse(path.read_text(encoding="utf-8"))
            yield from ((name, path) for name in defined_in_python(tree))
            yield path.stem, path
    for path in tracked("frontend/src"):
        if path.suffix in {".ts", ".svelte"} and not is_generated(path):
            yield from ((name, path) for name in DEFINED.findall(path.read_text(encoding="utf-8")))
            yield path.name.split(".")[0], path


NAMES = [(name, path, words_of(name)) for name, path in names() if name not in STORED_OR_WIRE]


@pytest.mark.parametrize("word", RETIRED)
def test_a_retired_word_is_in_no_name(word: str) -> None:
    users = {f"{relative(path)}: {name}" for name, path, words in NAMES if word in words}

    assert sorted(users) == []
