"""Large JSON that does not hold the event loop up, and work that ends with its request.

FastAPI checks an answer of a `def` route on the route's thread, but turns it into JSON on the event
loop, and what is compressed is compressed there in one go: a list of 500 rides held everybody else
up for a tenth of a second. Here the text is made on the route's thread and sent in pieces, between
which others have their turn.
"""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from fastapi import Request
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import Response, StreamingResponse
from pydantic import BaseModel

from backend.errors import RequestRefused

# Compressing so much takes about a millisecond.
PIECE_BYTES = 32 * 1024
MEDIA_TYPE = "application/json"


def json_response(model: type[BaseModel], answer: Any) -> Response:
    """An answer, checked against its model, as a response that is ready but for sending."""
    return streamed_json(model.model_validate(answer).model_dump_json().encode())


def streamed_json(body: bytes | memoryview) -> Response:
    """JSON text as a response; a long one is sent piece by piece."""
    if len(body) <= PIECE_BYTES:
        return Response(bytes(body), media_type=MEDIA_TYPE)
    return StreamingResponse(chunks(bytes(body)), media_type=MEDIA_TYPE)


def chunks(body: bytes) -> Iterator[bytes]:
    """The body in order."""
    for start in range(0, len(body), PIECE_BYTES):
        yield body[start : start + PIECE_BYTES]


Answer = TypeVar("Answer")


async def while_connected(request: Request, work: Callable[[Callable[[], None]], Answer]) -> Answer:
    """The answer of `work`, which runs in the thread pool.

    work: is given a function to call now and then, which raises once the connection of the request
    is gone. request: its body was read.
    """
    gone = threading.Event()

    def check_connected() -> None:
        if gone.is_set():
            raise RequestRefused("Nobody waits for the answer any more.", "given_up")

    async def watch() -> None:
        while (await request.receive())["type"] != "http.disconnect":
            pass
        gone.set()

    watching = asyncio.create_task(watch())
    try:
        return await run_in_threadpool(work, check_connected)
    finally:
        watching.cancel()
