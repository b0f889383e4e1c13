"""What routes call, handed to them by main."""

from __future__ import annotations

from typing import Any

from fastapi import Depends
from starlette.requests import HTTPConnection


def provided(name: str) -> Any:
    """A dependency on the service that main put on the application under a name."""

    def service(connection: HTTPConnection) -> Any:
        return getattr(connection.app.state.services, name)

    return Depends(service)
