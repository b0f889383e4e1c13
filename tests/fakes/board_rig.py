"""Moves the tests of the unit's C to an emulated microcontroller: what pytest --unit=qemu does.

A test reaches the unit through `lib`, or through the modules `wire` and `law`. Here all three get
the board's in place of the host's; the tests stay as they are.
"""

from __future__ import annotations

import sys

from sim_device.firmware.python import _native, law, wire
from tests.fakes.board_calls import Board, BoardLib
from tests.fakes.board_wire import BoardWire

WIRE_FUNCTIONS = (
    "encode_frame",
    "encode_frames",
    "FrameDecoder",
    "check_frame",
    "copy_message",
    "read_message",
    "default_image",
    "copy_image",
    "image_violations",
    "band_holds",
    "channel_counts",
    "schema",
)

# QEMU takes about 40 us for a byte that comes in: tests by volume do less of the same here.
ROUNDS_MAX = 150


class Rig:
    """One board for all tests of a run."""

    def __init__(self) -> None:
        self._board = Board()
        self._lib = BoardLib(self._board)

    def take_over(self) -> None:
        """Every module of the tests that has the host's `lib` gets the board's."""
        on_board = BoardWire(self._board)
        for name in WIRE_FUNCTIONS:
            setattr(wire, name, getattr(on_board, name))
        modules = [law, *(module for name, module in sys.modules.items() if "test" in name)]
        for module in modules:
            if getattr(module, "ROUNDS", 0) > ROUNDS_MAX:
                module.__dict__["ROUNDS"] = ROUNDS_MAX
            if getattr(module, "lib", None) is _native.lib and module.__name__ not in OWN:
                module.__dict__["lib"] = self._lib

    def close(self) -> None:
        self._board.close()


# They speak to both.
OWN = ("tests.fakes.board_calls", "tests.fakes.board_wire")
