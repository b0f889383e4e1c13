"""Goal: a parameter that joins a typed part of the configuration is told and taken by the API.

Method: the registry's groups beside the models of the parts that are made of their parameters.
"""

import pytest
from pydantic import BaseModel

from backend.tuning.models.law import Calibration, UnitLimits
from firmware_protocol._generated import PARAMETERS


@pytest.mark.parametrize(
    ("groups", "model"), [({"sensor"}, Calibration), ({"limits", "market"}, UnitLimits)]
)
def test_every_parameter_of_the_part_has_a_field(groups: set[str], model: type[BaseModel]) -> None:
    names = {row.name for row in PARAMETERS if row.group in groups}

    missing = sorted(names - model.model_fields.keys())

    assert missing == [], f"backend/tuning/models/law.py: {model.__name__} lacks {missing}"
