"""Tells the story of a seed. Usage: python -m tests.simulation SEED [HOW_MANY [TEXT]]

With TEXT it ends at the first seed of which the judge says that.
"""

import sys
import time

from tests.simulation.workload import simulate


def main() -> None:
    first = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    wanted = sys.argv[3] if len(sys.argv) > 3 else None
    started_s = time.perf_counter()
    wrong = []
    for seed in range(first, first + count):
        verdict = simulate(seed)
        if count == 1:
            print("\n".join(verdict.story))
            print(f"\nfigures: {verdict.figures}\ntrace:   {verdict.digest}")
        if verdict.wrong is not None:
            wrong.append(seed)
            print(f"seed {seed}: {verdict.wrong}", flush=True)
            if wanted is not None and wanted in verdict.wrong:
                break
    seconds = time.perf_counter() - started_s
    print(f"{count} seeds in {seconds:.1f} s; broken: {wrong or 'none'}")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
