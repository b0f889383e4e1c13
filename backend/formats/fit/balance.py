"""The share of each leg, which FIT has in one number together with the side it is of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from backend.formats.own_channels import Column

# The highest bit: the share is of the right leg.
BALANCE, RIGHT_LEG, RIGHT = "left_right_balance", "right_leg", 0x80


def with_leg(columns: Mapping[str, Column]) -> dict[str, Column]:
    """Columns in which the share of the right leg is a number of its own.

    FIT has share and side in one number; where it does not know the side, that number stays.
    """
    told = columns.get(BALANCE)
    if told is None:
        return dict(columns)
    raw = told.values
    right = np.nan_to_num(raw).astype(np.int64) & RIGHT != 0
    share = np.where(right, raw - RIGHT, np.nan)
    found = {**columns, BALANCE: replace(told, values=np.where(right, np.nan, raw))}
    return {**found, RIGHT_LEG: Column(share, "%")}
