"""Runs operations over the request table: several side by side, each from top to bottom."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, TypeVar

from backend.device.conversation import OnError, OnResult
from backend.device.ebl.session.operation import Operation, Question
from backend.device.ebl.session.requests import RequestTable
from backend.errors import LinkError, SpindleError
from firmware_protocol.codec import Response

Result = TypeVar("Result")

# Operations at the same time; a person and a page's refreshes need three or four.
RUNNING_MAX = 32


class OperationRunner:
    """Feeds each operation's questions to the request table and the responses back to it."""

    def __init__(self, requests: RequestTable) -> None:
        self._requests = requests
        # Each operation with what makes its present questions fail.
        self._running: dict[Operation[Any], Callable[[SpindleError], None]] = {}

    @property
    def is_idle(self) -> bool:
        """Whether no operation runs."""
        return not self._running

    def start(
        self, operation: Operation[Result], on_result: OnResult[Result], on_error: OnError
    ) -> None:
        """Start an operation; exactly one of the two callbacks is called, perhaps at once."""
        if len(self._running) >= RUNNING_MAX:
            operation.close()
            on_error(LinkError("The unit has too much to do already; try again in a moment."))
            return
        self._running[operation] = lambda error: None
        self._resume(operation, lambda: next(operation), on_result, on_error)

    def abandon(self, operation: Operation[Any], error: SpindleError) -> None:
        """Give an operation this error in place of the answers it waits for.

        Its questions are taken back, so that nothing of it is sent behind its back; what it asks
        from there on (a change that is given up tells the unit) is asked as ever.
        """
        if operation in self._running:
            self._running[operation](error)

    def _resume(
        self,
        operation: Operation[Result],
        step: Callable[[], Sequence[Question]],
        on_result: OnResult[Result],
        on_error: OnError,
    ) -> None:
        """Run the operation to its next questions and submit them."""
        try:
            questions = step()
        except StopIteration as end:
            self._running.pop(operation, None)
            on_result(end.value)
            return
        except Exception as error:
            # An operation's error, a bug included, belongs to whoever asked for it.
            self._running.pop(operation, None)
            on_error(error)
            return
        answers = _Answers(len(questions))
        withdrawals: list[Callable[[], None]] = []

        def on_answer(index: int, answer: Response | SpindleError) -> None:
            if isinstance(answer, SpindleError):
                if answers.fail():
                    self._resume(operation, lambda: operation.throw(answer), on_result, on_error)
            elif answers.fill(index, answer):
                self._resume(
                    operation, lambda: operation.send(answers.responses), on_result, on_error
                )

        def abandoned(error: SpindleError) -> None:
            for withdraw in withdrawals:
                withdraw()
            on_answer(0, error)

        self._running[operation] = abandoned
        for index, question in enumerate(questions):
            try:
                withdrawals.append(self._requests.submit(question, partial(on_answer, index)))
            except SpindleError as error:
                on_answer(index, error)


class _Answers:
    """The responses of questions that are on the way together."""

    def __init__(self, count: int) -> None:
        self._responses: dict[int, Response] = {}
        self._count = count
        self._failed = False

    @property
    def responses(self) -> list[Response]:
        return [self._responses[index] for index in range(self._count)]

    def fill(self, index: int, response: Response) -> bool:
        """Keep a response; True when it was the last and none failed."""
        self._responses[index] = response
        return len(self._responses) == self._count and not self._failed

    def fail(self) -> bool:
        """Note a failure; True for the first."""
        first = not self._failed
        self._failed = True
        return first
