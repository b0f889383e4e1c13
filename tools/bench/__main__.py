"""Measures everything in one run and writes docs/benchmarks.md. Usage: python -m tools.bench"""

import sys
from pathlib import Path

from tools.bench import (
    answers,
    board,
    law,
    link,
    load,
    logbook,
    logs,
    pages,
    plant,
    rides,
    server,
    uploads,
    wire,
    writes,
)
from tools.bench.figures import Figure, mark, write

PAGE = Path(__file__).resolve().parents[2] / "docs" / "benchmarks.md"
SECTIONS = {
    "The law": law.run,
    "The simulator": plant.run,
    "The wire": wire.run,
    "The link": link.run,
    "Answers": answers.run,
    "Configuration writes": writes.run,
    "Ride logs": logs.run,
    "Rides": rides.run,
    "Ten thousand rides": logbook.run,
    "Files": uploads.run,
    "The server": server.run,
    "Many units": load.run,
    "The pages in a browser": pages.run,
    "The firmware on a Cortex-M4F": board.run,
}


def main() -> None:
    results: dict[str, list[Figure]] = {}
    for title, run in SECTIONS.items():
        results[title] = run()
        for figure in results[title]:
            print(f"{mark(figure):8} {figure.subject}: {figure.value}  {figure.target}", flush=True)
    write(PAGE, results)
    missed = [f.subject for figures in results.values() for f in figures if f.reached is False]
    if missed:
        sys.exit("Not reached: " + "; ".join(missed))


if __name__ == "__main__":
    main()
