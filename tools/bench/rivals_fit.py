"""The rivals' side of reading FIT files: Garmin's SDK, whose licence keeps it out of the product.

Runs in an environment of its own and prints the seconds of its quickest of some runs.
Usage: python rivals_fit.py RUNS FILE
"""

import sys
import time

from garmin_fit_sdk import Decoder, Stream


def main() -> None:
    runs, path = int(sys.argv[1]), sys.argv[2]
    seconds = []
    for _ in range(runs):
        start = time.perf_counter()
        messages, errors = Decoder(Stream.from_file(path)).read()
        seconds.append(time.perf_counter() - start)
        if errors or not messages["record_mesgs"]:
            sys.exit(f"{path} was not read: {errors}")
    print(min(seconds))


if __name__ == "__main__":
    main()
