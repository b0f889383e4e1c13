"""A PostgreSQL server of one's own for a test: a fresh cluster in a folder, on a free port."""

from __future__ import annotations

import os
import pwd
import shutil
import socket
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import pytest

USER = "spindle"
PATIENCE_S = 60.0


def tool(name: str) -> str | None:
    """Where a program of PostgreSQL is: on the path, or where Debian keeps it."""
    kept = sorted(Path("/usr/lib/postgresql").glob(f"*/bin/{name}"), reverse=True)
    return str(kept[0]) if kept else shutil.which(name)


def missing() -> str | None:
    """Why there can be no server here, None when there can."""
    try:
        import psycopg  # noqa: F401
    except ImportError:
        return "psycopg is not installed: pip install spindle[postgresql]"
    if tool("initdb") is None or tool("pg_ctl") is None:
        return "PostgreSQL is not installed: .ci/ensure-tools database"
    if os.geteuid() == 0 and (owner() is None or shutil.which("setpriv") is None):
        return "PostgreSQL does not run as root, and there is no user postgres or no setpriv"
    return None


def owner() -> pwd.struct_passwd | None:
    """Whom the cluster belongs to when we are root."""
    try:
        return pwd.getpwnam("postgres") if os.geteuid() == 0 else None
    except KeyError:
        return None


class Postgres:
    """A running cluster; `url` of a new, empty database by `new_database`."""

    def __init__(self) -> None:
        reason = missing()
        if reason is not None:
            pytest.fail(reason, pytrace=False)
        self._folder = Path(tempfile.mkdtemp(prefix="spindle-pg-"))
        user = owner()
        self._as: list[str] = []
        if user is not None:
            os.chown(self._folder, user.pw_uid, user.pw_gid)
            # It also gets through folders that are root's alone, where those are on the way.
            # Without no_setuid_fixup, access(2) would still say that it does not.
            through = [f"--{kind}-caps=+dac_read_search" for kind in ("inh", "ambient")]
            self._as = ["setpriv", f"--reuid={user.pw_uid}", f"--regid={user.pw_gid}"]
            self._as += ["--clear-groups", "--securebits=+no_setuid_fixup", *through]
        with socket.create_server(("127.0.0.1", 0)) as free:
            self.port = free.getsockname()[1]
        self._databases = 0
        self._data = str(self._folder / "data")
        encoding = ("-E", "UTF8", "--locale=C")
        self._run("initdb", "-D", self._data, "-U", USER, "-A", "trust", "-N", *encoding)
        options = f"-p {self.port} -k {self._folder} -c listen_addresses=127.0.0.1 -c fsync=off"
        log = str(self._folder / "log")
        self._run(
            "pg_ctl", "-D", str(self._folder / "data"), "-w", "-l", log, "-o", options, "start"
        )

    def new_database(self, encoding: str = "UTF8") -> str:
        """The URL of an empty database."""
        self._databases += 1
        name = f"spindle{self._databases}"
        self.execute(f"CREATE DATABASE {name} ENCODING '{encoding}' TEMPLATE template0")
        return f"postgresql+psycopg://{USER}:secret@127.0.0.1:{self.port}/{name}"

    def execute(self, statement: str) -> list[Any]:
        """What a statement gives, as the administrator."""
        import psycopg

        where = f"host=127.0.0.1 port={self.port} user={USER} dbname=postgres"
        with psycopg.connect(where, autocommit=True) as connection:
            cursor = connection.execute(statement)
            return cursor.fetchall() if cursor.description else []

    def stop(self) -> None:
        """Stop it and remove its folder."""
        self._run("pg_ctl", "-D", self._data, "-m", "immediate", "stop")
        shutil.rmtree(self._folder, ignore_errors=True)

    def _run(self, name: str, *words: str) -> None:
        program = tool(name)
        assert program is not None
        done = subprocess.run(
            [*self._as, program, *words],
            cwd=self._folder,
            env={**os.environ, "LC_ALL": "C"},
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            timeout=PATIENCE_S,
            check=False,
        )
        assert done.returncode == 0, f"{name}: {done.stderr.decode(errors='replace')}"
