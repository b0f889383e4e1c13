"""nginx and Caddy themselves, with a configuration as the docs have it, on a free port."""

from __future__ import annotations

import contextlib
import os
import shutil
import socket
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.fakes.server import eventually

NGINX = """daemon off;
master_process off;
pid nginx.pid;
events {{ }}
http {{
access_log off;
client_body_temp_path body;
proxy_temp_path proxy;
fastcgi_temp_path fastcgi;
uwsgi_temp_path uwsgi;
scgi_temp_path scgi;
{snippet}
}}
"""
CADDY = "{{\nadmin off\nauto_https off\nskip_install_trust\n}}\n{snippet}"


@contextlib.contextmanager
def real_proxy(kind: str, snippet: str, site: str, server: str, folder: Path) -> Iterator[int]:
    """Runs the proxy; its port of loopback. kind: `nginx` or `caddy`.

    snippet: for the site of that name and a server at 127.0.0.1:8750; server: where it is instead,
    as name:port. folder: for all that the proxy writes.
    """
    program = shutil.which(kind) or shutil.which(kind, path="/usr/sbin:/usr/local/sbin")
    if program is None:
        pytest.fail(f"{kind} is not installed: .ci/ensure-tools proxy", pytrace=False)
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    snippet = replaced(snippet, "127.0.0.1:8750", server)
    if kind == "nginx":
        snippet = replaced(snippet, "listen 80;", f"listen 127.0.0.1:{port};")
        words = [program, "-p", str(folder), "-c", "settings", "-e", str(folder / "errors")]
        text = NGINX.format(snippet=snippet)
    else:
        address = f"http://{site}:{port} {{\n\tbind 127.0.0.1"
        words = [program, "run", "--adapter", "caddyfile", "--config", str(folder / "settings")]
        text = CADDY.format(snippet=replaced(snippet, f"{site} {{", address))
    (folder / "settings").write_text(text)
    # Caddy writes what it was given last, and keys, below the home folder.
    homes = dict.fromkeys(("HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME"), str(folder))
    with (folder / "said").open("wb") as said:
        running = subprocess.Popen(
            words, env={**os.environ, **homes}, stdout=said, stderr=subprocess.STDOUT
        )
    try:
        eventually(lambda: running.poll() is not None or listens(port))
        assert running.poll() is None, (folder / "said").read_text()
        yield port
    finally:
        running.terminate()
        running.wait()


def replaced(text: str, there: str, instead: str) -> str:
    """The text with one thing in place of another, which must be in it once."""
    assert text.count(there) == 1, f"{there!r} is not once in: {text}"
    return text.replace(there, instead)


def listens(port: int) -> bool:
    """Whether something listens at a port of loopback."""
    try:
        socket.create_connection(("127.0.0.1", port)).close()
    except ConnectionRefusedError:
        return False
    return True
