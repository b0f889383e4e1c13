"""The text of a `.fis` file as sets and rules, each with its line. What they mean is looked at in
`mapping`.

    [System]                       MATLAB's Fuzzy Logic Toolbox, version 2 of the format
    Type='mamdani'
    [Input1]
    Range=[0 25]
    MF1='NB':'trapmf',[0 0 5 10]
    [Rules]
    1 2, 3 (1) : 1                 sets of the inputs, set of the output, weight, 1 = and
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import NoReturn

from backend.errors import FieldError, InvalidRequest

TEXT_MAX = 64 * 1024
"""Characters: five times a file of 25 rules that a tool filled with comments."""

NUMBERS_MAX = 16

_SECTION = re.compile(r"\[(System|Input([1-9])|Output([1-9])|Rules)\]", re.IGNORECASE)
_SET = re.compile(r"'([^']*)'\s*:\s*'([^']*)'\s*,\s*\[([^\]]*)\]")
_RULE = re.compile(r"([-\d.\s]+),\s*([-\d.\s]+)\(([^)]*)\)\s*:\s*(\d+)")


@dataclass(frozen=True)
class FisSet:
    """One membership function: its name, `trimf` or another kind, and its numbers."""

    label: str
    kind: str
    numbers: tuple[float, ...]
    line: int


@dataclass(frozen=True)
class FisVariable:
    """An input or the output: its universe from `low` to `high`, told in `line`, and its sets."""

    name: str
    low: float
    high: float
    sets: tuple[FisSet, ...]
    line: int


@dataclass(frozen=True)
class FisRule:
    """Sets counted from 1, negative for NOT and 0 for any. is_and: the inputs are joined by AND."""

    inputs: tuple[int, ...]
    outputs: tuple[int, ...]
    weight: float
    is_and: bool
    line: int


@dataclass(frozen=True)
class FisSystem:
    """A whole file. options: of `[System]` by lower-case name. lines: of each option."""

    options: dict[str, str]
    lines: dict[str, int]
    inputs: tuple[FisVariable, ...]
    outputs: tuple[FisVariable, ...]
    rules: tuple[FisRule, ...]


def refuse(line: int, message: str, code: str = "bad_fis") -> NoReturn:
    """Raises InvalidRequest that names the line; line 0 is the file as a whole."""
    place = f"line {line}" if line else "file"
    sentence = f"Line {line}: {message}" if line else message
    raise InvalidRequest(
        f"The .fis file cannot be used. {sentence}", code, [FieldError(place, code, sentence)]
    )


def read_fis(text: str) -> FisSystem:
    """The file in a text. Raises InvalidRequest that names the line at fault."""
    if len(text) > TEXT_MAX:
        refuse(0, f"It is longer than {TEXT_MAX} characters, which no table of 25 rules is.")
    sections = split(text)
    if "system" not in sections:
        refuse(0, "It has no [System]: it is no .fis file.")
    options, lines = {}, {}
    for number, key, value in entries(sections["system"]):
        options[key], lines[key] = unquoted(value), number
    inputs = [variable(sections[name]) for name in sorted(sections) if name.startswith("input")]
    outputs = [variable(sections[name]) for name in sorted(sections) if name.startswith("output")]
    rules = [rule(number, line) for number, line in sections.get("rules", [])[1:]]
    return FisSystem(options, lines, tuple(inputs), tuple(outputs), tuple(rules))


def split(text: str) -> dict[str, list[tuple[int, str]]]:
    """The lines of each section with their numbers, the one of its head first."""
    sections: dict[str, list[tuple[int, str]]] = {}
    now: list[tuple[int, str]] | None = None
    for number, raw in enumerate(text.removeprefix("\ufeff").splitlines(), start=1):
        line = raw.strip()
        if not line or line.startswith(("%", "#")):
            continue
        if line.startswith("[") and line.endswith("]"):
            head = _SECTION.fullmatch(line)
            if head is None:
                refuse(number, f"{line[:40]} is no section of a .fis file.")
            name = head[1].lower()
            if name in sections:
                refuse(number, f"{line[:40]} is there twice.")
            now = sections[name] = [(number, line)]
        elif now is None:
            refuse(number, "This stands before [System].")
        else:
            now.append((number, line))
    return sections


def entries(section: list[tuple[int, str]]) -> list[tuple[int, str, str]]:
    """`Key=Value` of a section: line, key in lower case, value. Raises InvalidRequest."""
    entries_by_name: dict[str, tuple[int, str, str]] = {}
    for number, line in section[1:]:
        key, equals, value = line.partition("=")
        key = key.strip().lower()
        if not equals:
            refuse(number, f"{line[:40]!r} is not of the form Name=Value.")
        if key in entries_by_name:
            refuse(number, f"{key} is there twice.")
        entries_by_name[key] = (number, key, value.strip())
    return list(entries_by_name.values())


def unquoted(value: str) -> str:
    """A text without its quotes."""
    return value[1:-1] if len(value) >= 2 and value[0] == value[-1] == "'" else value


def variable(section: list[tuple[int, str]]) -> FisVariable:
    """An input or an output. Raises InvalidRequest."""
    head, name, span, declared = section[0][0], "", None, 0
    sets: dict[int, FisSet] = {}
    for number, key, value in entries(section):
        if key == "name":
            name = unquoted(value)
        elif key == "range":
            declared, span = number, numbers(number, value.removeprefix("[").removesuffix("]"))
            if len(span) != 2 or not span[0] < span[1]:
                refuse(number, "Range is two numbers, the lower one first.")
        elif re.fullmatch(r"mf[1-9][0-9]?", key):
            match = _SET.fullmatch(value)
            if match is None:
                refuse(number, f"{value[:60]!r} is not of the form 'name':'kind',[numbers].")
            sets[int(key[2:])] = FisSet(match[1], match[2], numbers(number, match[3]), number)
    if span is None:
        refuse(head, "This variable has no Range.")
    if sorted(sets) != list(range(1, len(sets) + 1)):
        refuse(head, "The sets of this variable are not numbered MF1, MF2, and so on.")
    return FisVariable(name, span[0], span[1], tuple(sets[n] for n in sorted(sets)), declared)


def numbers(line: int, text: str) -> tuple[float, ...]:
    """Numbers between blanks or commas. Raises InvalidRequest for what is none or not finite."""
    words = text.replace(",", " ").split()
    if len(words) > NUMBERS_MAX:
        refuse(line, f"There are more than {NUMBERS_MAX} numbers.")
    values = []
    for word in words:
        try:
            number = float(word)
        except ValueError:
            refuse(line, f"{word[:40]!r} is no number.")
        if not math.isfinite(number):
            refuse(line, f"{word[:40]} is no finite number.")
        values.append(number)
    return tuple(values)


def rule(line: int, text: str) -> FisRule:
    """One rule. Raises InvalidRequest."""
    match = _RULE.fullmatch(text)
    if match is None:
        refuse(line, f"{text[:60]!r} is not of the form `1 2, 3 (1) : 1`.")
    inputs, outputs = (numbers(line, match[index]) for index in (1, 2))
    weight = numbers(line, match[3])
    if len(weight) != 1 or any(number != int(number) for number in (*inputs, *outputs)):
        refuse(line, "A rule has whole numbers for its sets, and one weight.")
    return FisRule(
        tuple(int(number) for number in inputs),
        tuple(int(number) for number in outputs),
        weight[0],
        int(match[4]) == 1,
        line,
    )
