"""Settings: flags win over the environment, the environment over spindle.toml, that over defaults.

`spindle.toml` holds the same names in lower case without the prefix (`port = 8750`,
`device = ["sim"]`). Everything is read once, here, and frozen.
"""

from __future__ import annotations

import getpass
import os
import re
import sys
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, fields
from ipaddress import ip_network
from pathlib import Path
from typing import Any

from backend.core.author import tidy_author
from backend.core.hosts import is_of_this_machine
from backend.errors import FieldError, InvalidRequest

PREFIX = "SPINDLE_"
FILE_NAME = "spindle.toml"
CHECKOUT = Path(__file__).resolve().parent.parent
BUSES = ("memory",)
JOBS = ("inline",)
AUTHS = ("auto", "off", "required")
TLS = ("off", "own", "files")
# Unreserved characters of RFC 3986, section 2.3: whoever writes them writes them in one way.
ROOT_PATH = re.compile(r"(/[A-Za-z0-9_~-][A-Za-z0-9._~-]*)*")
# First parts of paths of Spindle's own: below one of them, nobody could tell the two apart.
OWN_PATHS = frozenset(
    {
        "api",
        "assets",
        "connect",
        "healthz",
        "icons",
        "live",
        "metrics",
        "readyz",
        "rides",
        "sensor",
        "service",
        "settings",
        "sign-in",
        "tune",
    }
)


@dataclass(frozen=True)
class Settings:
    """How one server runs.

    host, port: where it listens; port 0 takes a free one. data: folder of everything it keeps.
    device: units opened at the start. db, objects: URLs of the database and the object store.
    bus, jobs: how events and work travel. auth: `required` asks everybody to sign in, `auto` does
    so beyond loopback, `off` says somebody else guards the door. allowed_hosts: names by which
    browsers may call the server besides localhost. proxies: addresses and networks of the proxies
    that are believed who asks and whether by TLS (`X-Forwarded-For`, `-Proto`). root_path: of the
    site, below which a proxy has the server (`/spindle`), else empty. tls: `own` makes a
    certificate in `data`, `files` takes tls_certificate and tls_key, both PEM. upload_bytes_max:
    largest file taken.
    author: whose changes those are whose request names nobody; the system's user unless set.
    calibration_limits: tables of the file alone, as of calibration.judgement.
    """

    host: str
    port: int
    data: Path
    device: tuple[str, ...]
    db: str
    objects: str
    bus: str
    jobs: str
    auth: str
    allowed_hosts: tuple[str, ...]
    proxies: tuple[str, ...]
    root_path: str
    tls: str
    tls_certificate: Path | None
    tls_key: Path | None
    upload_bytes_max: int
    author: str
    calibration_limits: tuple[Any, ...]

    @property
    def cache(self) -> Path:
        """Folder for copies of a bucket's objects."""
        return self.data / "bucket"

    @property
    def is_loopback(self) -> bool:
        """Whether only this machine can reach the server."""
        return is_of_this_machine(self.host)

    @property
    def needs_sign_in(self) -> bool:
        """Whether only people with an account may do anything."""
        return self.auth == "required" or (self.auth == "auto" and not self.is_loopback)


def load(flags: Mapping[str, Any], environment: Mapping[str, str] | None = None) -> Settings:
    """The settings of this process.

    flags: by field name, None where a flag was not given. environment: `os.environ` if None.
    Raises InvalidRequest that names every setting at fault.
    """
    env = os.environ if environment is None else environment
    data = Path(flags.get("data") or env.get(f"{PREFIX}DATA") or default_data_folder(env))
    return combine(flags, env, read_file(Path(FILE_NAME), data / FILE_NAME))


def combine(
    flags: Mapping[str, Any], environment: Mapping[str, str], file: Mapping[str, Any]
) -> Settings:
    """Settings from the three sources; pure but for the path of the default folder.

    Raises InvalidRequest that names every setting at fault.
    """
    names = [field.name for field in fields(Settings)]
    errors = [
        FieldError(name, "unknown", f"{FILE_NAME}: there is no setting {name!r}.")
        for name in file
        if name not in names
    ]
    chosen: dict[str, Any] = {}
    for name in names:
        for source in (flags.get(name), environment.get(PREFIX + name.upper()), file.get(name)):
            if source is not None and source != "":
                chosen[name] = source
                break
    data = Path(chosen.get("data") or default_data_folder(environment)).expanduser().resolve()
    values: dict[str, Any] = {
        "host": str(chosen.get("host", "127.0.0.1")),
        "port": _integer(chosen.get("port", 8750), "port", 0, 65535, errors),
        "data": data,
        "device": _units(chosen.get("device", "sim"), errors),
        "db": str(chosen.get("db", f"sqlite:///{(data / 'spindle.db').as_posix()}")),
        "objects": str(chosen.get("objects", (data / "objects").as_uri())),
        "bus": _one_of(chosen.get("bus", "memory"), "bus", BUSES, errors),
        "jobs": _one_of(chosen.get("jobs", "inline"), "jobs", JOBS, errors),
        "auth": _one_of(chosen.get("auth", "auto"), "auth", AUTHS, errors),
        "allowed_hosts": _names(chosen.get("allowed_hosts", "")),
        "proxies": _networks(chosen.get("proxies", ""), errors),
        "root_path": _root_path(str(chosen.get("root_path", "")), errors),
        **_tls(chosen, errors),
        "upload_bytes_max": _integer(
            chosen.get("upload_bytes_max", 256 * 1024 * 1024),
            "upload_bytes_max",
            1024,
            8 * 1024**3,
            errors,
        ),
        "author": tidy_author(str(chosen.get("author") or system_user())),
        "calibration_limits": _tables(chosen.get("calibration_limits", []), errors),
    }
    if errors:
        raise InvalidRequest("; ".join(error.message for error in errors), fields=errors)
    return Settings(**values)


