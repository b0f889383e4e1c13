"""An application of routes: with refusals, safety, permissions and pages. Starts nothing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fastapi import APIRouter, Depends, FastAPI
from fastapi.openapi.utils import get_openapi
from starlette.middleware.gzip import DEFAULT_EXCLUDED_CONTENT_TYPES, GZipMiddleware

from backend.core.person import Permission
from backend.web import api_docs, pages, problem
from backend.web.authentication import ActorMiddleware, Authenticator, AuthMiddleware
from backend.web.pages import RootPath
from backend.web.permissions import Anyone, Own, Ownership, require_permission
from backend.web.problem import Problem, refusals, refusals_only
from backend.web.safety import AllowedHosts, BodyBound, SameOriginOnly, SecurityHeaders
from backend.web.sockets import OpenSockets

PREFIX = "/api/v1"
# A whole ride is a file and goes another way; the largest honest JSON body is a page of points.
BODY_BYTES_MAX = 1024 * 1024
# Ride samples and files are compressed already or not worth the processor's time.
UNCOMPRESSED = (*DEFAULT_EXCLUDED_CONTENT_TYPES, "application/octet-stream", "application/vnd.*")

# What a server that asks people to sign in may answer to everything but a stranger's operations.
CLOSED = {str(status): answer for status, answer in refusals_only(401, 403).items()}
NOT_JSON = refusals(400)[400] | {"description": "The body is not JSON"}


@dataclass(frozen=True)
class WebSettings:
    """What the application needs to know of its surroundings.

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


@dataclass(frozen=True)
class Operations:
    """What an application does.

    routers: below `PREFIX`, in this order. probes: beside it, for machines. needed: the permission
    of each operation. strangers: method and path of what needs no account. own: what those may
    who have only their own.
    """

    routers: Sequence[APIRouter]
    probes: APIRouter
    needed: Mapping[str, Permission | Anyone]
    strangers: frozenset[tuple[str, str]]
    own: Mapping[str, Own] = field(default_factory=dict)


def create_app(
    settings: WebSettings,
    operations: Operations,
    services: object,
    authenticator: Authenticator | None,
    ownership: Ownership | None = None,
) -> FastAPI:
    """The application over what its routes call; with None it can only describe itself.

    authenticator: None where nobody is asked to sign in. ownership: knows what is whose.
    """
    app = FastAPI(
        title="Spindle",
        version=settings.version,
        summary="Configure, calibrate, watch and understand mid-drive e-bikes.",
        # api_docs has both, behind the same dependency as everything else.
        openapi_url=None,
        docs_url=None,
        redoc_url=None,
        dependencies=[Depends(require_permission)],
    )
    app.state.services = services
    app.state.authenticator = authenticator
    app.state.needed = operations.needed
    app.state.own = operations.own
    app.state.ownership = ownership
    app.state.upload_bytes_max = settings.upload_bytes_max
    app.state.author = settings.author
    app.state.sockets = OpenSockets()
    api = APIRouter(prefix=PREFIX)
    for router in operations.routers:
        api.include_router(router)
    app.include_router(api)
    app.include_router(operations.probes)
    problem.install(app)
    api_docs.install(app, f"{PREFIX}/openapi.json")
    pages.install(app, settings.frontend, settings.root_path)
    app.openapi = lambda: openapi_of(app, settings.root_path)  # type: ignore[method-assign]
    _protect(app, settings, operations)
    return app


def _protect(app: FastAPI, settings: WebSettings, operations: Operations) -> None:
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
    authenticator = app.state.authenticator
    signs_in = authenticator is not None
    app.add_middleware(ActorMiddleware, author=settings.author, signs_in=signs_in)
    if authenticator is not None:
        strangers = operations.strangers
        app.add_middleware(AuthMiddleware, authenticator=authenticator, strangers=strangers)
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


def describe_permissions(
    schema: dict[str, Any], needed_by: Mapping[str, Permission | Anyone]
) -> None:
    """Adds to every operation its permission, how a caller is known, and the refusals."""
    ways = schema["components"].setdefault("securitySchemes", {})
    ways["key"] = {"type": "http", "scheme": "bearer", "description": "`sp_...`, of POST /keys."}
    for methods in schema["paths"].values():
        for operation in methods.values():
            needed = needed_by[operation["operationId"]]
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
        describe_permissions(schema, app.state.needed)
        app.openapi_schema = schema
    return app.openapi_schema
