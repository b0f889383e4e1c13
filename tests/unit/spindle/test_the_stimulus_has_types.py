"""Goal: what the typed client offers is what the API takes, no more and no less; a firmware team's
checker sees it.

Method: the types are compared with the API's own models.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any, Literal, Unpack, get_args, get_origin, get_type_hints

import pytest
from pydantic import BaseModel

from backend.units.simulation import (
    SimulationChange,
    SimulationFaults,
    SimulationRiderChange,
    SimulationRoadChange,
    SimulationWorkbenchChange,
)
from spindle.client import Unit
from spindle.stimulus import Faults, Rider, Road, Stimulus, Workbench
from spindle.testing import DriveUnit

ROOT = Path(__file__).resolve().parents[3]


def choices(kind: Any) -> set[str]:
    """Every text a type allows, through unions."""
    if get_origin(kind) is Literal:
        return set(get_args(kind))
    return set().union(*(choices(part) for part in get_args(kind)))


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        (Stimulus, SimulationChange),
        (Rider, SimulationRiderChange),
        (Road, SimulationRoadChange),
        (Faults, SimulationFaults),
        (Workbench, SimulationWorkbenchChange),
    ],
)
def test_names_and_choices_are_those_of_the_api(ours: type, theirs: type[BaseModel]) -> None:
    offered, taken = get_type_hints(ours), get_type_hints(theirs)

    assert set(offered) == set(theirs.model_fields)
    nested = {"rider", "road", "faults", "workbench"}
    assert all(choices(offered[name]) == choices(taken[name]) for name in set(offered) - nested)


@pytest.mark.parametrize("stimulate", [Unit.simulate, DriveUnit.simulate, DriveUnit.ride])
def test_both_units_take_it_word_by_word(stimulate: Any) -> None:
    assert get_type_hints(stimulate)["changes"] == Unpack[Stimulus]


@pytest.mark.parametrize("package", ["spindle", "backend", "sim_device", "firmware_protocol"])
def test_a_checker_outside_is_told_that_there_are_types(package: str) -> None:
    """PEP 561: without the marker a firmware team's checker takes every answer for Any."""
    shipped = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))

    assert (ROOT / package / "py.typed").is_file()
    assert "py.typed" in shipped["tool"]["setuptools"]["package-data"]["*"]