def read_file(*candidates: Path) -> dict[str, Any]:
    """The first of the files that exists, as a table. Raises InvalidRequest if it is not TOML."""
    for path in candidates:
        try:
            if path.is_file():
                return tomllib.loads(path.read_text(encoding="utf-8-sig"))
        except tomllib.TOMLDecodeError as error:
            raise InvalidRequest(f"{path} is not TOML: {error}.") from None
        except UnicodeDecodeError as error:
            raise InvalidRequest(f"{path} is not UTF-8 text, at byte {error.start}.") from None
        except (OSError, ValueError) as error:
            reason = error.strerror if isinstance(error, OSError) else error
            raise InvalidRequest(f"{path} cannot be read: {reason}.") from None
    return {}


def default_data_folder(environment: Mapping[str, str]) -> Path:
    """`data/` in a checkout, the system's place for a program's data where installed."""
    if (CHECKOUT / "pyproject.toml").is_file():
        return CHECKOUT / "data"
    home = Path.home()
    if sys.platform == "win32":
        return Path(environment.get("LOCALAPPDATA", home)) / "Spindle"
    if sys.platform == "darwin":
        return home / "Library" / "Application Support" / "Spindle"
    return Path(environment.get("XDG_DATA_HOME") or home / ".local" / "share") / "spindle"


def system_user() -> str:
    """The name this process runs under; empty where the system has none for it."""
    try:
        return getpass.getuser()
    except (OSError, KeyError, ImportError):
        return ""


def _tables(value: Any, errors: list[FieldError]) -> tuple[Any, ...]:
    if isinstance(value, list):
        return tuple(value)
    message = f"calibration_limits are tables of {FILE_NAME}: [[calibration_limits]]."
    errors.append(FieldError("calibration_limits", "not_tables", message))
    return ()


def _units(value: Any, errors: list[FieldError]) -> tuple[str, ...]:
    urls = _names(value)
    for url in sorted({url for url in urls if urls.count(url) > 1}):
        message = f"device {url} is named twice; two simulated units are sim:one and sim:two."
        errors.append(FieldError("device", "repeated", message))
    return urls


def _names(value: Any) -> tuple[str, ...]:
    parts = value.split(",") if isinstance(value, str) else value
    return tuple(str(part).strip() for part in parts if str(part).strip())


def _networks(value: Any, errors: list[FieldError]) -> tuple[str, ...]:
    names = _names(value)
    for name in names:
        try:
            ip_network(name)
        except ValueError:
            message = f"proxies: {name!r} is no address (127.0.0.1) and no network (10.0.0.0/8)."
            errors.append(FieldError("proxies", "not_a_network", message))
    return names


def _root_path(value: str, errors: list[FieldError]) -> str:
    path = value.rstrip("/")
    if not ROOT_PATH.fullmatch(path):
        message = f"root_path is {value!r}: it must be a path like /spindle."
        errors.append(FieldError("root_path", "not_a_path", message))
    elif path[1:].split("/")[0] in OWN_PATHS:
        message = f"root_path is {value!r}: Spindle has such paths of its own; choose another."
        errors.append(FieldError("root_path", "own_path", message))
    return path


def _tls(chosen: Mapping[str, Any], errors: list[FieldError]) -> dict[str, Any]:
    files = {
        name: Path(str(chosen[name])).expanduser().resolve() if name in chosen else None
        for name in ("tls_certificate", "tls_key")
    }
    tls = _one_of(chosen.get("tls", "off"), "tls", TLS, errors)
    for name, file in files.items():
        if tls == "files" and file is None:
            message = f"tls is files: {name} must name a file, in PEM."
            errors.append(FieldError(name, "missing", message))
        elif tls in ("off", "own") and file is not None:
            message = f"{name} is set, and tls is {tls}: set tls to files, or leave it out."
            errors.append(FieldError(name, "unused", message))
    return {"tls": tls, **files}


def _integer(value: Any, name: str, low: int, high: int, errors: list[FieldError]) -> int:
    try:
        number = int(str(value))
    except ValueError:
        number = low - 1
    if not low <= number <= high:
        message = f"{name} is {value!r}: it must be a whole number from {low} to {high}."
        errors.append(FieldError(name, "out_of_range", message))
    return number


def _one_of(value: Any, name: str, choices: tuple[str, ...], errors: list[FieldError]) -> str:
    if value not in choices:
        message = f"{name} is {value!r}: it must be one of {', '.join(choices)}."
        errors.append(FieldError(name, "not_a_choice", message))
    return str(value)
