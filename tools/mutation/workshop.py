"""A copy of the sources in which things are broken on purpose, and put back.

C is compiled file by file, so that a break costs one file and a link.
"""

from __future__ import annotations

import compileall
import os
import py_compile
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tomllib
from dataclasses import dataclass
from pathlib import Path

from sim_device.firmware.python import build
from tests import counts

ROOT = Path(__file__).resolve().parents[2]
PARTS = (
    "backend",
    "firmware_protocol",
    "sim_device",
    "tests",
    "third_party",
    "pyproject.toml",
)
EXTENSION = "sim_device/firmware/python/_native.abi3.so"
TESTS_SECONDS_MAX = 120
# As many as the job has; a planted fault has to be found by them.
SEEDS = 200
# pytest's own codes: all passed, some failed.
PASSED, FAILED = 0, 1


@dataclass(frozen=True)
class Break:
    """One way to break the code, and who notices: tests, or the simulation's judge.

    judged: part of what the judge says. seed: from which one on it is looked for.
    """

    name: str
    file: str
    find: str
    replace: str
    caught_by: tuple[str, ...] = ()
    judged: str = ""
    seed: int = 1


def breaks() -> list[Break]:
    """All of breaks.toml."""
    rows = tomllib.loads(Path(__file__).with_name("breaks.toml").read_text())["break"]
    return [Break(**{**row, "caught_by": tuple(row.get("caught_by", ()))}) for row in rows]


class Workshop:
    """A folder with the sources and a compiled extension; `set_up` fills it. It may be copied."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self._objects = folder / "objects"
        self._compiler = shlex.split(os.environ.get("CC") or sysconfig.get_config_var("CC") or "cc")

    def set_up(self) -> Workshop:
        """Copy the sources and compile them, Python too: hundreds of processes will import it."""
        self._objects.mkdir()
        ignored = shutil.ignore_patterns("*.so", "__pycache__", "node_modules")
        for part in PARTS:
            if (ROOT / part).is_dir():
                shutil.copytree(ROOT / part, self.folder / part, ignore=ignored)
            else:
                shutil.copy(ROOT / part, self.folder / part)
        glue = self.folder / "_native.c"
        build.ffibuilder.emit_c_code(str(glue))
        for source in [glue, *(self.folder / name for name in build.sources())]:
            self._compile(source)
        self._link()
        # What is broken keeps its length and second now and then: only its bytes tell.
        by_bytes = py_compile.PycInvalidationMode.CHECKED_HASH
        for room in ("backend", "firmware_protocol", "sim_device"):
            compileall.compile_dir(self.folder / room, quiet=1, invalidation_mode=by_bytes)
        return self

    def broken(self, one: Break) -> subprocess.CompletedProcess[str]:
        """Break the copy, run the tests that should notice, mend it again."""
        path = self.folder / one.file
        text = path.read_text()
        if text.count(one.find) != 1:
            raise ValueError(f"{one.name}: {one.file} has {text.count(one.find)} of its text.")
        path.write_text(text.replace(one.find, one.replace))
        try:
            self._rebuild(path)
            return self.tests(one.caught_by) if one.caught_by else self.simulation(one)
        finally:
            path.write_text(text)
            self._rebuild(path)

    def tests(self, names: tuple[str, ...]) -> subprocess.CompletedProcess[str]:
        """Run test files, or single tests, against the copy until the first fails."""
        options = ("-q", "-x", "-p", "no:cacheprovider")
        return self._python("pytest", *options, *names)

    def simulation(self, one: Break) -> subprocess.CompletedProcess[str]:
        """Run seeds against the copy until the judge says what was planted."""
        done = self._python("tests.simulation", str(one.seed), str(SEEDS), one.judged)
        noticed = done.returncode == FAILED and one.judged in done.stdout
        return subprocess.CompletedProcess(
            done.args, FAILED if noticed else PASSED, done.stdout, done.stderr
        )

    def _python(self, module: str, *arguments: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", module, *arguments]
        # A tenth of large counts finds a break, and the time limit was measured with it.
        environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
        environment.pop(counts.PROVE_VARIABLE, None)
        # A break may hang: the time limit then counts as noticed.
        try:
            return subprocess.run(
                command,
                cwd=self.folder,
                env=environment,
                capture_output=True,
                text=True,
                timeout=TESTS_SECONDS_MAX,
                check=False,
            )
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(command, FAILED, "", "hung")

    def _rebuild(self, path: Path) -> None:
        if path.suffix == ".c":
            self._compile(path)
            self._link()

    def _compile(self, source: Path) -> None:
        includes = [*build.SOURCE_FOLDERS, "sim_device/firmware/hal"]
        command = [*self._compiler, "-std=c99", "-O1", "-w", "-fPIC", "-ffp-contract=off"]
        command += [f"-I{self.folder / part}" for part in includes]
        command += [f"-I{sysconfig.get_path('include')}", "-c", str(source)]
        self._run([*command, "-o", str(self._objects / f"{source.stem}.o")])

    def _link(self) -> None:
        objects = sorted(map(str, self._objects.glob("*.o")))
        self._run([*self._compiler, "-shared", *objects, "-o", str(self.folder / EXTENSION)])

    def _run(self, command: list[str]) -> None:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stderr)
