"""Backups of a unit's settings: the parameters in one, under their names and spelling of today."""

from __future__ import annotations

from typing import Any

from backend.errors import InvalidRequest
from firmware_protocol.retired import brought_forward


def parameters_of(saved: object, name: str) -> tuple[dict[str, Any], list[str]]:
    """The parameters of a backup, and in words what was made of those of an older unit.

    saved: what its JSON says. name: the file's, for people. Raises InvalidRequest if it is none.
    """
    parameters = saved.get("parameters") if isinstance(saved, dict) else None
    if not isinstance(parameters, dict):
        raise InvalidRequest(f"{name} is not a backup: it has no `parameters`.")
    return brought_forward(parameters)
