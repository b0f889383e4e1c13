"""Proposals: settings for a wish, found on the rider's own rides; nothing is written to a unit.

    waiting -> riding -> proving -> done
    any -> failed, with the reason; or cancelled

A job's rides are read and laid over their road before it is taken, so that what cannot be told is
refused at once. The search is one thread's: a second job waits for the first.
"""

from __future__ import annotations

import itertools
import math
import threading
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from backend import law
from backend.core.assist_mode import AssistModes
from backend.core.described import described
from backend.core.energy import SECONDS_PER_HOUR
from backend.core.fuzzy_table import FuzzyTable
from backend.errors import Conflict, InvalidRequest, NotFound, SpindleError
from backend.formats.library_document import settings_document
from backend.law import proposal
from backend.law.front_search import GENERATIONS, POPULATION, Tried, front_of
from backend.law.rider_and_bike import RiderAndBike
from backend.rides.replay.ride_again import twin_of
from backend.rides.settings_in_force import ConfigOf, unchanged
from backend.store import Store
from backend.tuning.limit_proof import LimitProofMaker
from backend.tuning.types import ParameterChange

JOBS_MAX = 20
WAITING_MAX = 4
RIDES_MAX = 5
SEARCH_S_MAX = 60.0
"""A search of long rides ends here with what it has; one of five minutes takes four."""
SHOWN = 6
SAME_AIM, SAME_COST_PCT = 0.004, 0.1
"""A knob that moves neither by more than this is left as it is."""
BEYOND = 2.5
"""Candidates go so many times beyond what was wished, not to the end of the knobs."""
WORDS = {
    "more_range": "range by",
    "gentler_start": "start gentler by",
    "flatter_at_the_limit": "limit flatter by",
}
RUNNING = ("waiting", "riding", "proving")


@described
class ProposalFigure:
    """Of all rides, as recorded and with the settings, as `POST /rides/{id}/again` tells them; nine
    of ten simulated rides lay between `low` and `high`."""

    before: float
    after: float
    low: float
    high: float


@dataclass(frozen=True, slots=True)
class Candidate:
    """A proposal. gained_pct: of the wish. parameters: what it sets, by registry name; document:
    the same, as the library keeps it."""

    gained_pct: float
    meets_target: bool
    recommended: bool
    battery_wh_per_km: ProposalFigure
    duration_s: ProposalFigure
    parameters: dict[str, Any]
    changed: tuple[ParameterChange, ...]
    limit_proof_sha256: str
    document: dict[str, Any]


@dataclass(frozen=True, slots=True)
class Job:
    """How far a proposal is. progress: 0 to 1. aim_before: what the wish is measured by, as it is
    now: Wh/km of the battery, or Nm/s rms at the crank."""

    id: str
    state: str
    objective: str
    target_pct: float
    knobs: tuple[str, ...]
    ride_ids: tuple[int, ...]
    config_source: str
    aim_before: float
    progress: float = 0.0
    rides_ridden: int = 0
    seconds: float = 0.0
    code: str | None = None
    detail: str | None = None
    candidates: tuple[Candidate, ...] = ()


@dataclass
class _Work:
    job: Job
    road: proposal.Road
    space: proposal.Space
    twins: Sequence[law.RoadTwin]
    config: Mapping[str, Any]
    stopped: threading.Event = field(default_factory=threading.Event)


