"""Fuzzes everything for so many seconds each. Usage: python -m tools.fuzz SECONDS"""

import subprocess
import sys
import tempfile
from pathlib import Path

from tools.fuzz import harness

HOST_TARGETS = ("wire", "csv", "fit", "track", "mahle", "log", "head")


def main() -> None:
    seconds = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    folder = Path(tempfile.mkdtemp(prefix="spindle-fuzz-"))
    found = []
    clang = harness.compiler(folder)
    if clang is None:
        print("C: no clang with libFuzzer here (apt-get install clang libclang-rt-14-dev)")
    objects = folder / "objects"
    objects.mkdir()
    if clang:
        harness.compile_unit(clang, objects)
    for target in harness.TARGETS if clang else ():
        program = harness.build(str(clang), target, objects, folder)
        done = harness.run(program, harness.write_corpus(target, folder), seconds, folder)
        print(f"C {target}: {harness.executions(done.stderr):,} inputs", flush=True)
        if done.returncode != 0:
            found.append(target)
            print(done.stderr[-4000:])
    for target in HOST_TARGETS:
        command = [sys.executable, "-m", "tools.fuzz.host", target]
        command += [f"-max_total_time={seconds}", f"-artifact_prefix={folder}/"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        print(f"Python {target}: {done.stderr.splitlines()[-1] if done.stderr else ''}", flush=True)
        if done.returncode != 0:
            found.append(target)
            print(done.stderr[-4000:])
    print(f"inputs that broke something: {folder}" if found else "nothing found")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
