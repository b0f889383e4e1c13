"""One address of a workshop, and simulated units that come onto it one after the other."""

from __future__ import annotations

from pathlib import Path
from typing import Self

from tests.fakes.server import ServerHere, eventually
from tests.fakes.simulated_unit import UnitOnPort

# Factory-fresh units whose configurations are equal to the last bit.
A = ("--seed", "11", "--scenario", "none")
B = ("--seed", "22", "--scenario", "none")


class Cable:
    """A server on one address; unit A is there from the start."""

    def __init__(self, folder: Path) -> None:
        self.unit = UnitOnPort(*A)
        self.server = ServerHere(folder, [self.unit.url]).start()
        self.device = self.server.ready_device()

    @property
    def key(self) -> str:
        """Of the unit that is there."""
        return str(self.server.get(f"/devices/{self.device}")["unit_key"])

    def plug(self, words: tuple[str, ...]) -> None:
        """Put another unit in the place of the one that is there; returns when it is ready."""
        before = self.key
        self.unit.unplug()
        self.unit = UnitOnPort(*words, port=self.unit.port)
        eventually(
            lambda: self.server.get(f"/devices/{self.device}"),
            lambda device: device["state"] == "ready" and device["unit_key"] != before,
        )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.server.stop()
        self.unit.unplug()
