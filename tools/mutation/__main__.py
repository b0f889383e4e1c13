"""Breaks the code in every known way and says which break no test noticed.

Usage: python -m tools.mutation
"""

import sys
import tempfile
import time
from pathlib import Path

from tools.mutation.workshop import FAILED, Workshop, breaks


def main() -> None:
    started_s = time.perf_counter()
    missed = []
    with tempfile.TemporaryDirectory(prefix="spindle-mutation-") as folder:
        workshop = Workshop(Path(folder)).set_up()
        for one in breaks():
            try:
                done = workshop.broken(one)
            except ValueError as stale:
                missed.append(one.name)
                print(f"STALE   {stale}", flush=True)
                continue
            caught = done.returncode == FAILED
            print(f"{'caught' if caught else 'MISSED':7} {one.name}", flush=True)
            if not caught:
                missed.append(one.name)
                print(done.stdout[-2000:], done.stderr[-2000:])
    count = len(breaks())
    print(f"{count - len(missed)} of {count} caught in {time.perf_counter() - started_s:.0f} s")
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
