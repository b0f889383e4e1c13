"""Work that ends when nobody waits for it any more: the page was left, or asked something else."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from typing import TypeVar

from fastapi import Request
from fastapi.concurrency import run_in_threadpool

from backend.errors import RequestRefused

Answer = TypeVar("Answer")


async def while_asked(request: Request, work: Callable[[Callable[[], None]], Answer]) -> Answer:
    """The answer of `work`, which runs in the thread pool.

    work: is given a function to call now and then, which raises once the connection of the request
    is gone. request: its body was read.
    """
    gone = threading.Event()

    def still_asked() -> None:
        if gone.is_set():
            raise RequestRefused("Nobody waits for the answer any more.", "given_up")

    async def watch() -> None:
        while (await request.receive())["type"] != "http.disconnect":
            pass
        gone.set()

    watching = asyncio.create_task(watch())
    try:
        return await run_in_threadpool(work, still_asked)
    finally:
        watching.cancel()
