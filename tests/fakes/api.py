"""The application in this process, without a port: with the services that a test gives it."""

from __future__ import annotations

import functools
from types import SimpleNamespace
from typing import Any, cast

from fastapi import FastAPI
from fastapi.testclient import TestClient

from backend.app import build_api
from backend.services import Services
from backend.web.app import WebSettings


@functools.cache
def description() -> dict[str, Any]:
    """The OpenAPI description; made when it is first asked for, not when tests are collected."""
    return build_api(WebSettings(version="0")).openapi()


def api_with(*, author: str = "", **services: object) -> FastAPI:
    """The application, behind which there is nothing else. services: by their names in Services."""
    there = cast(Services, SimpleNamespace(**services))
    return build_api(WebSettings("test", author=author), there)


def client_of(app: FastAPI) -> TestClient:
    """Asks it as a browser on this machine does; what it fails at is a 500."""
    return TestClient(app, base_url="http://127.0.0.1", raise_server_exceptions=False)
