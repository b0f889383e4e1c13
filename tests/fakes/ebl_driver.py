"""A driver whose conversation is EBL's, without the unit that services see on top of it."""

from __future__ import annotations

import time

from backend.device.driver import Driver, LinkOpener, Listener
from backend.device.ebl.session.session import Session
from backend.device.ebl.session.stream_receiver import StreamPlan


def ebl_driver(opener: LinkOpener, listener: Listener, plan: StreamPlan | None = None) -> Driver:
    """A port's thread, not started yet."""
    return Driver(opener, listener, Session(time.monotonic(), plan or StreamPlan()))
