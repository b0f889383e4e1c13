"""The application: routes, refusals, safety and pages put together. Starts nothing."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fastapi import APIRouter, Depends, FastAPI
from fastapi.openapi.utils import get_openapi
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

from backend.api import docs, errors, live, pages
from backend.api.door import Door
from backend.api.permissions import NEEDED, Anyone, require_permission
from backend.api.problem import Problem, refusals, refusals_only
from backend.api.root_path import RootPath
from backend.api.routes import (
    bike_numbers,
    calibrations,
    comparison,
    config,
    devices,
    health,
    insight,
    law,
    library,
    logbook,
    logs,
    people,
    proposals,
    rides,
    sensor_drift,
    store,
    tables,
    uploads,
)
from backend.api.safety import AllowedHosts, BodyBound, SameOriginOnly, SecurityHeaders
from backend.api.services import Services
from backend.services.people.people import People

PREFIX = "/api/v1"
# A whole ride is a file and goes another way; the largest honest JSON body is a page of points.
BODY_BYTES_MAX = 1024 * 1024
# Ride samples and files are compressed already or not worth the processor's time.
UNCOMPRESSED = (*DEFAULT_EXCLUDED_CONTENT_TYPES, "application/octet-stream", "application/vnd.*")

# What a server that asks people to sign in may answer to everything but a stranger's operations.
CLOSED = {str(status): answer for status, answer in refusals_only(401, 403).items()}
NOT_JSON = refusals(400)[400] | {"description": "The body is not JSON"}


@dataclass(frozen=True)
class ApiSettings:
    """What the API needs to know about its surroundings.

    guarded: proxies may pass requests on. frontend: folder of the built pages, None where there is
    none. author: of changes whose request names nobody. root_path: of the site, below which a proxy
    has the server; `/spindle`, or empty.
    """

    version: str
    hosts: AllowedHosts = field(default_factory=AllowedHosts)
    guarded: bool = False
    frontend: Path | None = None
    upload_bytes_max: int = 256 * 1024 * 1024
    author: str = ""
    root_path: str = ""


def create_app(
    settings: ApiSettings, services: Services | None = None, accounts: People | None = None
) -> FastAPI:
    """The application over open services; without any it can only describe itself.

    accounts: who may sign in; None where nobody is asked to sign in.
    """
    app = FastAPI(
        title="Spindle",
        version=settings.version,
        summary="Configure, calibrate, watch and understand mid-drive e-bikes.",
        # docs has both, behind the same dependency as everything else.
        openapi_url=None,
        docs_url=None,
        redoc_url=None,
        dependencies=[Depends(require_permission)],
    )
    app.state.services = services
    app.state.people = accounts
    app.state.upload_bytes_max = settings.upload_bytes_max
    app.state.author = settings.author
    api = APIRouter(prefix=PREFIX)
    # Before the rides: what several rides tell together is at no ride's number.
    told = (logbook, comparison, insight, rides, proposals)
    of_units = (devices, logs, config, calibrations, bike_numbers, sensor_drift)
    parts = (health, people, store, *of_units, law, library, *told, uploads, tables, live)
    for module in parts:
        api.include_router(module.router)
    app.include_router(api)
    app.include_router(health.probes)
    errors.install(app)
    docs.install(app, f"{PREFIX}/openapi.json")
    pages.install(app, settings.frontend, settings.root_path)
    app.openapi = lambda: openapi_of(app, settings.root_path)  # type: ignore[method-assign]
    _protect(app, settings, accounts)
    return app


def _protect(app: FastAPI, settings: ApiSettings, accounts: People | None) -> None:
    """Middleware, innermost first: what is added last sees a request first."""
    app.add_middleware(
        GZipMiddleware, minimum_size=1024, compresslevel=4, exclude_content_types=UNCOMPRESSED
    )
    app.add_middleware(
        BodyBound,
        bytes_max=BODY_BYTES_MAX,
        upload_bytes_max=settings.upload_bytes_max,
        upload_paths=(f"{PREFIX}/uploads", f"{PREFIX}/rides/import"),
    )
    if accounts is not None:
        app.add_middleware(Door, people=accounts)
    app.add_middleware(SameOriginOnly, hosts=settings.hosts, guarded=settings.guarded)
    app.add_middleware(SecurityHeaders)
    if settings.root_path:
        app.add_middleware(RootPath, root_path=settings.root_path)


def describe_unreadable_bodies(schema: dict[str, Any]) -> None:
    """Adds to every operation that takes JSON that it answers 400 to what is none."""
    for methods in schema["paths"].values():
        for operation in methods.values():
            if "application/json" in operation.get("requestBody", {}).get("content", {}):
                operation["responses"] |= {"400": NOT_JSON}


def describe_the_door(schema: dict[str, Any]) -> None:
    """Adds to every operation how who asks is known, and that they may be refused."""
    ways = schema["components"].setdefault("securitySchemes", {})
    ways["key"] = {"type": "http", "scheme": "bearer", "description": "`sp_...`, of POST /keys."}
    for methods in schema["paths"].values():
        for operation in methods.values():
            needed = NEEDED[operation["operationId"]]
            if needed is not Anyone.STRANGER:
                operation["responses"] = CLOSED | operation["responses"]
                operation["x-permission"] = needed


def openapi_of(app: FastAPI, root_path: str = "") -> dict[str, Any]:
    """The OpenAPI description, computed once; every refusal in it is the one Problem model.

    root_path: before all its paths.
    """
    if app.openapi_schema is None:
        schema = get_openapi(
            title=app.title,
            version=app.version,
            summary=app.summary,
            routes=app.routes,
            servers=[{"url": root_path}] if root_path else None,
            openapi_version=app.openapi_version,
        )
        problem = Problem.model_json_schema(ref_template="#/components/schemas/{model}")
        definitions = problem.pop("$defs")
        schema["components"]["schemas"].update({"Problem": problem, **definitions})
        describe_unreadable_bodies(schema)
        describe_the_door(schema)
        app.openapi_schema = schema
    return app.openapi_schema
