"""Which databases there may be: said before anything is opened, with what to write instead."""

from __future__ import annotations

from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError, NoSuchModuleError

from backend.errors import FieldError, InvalidRequest
from backend.store.sql.database import sqlite_path

ENGINES = ("sqlite", "postgresql")
FORMS = "sqlite:///path/to/spindle.db or postgresql+psycopg://user:password@host/name"


def check_url(url: str) -> None:
    """Raises InvalidRequest for what is no database that Spindle can use on this machine."""
    try:
        parts = make_url(url)
    except (ArgumentError, ValueError):
        # As it stands it may hold a password.
        raise refused(f"The database's URL is none. Write {FORMS}.") from None
    shown = parts.render_as_string(hide_password=True)
    if parts.get_backend_name() not in ENGINES:
        raise refused(f"{shown}: there is no such kind of database here. Write {FORMS}.")
    if parts.get_backend_name() == "sqlite" and sqlite_path(url) is None:
        # A file by another name than its path could not be locked either.
        raise refused(f"{shown} is no path, and may be forgotten with the process. Write {FORMS}.")
    check_driver(parts, shown)


def check_driver(parts: URL, shown: str) -> None:
    """Raises InvalidRequest when the library that speaks to the database is not here."""
    try:
        parts.get_dialect().import_dbapi()
    except NoSuchModuleError:
        raise refused(f"{shown}: there is no such driver. Write {FORMS}.") from None
    except ImportError as error:
        missing = error.name or parts.get_driver_name()
        raise refused(
            f"{shown} needs the Python package {missing}, which is not installed: "
            f"`pip install {missing}` in Spindle's environment."
        ) from None


def refused(message: str) -> InvalidRequest:
    """The refusal of the setting `db`."""
    return InvalidRequest(message, fields=[FieldError("db", "not_accepted", message)])
