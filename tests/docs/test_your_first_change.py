"""Goal: docs/your-first-change.md, the recipe of a device parameter, is true and is enough.

Method: its steps 2 to 6 in a copy of the tree, in order and as they stand: every change is made to
the file it names, every command is run. `make` itself would install the copy in place of the tree:
what it would run is run here, C without optimisation. Nothing of the copy is touched by hand.
"""

from __future__ import annotations

import importlib.util
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "your-first-change.md"
PARTS = (
    "backend",
    "firmware_protocol",
    "frontend",
    "sim_device",
    "spindle",
    "tests",
    "third_party",
)
LEFT_OUT = ("node_modules", "dist", "__pycache__", "*.o")
STEPS = "23456"
CATALOGUES = ("en/pages.json", "zh/pages.json")

pytestmark = [pytest.mark.slow, pytest.mark.long]


@dataclass(frozen=True)
class Block:
    """One block of the page: its language, the file named above it, and its text."""

    step: str
    language: str
    file: str
    text: str


def blocks() -> Iterator[Block]:
    for part in re.split(r"(?m)^## ", PAGE.read_text(encoding="utf-8"))[1:]:
        found = re.finditer(r"(?ms)(?:^`([^`\n]+)`\n\n)?^```(\w+)\n(.*?)^```$", part)
        yield from (Block(part[0], one[2], one[1] or "", one[3]) for one in found)


class Copy:
    """The tree as a newcomer has it after `make setup`, and what the page's commands do in it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for part in PARTS:
            shutil.copytree(ROOT / part, folder / part, ignore=shutil.ignore_patterns(*LEFT_OUT))
        shutil.copy(ROOT / "pyproject.toml", folder)
        (folder / "frontend" / "node_modules").symlink_to(ROOT / "frontend" / "node_modules")

    def change(self, block: Block) -> None:
        """The file as the diff has it; a Python block is a new file."""
        path = self.folder / block.file
        if block.language == "python":
            assert not path.exists(), f"{block.file} is there already; the page makes it"
            path.write_text(block.text, encoding="utf-8")
            return
        lines = [line for line in block.text.splitlines(keepends=True) if line.strip()]
        old = "".join(line[1:] or "\n" for line in lines if line[0] != "+")
        new = "".join(line[1:] or "\n" for line in lines if line[0] != "-")
        text = path.read_text(encoding="utf-8")
        assert text.count(old) == 1, f"step {block.step}: {block.file} has not once:\n{old}"
        path.write_text(text.replace(old, new), encoding="utf-8")

    def run(self, *command: str, within: str = ".") -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            command,
            cwd=self.folder / within,
            env={**os.environ, "SPINDLE_PYTHON": sys.executable, "PYTHONDONTWRITEBYTECODE": "1"},
            capture_output=True,
            text=True,
            check=False,
        )

    def must(self, *command: str, within: str = ".") -> None:
        done = self.run(*command, within=within)
        assert done.returncode == 0, f"{shlex.join(command)}\n{done.stdout}{done.stderr}"

    def generate(self) -> None:
        """`make gen`."""
        self.must(sys.executable, "-m", "firmware_protocol.generate")
        self.must("npm", "run", "--silent", "gen", within="frontend")

    def native(self) -> None:
        """`make native`, with the build of the copy."""
        build = self._build()
        objects = self.folder / "objects"
        objects.mkdir()
        glue = self.folder / "_native.c"
        build.ffibuilder.emit_c_code(str(glue))
        includes = [*build.SOURCE_FOLDERS, build.HAL_FOLDER, sysconfig.get_path("include")]
        compiler = shlex.split(os.environ.get("CC") or "cc")

        def compiled(source: tuple[int, str]) -> str:
            target = str(objects / f"{source[0]}.o")
            flags = ["-std=c99", "-O0", "-w", "-fPIC", "-ffp-contract=off"]
            flags += [f"-I{include}" for include in includes]
            self.must(*compiler, *flags, "-c", source[1], "-o", target)
            return target

        with ThreadPoolExecutor(2) as workers:
            made = list(workers.map(compiled, enumerate([str(glue), *build.sources()])))
        extension = next((ROOT / "sim_device/firmware/python").glob("_native*.so"))
        self.must(*compiler, "-shared", *made, "-o", str(extension.relative_to(ROOT)))

    def _build(self) -> Any:
        file = self.folder / "sim_device" / "firmware" / "python" / "build.py"
        found = importlib.util.spec_from_file_location("build_of_the_copy", file)
        assert found is not None
        assert found.loader is not None
        module = importlib.util.module_from_spec(found)
        found.loader.exec_module(module)
        return module

    def tests(self, *words: str) -> None:
        """Tests of the copy that are not slow."""
        options = ("-q", "-p", "no:cacheprovider", "-m", "not slow")
        self.must(sys.executable, "-m", "pytest", *options, *words)

    def untranslated(self) -> str:
        """What the type check says of the dictionaries; they are all it is asked for."""
        asked = self.folder / "frontend" / "tsconfig.words.json"
        files = ["src/shared/i18n/dictionary.ts"]
        settings: dict[str, Any] = {"extends": "./tsconfig.json", "include": [], "files": files}
        asked.write_text(json.dumps({**settings, "compilerOptions": {"types": []}}))
        return self.run("npx", "--no-install", "tsc", "-p", asked.name, within="frontend").stdout

    def obey(self, command: str) -> None:
        """One line of the page's shell."""
        fast = re.fullmatch(r'make test-fast ONLY="(.+)"', command)
        if command == "make gen":
            self.generate()
        elif command == "make native":
            self.native()
        elif command == "cd frontend && npm run check":
            assert self.untranslated() == ""
        elif fast:
            self.tests(*fast[1].split())
        elif command.startswith(".venv/bin/pytest "):
            self.tests(*command.split()[1:])
        else:
            assert command == "git status --short", f"nobody has tried: {command}"


def test_the_steps_of_the_page_make_a_parameter_whole(tmp_path: Path) -> None:
    copy = Copy(tmp_path)
    lacking = []

    for block in blocks():
        if block.step not in STEPS:
            continue
        if block.file.endswith(CATALOGUES):
            lacking.append(copy.untranslated())
        if block.file:
            copy.change(block)
        else:
            for command in block.text.splitlines():
                copy.obey(command)

    copy.must(sys.executable, "-m", "firmware_protocol.generate", "--check")
    assert len(lacking) == len(CATALOGUES)
    for refused in lacking:
        assert "parameter.cadence_rpm_min" in refused


def test_the_page_names_only_what_is_there() -> None:
    """Files, folders and targets of the steps that are not replayed."""
    text = PAGE.read_text(encoding="utf-8")
    made = {block.file for block in blocks() if block.language == "python"}
    targets = re.findall(r"(?m)^\.PHONY: (\S+)", (ROOT / "Makefile").read_text())

    paths = set(re.findall(r"\b(?:tests|frontend|firmware_protocol|backend)/[\w/.]+\w", text))
    assert {path for path in paths - made if not (ROOT / path).exists()} == set()
    assert set(re.findall(r"(?m)^make ([\w-]+)|`make ([\w-]+)", text)) <= {
        pair for target in targets for pair in ((target, ""), ("", target))
    }
