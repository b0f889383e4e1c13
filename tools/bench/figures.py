"""What a benchmark says: one figure, the target it has, and how it is written down."""

import platform
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Figure:
    """One measured line. `against` is a rival or the physical limit of the same run."""

    subject: str
    value: str
    target: str
    reached: bool | None
    against: str = ""


def best_of(runs: int, work: Callable[[], object]) -> float:
    """Shortest wall time of `runs` calls in seconds: noise only ever adds."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def median_of(runs: int, work: Callable[[], object]) -> float:
    """Median wall time of `runs` calls in seconds: what a user waits for."""
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return sorted(times)[len(times) // 2]


def mark(figure: Figure) -> str:
    return {True: "yes", False: "**no**", None: ""}[figure.reached]


def write(path: Path, sections: dict[str, list[Figure]]) -> None:
    """The whole page, anew."""
    lines = [
        "# Benchmarks",
        "",
        "Written by `make bench`: every figure from one run on one machine, rivals included.",
        "Machines differ; the ratios travel, the absolute times do not.",
        "",
        f"Python {platform.python_version()}, {platform.system()} on {platform.machine()}, "
        f"{time.strftime('%Y-%m-%d')}.",
    ]
    for title, figures in sections.items():
        lines += ["", f"## {title}", "", "| what | measured | to reach | reached | against |"]
        lines += ["|---|---|---|---|---|"]
        lines += [
            f"| {f.subject} | {f.value} | {f.target} | {mark(f)} | {f.against} |" for f in figures
        ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