class Proposals:
    """Jobs by id; from any thread. The newest are kept until the server ends.

    generations: how long each search is.
    """

    def __init__(
        self,
        store: Store,
        config_of: ConfigOf,
        proofs: LimitProofMaker,
        generations: int = GENERATIONS,
    ) -> None:
        self._generations = generations
        self._store = store
        self._config_of = config_of
        self._proofs = proofs
        self._lock = threading.Lock()
        self._numbers = itertools.count(1)
        self._work: dict[str, _Work] = {}
        self._pool = ThreadPoolExecutor(1, thread_name_prefix="proposals")

    def begin(
        self,
        ride_ids: Sequence[int],
        objective: str,
        knobs: Sequence[str] = proposal.KNOBS,
        target_pct: float | None = None,
        rider_and_bike: RiderAndBike | None = None,
    ) -> Job:
        """A new job. target_pct: how much is wished.

        Raises NotFound, InvalidRequest for rides that cannot be ridden again or tell nothing of
        this wish, Conflict while too many jobs wait.
        """
        if not 1 <= len(ride_ids) <= RIDES_MAX:
            raise InvalidRequest(f"Choose 1 to {RIDES_MAX} rides.", "ride_count")
        with self._lock:
            waiting = sum(work.job.state in RUNNING for work in self._work.values())
        if waiting >= WAITING_MAX:
            raise Conflict(f"{waiting} proposals are being made: wait or cancel one.", "busy")
        config, source = unchanged(self._config_of, self._store.rides.get(ride_ids[0]))
        config = {**law.law_defaults(), **config}
        twins = [self._twin(ride_id, rider_and_bike or RiderAndBike()) for ride_id in ride_ids]
        road = proposal.Road(twins, objective, config)
        space = proposal.Space(config, road.modes, knobs)
        if target_pct is None:
            target_pct = proposal.TARGET_PCT[objective]
        number = f"proposal-{next(self._numbers)}"
        job = Job(
            number,
            "waiting",
            objective,
            target_pct,
            space.knobs,
            tuple(ride_ids),
            source,
            road.before.aim,
        )
        work = _Work(job, road, space, twins, config)
        with self._lock:
            self._work[number] = work
            for old in [key for key, one in self._work.items() if one.job.state not in RUNNING]:
                if len(self._work) > JOBS_MAX:
                    del self._work[old]
        self._pool.submit(self._run, work)
        return job

    def get(self, job_id: str) -> Job:
        """How far it is. Raises NotFound."""
        return self._find(job_id).job

    def cancel(self, job_id: str) -> Job:
        """Gives a job up; one that is over stays as it is. Raises NotFound."""
        work = self._find(job_id)
        work.stopped.set()
        with self._lock:
            if work.job.state in RUNNING:
                work.job = replace(work.job, state="cancelled")
            return work.job

    def close(self) -> None:
        """Ends what runs."""
        with self._lock:
            for work in self._work.values():
                work.stopped.set()
        self._pool.shutdown(cancel_futures=True)

    def _find(self, job_id: str) -> _Work:
        with self._lock:
            work = self._work.get(job_id)
        if work is None:
            raise NotFound(f"There is no proposal {job_id}: this server keeps the newest alone.")
        return work

    def _twin(self, ride_id: int, rider_and_bike: RiderAndBike) -> law.RoadTwin:
        reader = self._store.rides.reader(ride_id)
        own = {**law.law_defaults(), **unchanged(self._config_of, reader.ride)[0]}
        return twin_of(reader, own, rider_and_bike)

    def _update(self, work: _Work, **news: Any) -> None:
        with self._lock:
            if work.job.state in RUNNING:
                work.job = replace(work.job, **news)

    def _run(self, work: _Work) -> None:
        began = time.monotonic()
        try:
            front = self._searched(work, began)
            candidates = self._proven(work, front)
            if work.stopped.is_set():
                return
            seconds = time.monotonic() - began
            if candidates:
                news = {"state": "done", "progress": 1.0, "candidates": candidates}
            else:
                detail = "Within these knobs nothing was found that is better and without a doubt."
                news = {"state": "failed", "code": "nothing_found", "detail": detail}
            self._update(work, seconds=seconds, **news)
        except SpindleError as error:
            self._update(work, state="failed", code=error.code, detail=error.message)
        except Exception:
            self._update(work, state="failed", code="internal", detail="The search broke off.")
            raise

    def _searched(self, work: _Work, began: float) -> list[Tried]:
        tried, in_all = 0, POPULATION * self._generations

        def going() -> bool:
            seconds = time.monotonic() - began
            share = 0.9 * min(1.0, max(tried / in_all, seconds / SEARCH_S_MAX))
            self._update(work, state="riding", progress=share, rides_ridden=tried, seconds=seconds)
            return not work.stopped.is_set() and seconds < SEARCH_S_MAX

        def evaluate(point: Any) -> tuple[float, float] | None:
            nonlocal tried
            tried += 1
            return scores_of(work, point)

        front = front_of(evaluate, work.space.start, going, self._generations)
        self._update(work, state="proving", rides_ridden=tried)
        return front

    def _proven(self, work: _Work, front: Sequence[Tried]) -> tuple[Candidate, ...]:
        """What is worth showing of a front: better, near to what was wished, clean, proven."""
        job, before = work.job, work.road.before.aim
        gains = [proposal.gained_pct(job.objective, before, one.scores[0]) for one in front]
        worth = [
            (gain, one)
            for gain, one in zip(gains, front, strict=True)
            if 0.1 * job.target_pct < gain <= BEYOND * job.target_pct
        ]
        proposed: list[Candidate] = []
        existing_codes = codes_of(work.config, work.space.which)
        for gain, one in nearest_first(worth, job.target_pct):
            if work.stopped.is_set() or len(proposed) == SHOWN:
                break
            one = plain(work, one)
            gain = proposal.gained_pct(job.objective, before, one.scores[0])
            changes = work.space.changes(one.point)
            if any(abs(gain - other.gained_pct) < 0.15 * job.target_pct for other in proposed):
                continue
            config = {**work.config, **changes}
            if not codes_of(config, work.space.which) <= existing_codes:
                continue
            proof = self._proofs.of(config)
            if proof.holds:
                proposed.append(self._candidate(work, gain, changes, proof.sha256))
        return recommended(sorted(proposed, key=lambda one: one.gained_pct))

    def _candidate(
        self, work: _Work, gain: float, changes: dict[str, Any], sha256: str
    ) -> Candidate:
        config = {**work.config, **changes}
        battery, duration = figures(work, config)
        return Candidate(
            gained_pct=gain,
            meets_target=gain >= work.job.target_pct - 0.05,
            recommended=False,
            battery_wh_per_km=battery,
            duration_s=duration,
            parameters=changes,
            changed=tuple(
                ParameterChange(name, work.config[name], value) for name, value in changes.items()
            ),
            limit_proof_sha256=sha256,
            document=settings_document(
                f"{WORDS[work.job.objective]} {gain:.0f} %",
                f"Proposed on {rides_words(work.job.ride_ids)}.",
                changes,
            ),
        )


