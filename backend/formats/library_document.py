"""A document that is to be kept in the library: read whole, or refused.

It is the file that `spindle device backup` and the presets are. What a file does not know is
refused rather than dropped, so that nobody believes that it was kept; only what a backup says of
the unit it was made of is left out, because an item is of no unit.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from backend.core.fuzzy_table import FuzzyTable
from backend.errors import FieldError, InvalidRequest
from firmware_protocol._generated import PARAMETER_BY_NAME
from firmware_protocol.configuration_check import FAMILY, faults_of
from firmware_protocol.configuration_file import (
    CONFIGURATION,
    TABLE,
    BadConfigurationFile,
    ConfigurationFile,
    Entry,
    read,
)
from firmware_protocol.parameter_values import in_one_spelling

NAME_MAX = 80
COMMENT_MAX = 2000
FIELDS = {"format", "version", "name", "comment", "family", "parameters"}
OF_A_UNIT = {"identity", "unit_key", "generation", "crc32"}


def library_document(saved: object) -> dict[str, Any]:
    """The document as it is kept. saved: what its JSON says.

    Raises InvalidRequest with every fault named; nothing of such a document is of use.
    """
    try:
        file = read(saved)
    except BadConfigurationFile as error:
        raise InvalidRequest(f"The document cannot be kept: {error}.", "bad_document") from None
    assert isinstance(saved, dict)
    file = replace(in_our_spelling(file), name=tidy_name(file.name))
    faults = [*faults_of_words(file), *unknown_fields(saved)]
    faults += [FieldError(fault.field, fault.code, fault.message) for fault in faults_of(file)]
    if faults:
        listed = " ".join(fault.message for fault in faults[:3])
        more = f" and {len(faults) - 3} more." if len(faults) > 3 else ""
        message = f"The document cannot be kept: {listed}{more}"
        raise InvalidRequest(message, "bad_document", faults)
    return file.to_json()


def table_document(name: str, comment: str, table: FuzzyTable) -> dict[str, Any]:
    """A table as the document that is kept. Raises InvalidRequest for a name that cannot be."""
    return document_of(TABLE, name, comment, table.to_parameters())


def settings_document(name: str, comment: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """Some parameters by registry name as the document that is kept. Raises InvalidRequest."""
    return document_of(CONFIGURATION, name, comment, values)


def document_of(kind: str, name: str, comment: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """Values as a document of a kind."""
    entries = {
        parameter: Entry(value, PARAMETER_BY_NAME[parameter].unit)
        for parameter, value in values.items()
    }
    return library_document(ConfigurationFile(kind, name, comment, FAMILY, entries).to_json())


def tidy_name(name: str) -> str:
    """One spelling for what looks the same, without blanks around it."""
    return unicodedata.normalize("NFC", name).strip()


def in_our_spelling(file: ConfigurationFile) -> ConfigurationFile:
    """The file with every choice in its one spelling."""
    if file.family != FAMILY:
        return file
    values = in_one_spelling(file.values)
    entries = {name: replace(old, value=values[name]) for name, old in file.parameters.items()}
    return replace(file, parameters=entries)


def faults_of_words(file: ConfigurationFile) -> Iterator[FieldError]:
    """What is wrong with the name and the comments."""
    if not 1 <= len(file.name) <= NAME_MAX or not file.name.isprintable():
        message = f"A name has 1 to {NAME_MAX} characters that can be seen."
        yield FieldError("name", "bad_name", message)
    comments = {"comment": file.comment}
    comments |= {f"parameters.{name}.comment": e.comment for name, e in file.parameters.items()}
    for field, comment in comments.items():
        if len(comment) > COMMENT_MAX:
            message = f"{field} is longer than {COMMENT_MAX} characters."
            yield FieldError(field, "too_long", message)


def unknown_fields(saved: dict[str, Any]) -> Iterator[FieldError]:
    """What no document has."""
    for name in sorted(str(key) for key in set(saved) - FIELDS - OF_A_UNIT):
        yield FieldError(name[:NAME_MAX], "unknown", f"{name[:NAME_MAX]} is no part of a document.")
