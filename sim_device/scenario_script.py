"""Where a unit is in the scenario it rides: which phase, and how far into it in time and way."""

from typing import Final

from sim_device.scenario_file import ScenarioFile
from sim_device.scenario_phase import Phase

US_PER_S: Final[int] = 1_000_000


class Script:
    """A scenario being ridden from `distance_m` on the bike's own counter.

    rounds: how often its last phase has ended. stalled: numbers, from 1, of the phases given in
    metres that ran out of time first.
    """

    def __init__(self, scenario: ScenarioFile, distance_m: float) -> None:
        self.scenario = scenario
        self.rounds = 0
        self.stalled: list[int] = []
        self._index = 0
        self._passed_us = 0
        self._from_m = distance_m

    @property
    def phase(self) -> Phase:
        return self.scenario.phases[self._index]

    @property
    def over(self) -> bool:
        return self.rounds > 0 and not self.scenario.repeat

    @property
    def left_us(self) -> int:
        """Most of the time that the phase may still take."""
        return round(self.phase.seconds_max * US_PER_S) - self._passed_us

    @property
    def end_m(self) -> float | None:
        """Where on the bike's counter the phase ends; None: it ends by time."""
        return None if self.phase.metres is None else self._from_m + self.phase.metres

    def passed(self, duration_us: int, distance_m: float) -> None:
        """The bike rode on for so long, within the phase, and is there now.

        What a step of a millisecond goes too far counts towards the next phase in metres.
        """
        self._passed_us += duration_us
        end_m = self.end_m
        if end_m is not None and distance_m >= end_m:
            self._next(end_m)
        elif self.left_us <= 0:
            if end_m is not None:
                self.stalled.append(self._index + 1)
            self._next(distance_m)

    def put_back(self, before_m: float, after_m: float) -> None:
        """The bike's counter was set anew: the way into the phase stays."""
        self._from_m += after_m - before_m

    def _next(self, from_m: float) -> None:
        self._passed_us, self._from_m = 0, from_m
        self._index += 1
        if self._index == len(self.scenario.phases):
            self.rounds += 1
            self._index = 0 if self.scenario.repeat else self._index - 1
