"""Goal: work that is done every second goes on, whatever one second of it raised.

Method: the thread itself, with a short second.
"""

from __future__ import annotations

import logging
import threading

import pytest

from backend import main
from backend.errors import StoreError


@pytest.mark.parametrize("error", [StoreError("disk full"), ValueError("odd"), MemoryError()])
def test_an_error_is_told_once_and_the_next_second_comes(
    error: Exception, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(main, "HOUSEKEEPING_S", 0.001)
    came, again = [], threading.Event()

    def work() -> None:
        came.append(1)
        if len(came) > 3:
            again.set()
            return
        raise error

    with caplog.at_level(logging.WARNING), main.every_second(cards=work):
        assert again.wait(10)

    assert [record.levelname for record in caplog.records] == ["WARNING"]
    assert "cards" in caplog.text
