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
    balance = columns.get(BALANCE)
    if balance is None:
        return dict(columns)
    raw = balance.values
    right = np.nan_to_num(raw).astype(np.int64) & RIGHT != 0
    share = np.where(right, raw - RIGHT, np.nan)
    with_balance = {**columns, BALANCE: replace(balance, values=np.where(right, np.nan, raw))}
    return {**with_balance, RIGHT_LEG: Column(share, "%")}
