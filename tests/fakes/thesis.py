"""The thesis's unit for tests of the law: its preset, in a market that leaves it a hard cut."""

from typing import Any

from firmware_protocol.parameters import default_config
from sim_device.preset import load

THESIS: dict[str, Any] = {**default_config(), **load("thesis").values, "market": "us_class_1"}
