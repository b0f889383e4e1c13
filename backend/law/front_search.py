"""What cannot be bettered in one thing without losing in another: a search for that front.

NSGA-II in its plainest form (Deb 2002): the best by rank and by room around them have children, by
blending two and by chance. Everything that was tried counts, not only the last generation. For two
aims and a dozen knobs it finds as much of the front as the libraries do.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
# A point (n,), each from 0 to 1 -> what is to be small, two of them; None if it cannot be.
Evaluate = Callable[[Floats], tuple[float, float] | None]

POPULATION = 30
GENERATIONS = 10
BLENDED = 0.6
MUTATED = 0.35
SPREAD = 0.12


@dataclass(frozen=True, slots=True)
class Tried:
    """A point and what came of it."""

    point: Floats
    scores: tuple[float, float]


def front_of(
    evaluate: Evaluate,
    start: Floats,
    going: Callable[[], bool],
    generations: int = GENERATIONS,
    seed: int = 0,
) -> list[Tried]:
    """The points that no other betters in both, by the first score.

    start: a point that is tried first. going: asked before each; where it says no the search ends
    with what it has. generations: of POPULATION points each.
    """
    random = np.random.default_rng(seed)
    tried: list[Tried] = []
    points = [start, *spread_out(random, POPULATION - 1, start.size)]
    for _ in range(generations):
        for point in points:
            if not going():
                return sorted_front(tried)
            scores = evaluate(point)
            if scores is not None:
                tried.append(Tried(point, scores))
        points = children(random, tried, start)
    return sorted_front(tried)


def spread_out(random: np.random.Generator, count: int, knobs: int) -> list[Floats]:
    """Points of which no two share a slice of any knob: a Latin hypercube."""
    slices = np.stack([random.permutation(count) for _ in range(knobs)], axis=1)
    return list((slices + random.random((count, knobs))) / count)


def children(random: np.random.Generator, tried: list[Tried], start: Floats) -> list[Floats]:
    """The next generation."""
    if len(tried) < 2:
        return spread_out(random, POPULATION, start.size)
    parents = [tried[at].point for at in best(np.array([one.scores for one in tried]), POPULATION)]
    offspring = []
    for _ in range(POPULATION):
        # Of two by chance the better one, twice.
        first, second = (parents[min(random.integers(len(parents), size=2))] for _ in range(2))
        share = random.uniform(-0.2, 1.2, start.size)
        blends = random.random(start.size) < BLENDED
        child = np.where(blends, first + share * (second - first), first)
        jumps = random.random(start.size) < MUTATED
        child = child + np.where(jumps, random.normal(0.0, SPREAD, start.size), 0.0)
        offspring.append(np.clip(child, 0.0, 1.0))
    return offspring


def best(scores: Floats, count: int) -> list[int]:
    """The first `count` rows of scores (n, 2) by rank, then by how much room is around them."""
    left = np.arange(len(scores))
    selected: list[int] = []
    while left.size and len(selected) < count:
        inside = unbettered(scores[left])
        front = left[inside]
        selected += [
            int(at) for at in front[np.argsort(-room_around(scores[front]), kind="stable")]
        ]
        left = left[~inside]
    return selected[:count]


def unbettered(scores: Floats) -> npt.NDArray[np.bool_]:
    """Which rows no other row betters in one score without being worse in the other, (n,)."""
    no_worse = (scores[:, None, :] <= scores[None, :, :]).all(axis=2)
    better = (scores[:, None, :] < scores[None, :, :]).any(axis=2)
    return np.asarray(~(no_worse & better).any(axis=0))


def room_around(scores: Floats) -> Floats:
    """Distance between each row's neighbours, both scores in shares of their span, (n,)."""
    room = np.zeros(len(scores))
    for score in scores.T:
        order = np.argsort(score, kind="stable")
        span = max(float(np.ptp(score)), 1e-12)
        room[order[[0, -1]]] = np.inf
        room[order[1:-1]] += (score[order[2:]] - score[order[:-2]]) / span
    return room


def sorted_front(tried: list[Tried]) -> list[Tried]:
    """Those that no other betters, each score once, by the first score."""
    if not tried:
        return []
    inside = unbettered(np.array([one.scores for one in tried]))
    front = {one.scores: one for one, is_in in zip(tried, inside, strict=True) if is_in}
    return [front[scores] for scores in sorted(front)]