def rides_words(ride_ids: Sequence[int]) -> str:
    """The rides as a comment names them."""
    return f"ride{'s' * (len(ride_ids) > 1)} {', '.join(map(str, ride_ids))}"


def scores_of(work: _Work, point: Any) -> tuple[float, float] | None:
    """What a point comes to: the aim, and what it costs; None if it cannot be."""
    ridden = work.road.ridden({**work.config, **work.space.changes(point)})
    if ridden is None:
        return None
    return ridden.aim, ridden.cost(work.road.before, work.job.objective)


def plain(work: _Work, best: Tried) -> Tried:
    """The same without the knobs that make no difference: what need not change stays."""
    for part in work.space.parts():
        point = best.point.copy()
        point[part] = np.nan
        scores = scores_of(work, point)
        if scores is None:
            continue
        no_worse = scores[0] <= best.scores[0] * (1.0 + SAME_AIM)
        if no_worse and scores[1] <= best.scores[1] + SAME_COST_PCT:
            best = Tried(point, scores)
    return best


def figures(work: _Work, config: Mapping[str, Any]) -> tuple[ProposalFigure, ProposalFigure]:
    """Energy of the battery for a kilometre, and time, as the same road again tells them. Energy
    that was not measured is the twin's own, in the band of the motor's work."""
    after = work.road.ridden(config)
    assert after is not None
    results = [
        twin.corrected(totals) for twin, totals in zip(work.twins, after.totals, strict=True)
    ]
    bands = [twin.band(config) for twin in work.twins]

    def summed(name: str, factor: float = 1.0) -> ProposalFigure:
        now = factor * sum(one[name] for one in results)
        low, high = (factor * sum(band[name][end] for band in bands) for end in (0, 1))
        before = factor * sum(twin.recorded[name] for twin in work.twins)
        return ProposalFigure(before, now, min(low, now), max(high, now))

    per_km = 1.0 / SECONDS_PER_HOUR / work.road.distance_km
    battery = summed("battery_j", per_km)
    if math.isnan(battery.after):
        now, of_work = after.battery_j * per_km, summed("motor_work_j")
        low, high = (end / max(of_work.after, 1.0) for end in (of_work.low, of_work.high))
        battery = ProposalFigure(work.road.before.battery_j * per_km, now, low * now, high * now)
    return battery, summed("duration_s")


def codes_of(config: Mapping[str, Any], which: str) -> set[str]:
    """What the linter doubts: its errors and warnings by code."""
    report = law.lint(
        FuzzyTable.from_parameters(config, which),
        AssistModes.from_parameters(config),
        config,
        which,
        (config["fixed_taper_start_kmh"], config["fixed_taper_end_kmh"]),
        config["gear_ratio"],
    )
    return {finding.code for finding in (*report.errors, *report.warnings)}


def nearest_first(
    worth: Sequence[tuple[float, Tried]], target_pct: float
) -> list[tuple[float, Tried]]:
    """Those that reach what was wished first, the nearest of them; then the rest by how near."""
    return sorted(worth, key=lambda one: (abs(one[0] - target_pct), one[0] < target_pct))


def recommended(candidates: Sequence[Candidate]) -> tuple[Candidate, ...]:
    """With the first that meets the target marked, or the one that comes nearest to it."""
    if not candidates:
        return ()
    meeting = [one for one in candidates if one.meets_target]
    chosen = meeting[0] if meeting else candidates[-1]
    return tuple(replace(one, recommended=one is chosen) for one in candidates)
