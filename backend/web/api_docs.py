"""`/api/docs`: the API for people to read, written by the server without a script.

The usual viewers fetch their code from other machines; nothing here may leave this one.
"""

from __future__ import annotations

from html import escape
from typing import Any

from fastapi import FastAPI
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import HTMLResponse, JSONResponse

STYLE = """
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
code, summary { font-family: ui-monospace, monospace; }
details { border-top: 1px solid #8884; padding: .4rem 0; }
table { border-collapse: collapse; } td { padding: .1rem 1rem .1rem 0; vertical-align: top; }
"""


def install(app: FastAPI, source: str) -> None:
    """Adds the page, and the description itself at `source`.

    Describing takes seconds where it is asked first: never on the event loop.
    """

    @app.get("/api/docs", operation_id="get_docs", include_in_schema=False)
    async def docs() -> HTMLResponse:
        return HTMLResponse(await run_in_threadpool(lambda: page(app.openapi(), source)))

    @app.get(source, operation_id="get_description", include_in_schema=False)
    async def description() -> JSONResponse:
        return JSONResponse(await run_in_threadpool(app.openapi))


def page(description: dict[str, Any], source: str) -> str:
    """The whole page from an OpenAPI description. source: where the description itself is."""
    info = description["info"]
    operations = [
        operation_html(method, path, operation)
        for path, methods in description["paths"].items()
        for method, operation in methods.items()
    ]
    schemas = [
        schema_html(name, schema)
        for name, schema in sorted(description["components"]["schemas"].items())
    ]
    title = f"{escape(info['title'])} {escape(info['version'])} API"
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title>'
        f'<meta name="viewport" content="width=device-width"><style>{STYLE}</style>'
        f"<h1>{title}</h1><p>{escape(info.get('summary', ''))} For programs: "
        # From /api/docs, wherever that is.
        f'<a href="{escape(source.removeprefix("/api/"))}">{escape(source)}</a>. Refusals are '
        '<a href="#Problem">Problem</a> objects as application/problem+json.</p>'
        f"<h2>Routes</h2>{''.join(operations)}<h2>Shapes</h2>{''.join(schemas)}</html>"
    )


def operation_html(method: str, path: str, operation: dict[str, Any]) -> str:
    """One route, folded: what it does, takes and answers."""
    rows = [
        (parameter["in"], parameter["name"], parameter.get("description", ""))
        for parameter in operation.get("parameters", [])
    ]
    content = operation.get("requestBody", {}).get("content", {})
    rows += [("body", link_or_type(body.get("schema", {})), kind) for kind, body in content.items()]
    for status, answer in operation["responses"].items():
        kinds = answer.get("content", {})
        shapes = " or ".join(link_or_type(kind.get("schema", {})) for kind in kinds.values())
        rows.append((status, shapes, answer.get("description", "")))
    cells = "".join(
        f"<tr><td>{escape(where)}<td><code>{name}</code><td>{escape(words)}"
        for where, name, words in rows
    )
    return (
        f"<details><summary>{method.upper()} {escape(path)}</summary>"
        f"<p>{escape(operation.get('description', ''))}</p><table>{cells}</table></details>"
    )


def schema_html(name: str, schema: dict[str, Any]) -> str:
    """One shape: its members and their types."""
    cells = "".join(
        f"<tr><td><code>{escape(member)}</code><td>{link_or_type(kind)}"
        f"<td>{escape(kind.get('description', ''))}"
        for member, kind in schema.get("properties", {}).items()
    )
    words = escape(schema.get("description", ""))
    return f'<h3 id="{escape(name)}">{escape(name)}</h3><p>{words}</p><table>{cells}</table>'


def link_or_type(schema: dict[str, Any]) -> str:
    """A type in a word, or a link to the shape it is."""
    if "$ref" in schema:
        name = escape(str(schema["$ref"]).rsplit("/", 1)[-1])
        return f'<a href="#{name}">{name}</a>'
    if "anyOf" in schema:
        return " or ".join(dict.fromkeys(link_or_type(choice) for choice in schema["anyOf"]))
    if "enum" in schema:
        return escape(" | ".join(str(choice) for choice in schema["enum"]))
    if schema.get("type") == "array":
        return f"list of {link_or_type(schema.get('items', {}))}"
    return escape(str(schema.get("const") or schema.get("type") or "any"))
