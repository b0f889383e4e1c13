"""What a table does not say is asked once, and what its owner says is kept for its like."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Future, wait
from contextlib import suppress
from dataclasses import asdict
from functools import partial
from typing import Any

from backend.core.audit import Action, AuditEntry, Members, Note, differing, no_note
from backend.errors import Conflict, FieldError, InvalidRequest, NotAllowed
from backend.formats import NEEDS_MAPPING
from backend.formats.questions import (
    LEFT_OUT,
    TIME,
    TableAnswer,
    TableQuestion,
    answer_from_json,
    answer_to_json,
    lacking,
)
from backend.formats.tables.measures import OFFERED
from backend.imports.container import PART_ASKS
from backend.imports.records import TableAnswers
from backend.imports.service import Uploads
from backend.store import Store, Upload

UNITS_OF = {offered.name: offered.units for offered in OFFERED}


class TableMapping:
    """The use cases; safe to call from any thread. note: adds to the audit."""

    def __init__(self, store: Store, uploads: Uploads, note: Note = no_note) -> None:
        self._store = store
        self._note = note
        self._answers = TableAnswers(store.objects)
        self._uploads = uploads

    def question(self, upload_id: str) -> dict[str, object]:
        """What can be said of an upload's table: the question and what is known already.

        Raises NotFound; Conflict when nothing can be said of it.
        """
        upload = self._uploads.answerable(upload_id)
        question = self._uploads.question(upload)
        header, owner_id = question.header_sha256, upload.owner_id
        stored = self._uploads.answer_for(upload, header)
        if stored is not None:
            # What was said of one column can open a question about another.
            with suppress(Conflict):
                question = self._uploads.question(upload, stored)
        answer = answer_to_json(stored) if stored else None
        read = set(self._store.uploads.read_by(header, owner_id)) - {upload.id}
        known = {"offered_channels": OFFERED, "answer": answer, "files_read": len(read)}
        return asdict(question) | known

    def say(self, upload_id: str, values: Mapping[str, Any], *, read_again: bool = False) -> Upload:
        """Keep an answer and read the file by it; what became of it. Rides that were made of it
        become what it says now. Of a file that a rider sent the answer is that rider's alone.

        All others that wait for the same are read behind it, and each tells for itself what became
        of it; then the containers they are within are judged anew. values: the members of
        TableAnswer. A file whose answer opens another question waits for that, if it is no ride
        yet. read_again: whether other files with this header that were read are read by it, too.
        Raises NotFound, Conflict, NotAllowed; InvalidRequest for an answer that lacks something, or
        says what cannot be.
        """
        answer = answer_from_json(values) or TableAnswer()
        upload = self._uploads.answerable(upload_id)
        if upload.owner_id != self._uploads.get(upload_id).owner_id:
            raise NotAllowed("The workshop sent this file before: it says what its columns are.")
        # A file that is no ride yet can wait for what its answer opens.
        question = self._uploads.question(upload, answer if upload.ride_ids else None)
        check(question, answer)
        header, owner_id = question.header_sha256, upload.owner_id
        before = self._uploads.answer_for(upload, header)
        if owner_id is None:
            self._answers.save(question, answer)
        else:
            self._store.uploads.keep_answer(upload.id, header, answer_to_json(answer))
        self._note_answer(Action.TABLE_ANSWERED, header, before, answer)
        others = [*self._store.uploads.asking(NEEDS_MAPPING, header, owner_id)]
        if read_again:
            others += self._store.uploads.read_by(header, owner_id)
        upload_id = upload.id
        containers = {one: self._uploads.get(one).part_of for one in (upload_id, *others)}
        read = {one: self._uploads.read_anew(one) for one in containers}
        own = containers[upload_id]
        for one, container in containers.items():
            if container is not None and container != own:
                read[one].add_done_callback(partial(self._judge_behind, container))
        became = read[upload_id].result()
        if own is not None:
            wait([read[one] for one, container in containers.items() if container == own])
            self._judge_anew(own)
        return became

    def _judge_behind(self, container: str, _: Future[Upload]) -> None:
        self._judge_anew(container)

    def _judge_anew(self, container: str) -> None:
        """Look at a container again when the last file within is read; new rides get their names.

        Not before: it would have a file read once more that is concluded meanwhile.
        """
        waits = any(part.state == "queued" for part in self._store.uploads.parts(container))
        if not waits and self._uploads.get(container).code == PART_ASKS:
            self._uploads.read_anew(container)

    def answered_tables(self) -> dict[str, object]:
        """What was said of which tables."""
        return {"items": [asdict(table) for table in self._answers.all()]}

    def forget(self, header_sha256: str) -> None:
        """Ask again from now on; rides that were read stay as they are. Raises NotFound."""
        stored = self._answers.get(header_sha256)
        self._answers.forget(header_sha256)
        before = None if stored is None else stored.answer
        self._note_answer(Action.TABLE_FORGOTTEN, header_sha256, before, None)

    def _note_answer(
        self, action: Action, header: str, before: TableAnswer | None, after: TableAnswer | None
    ) -> None:
        sides: list[Members] = [
            {} if one is None else answer_to_json(one) for one in (before, after)
        ]
        old, new = differing(*sides)
        self._note(AuditEntry(action, header, None, old, new))


def check(question: TableQuestion, answer: TableAnswer) -> None:
    """Raises InvalidRequest for an answer that lacks something, or says what cannot be."""
    if missing := lacking(question, answer):
        sentence = f"Not said, or not one of what can be said: {', '.join(missing)}."
        fields = [FieldError(name, "not_said", sentence) for name in missing]
        raise InvalidRequest(sentence, code="answer_incomplete", fields=fields)
    if wrong := wrong_statements(question, answer):
        sentence = " ".join(field.message for field in wrong)
        raise InvalidRequest(sentence, code="answer_wrong", fields=wrong)


def wrong_statements(question: TableQuestion, answer: TableAnswer) -> list[FieldError]:
    """What is said of columns that there are not, or that they cannot be."""
    columns = {column.name: column for column in question.columns}
    faults = []
    for name, channel in answer.channels.items():
        column, units = columns.get(name), UNITS_OF.get(channel, ())
        if column is None:
            faults.append(FieldError(name, "no_column", f"The table has no column {name}."))
        elif column.channel == TIME:
            faults.append(FieldError(name, "is_time", f"{name} tells the time."))
        elif channel != LEFT_OUT and channel not in UNITS_OF:
            sentence = f"{name} cannot be {channel}: it is one of {', '.join(UNITS_OF)}."
            faults.append(FieldError(name, "unknown_channel", sentence))
        elif units and answer.units.get(name, units[0]) not in units:
            sentence = f"{name} is in {', '.join(units)}; not in {answer.units[name]}."
            faults.append(FieldError(name, "unknown_unit", sentence))
    return faults
