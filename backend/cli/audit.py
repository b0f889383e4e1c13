"""`spindle audit verify`: asks no server, since who runs it may be whom the audit is about."""

from __future__ import annotations

import re
from argparse import Namespace
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from backend.cli.client import print_json
from backend.cli.store import places
from backend.errors import InvalidRequest

if TYPE_CHECKING:
    from backend.store.upkeep.audit import ChainCheck

WORDS = "who changed what: verify (reads the folder, beside a server, too)"
SHA256 = re.compile(r"[0-9a-f]{64}")


def add_arguments(group: Any) -> None:
    """The verbs below `spindle audit`."""
    words = "walk the chain of events; 1 where one does not fit"
    command = group.add_parser("verify", help=words)
    command.add_argument("--data", type=Path, help="the folder of `spindle serve --data`")
    command.add_argument("--json", action="store_true", help="one JSON object")
    help_text = "a hash that was noted before: prove that it is part of the chain"
    command.add_argument("--expect", metavar="SHA256", type=str.lower, help=help_text)
    command.set_defaults(run=verify)


def verify(options: Namespace) -> int:
    """Says how many events fit and the last one's hash, or the first that does not fit; 1 then, and
    where the hash that was looked for is none of the chain's."""
    from backend.store.upkeep.audit import verify_audit

    expected = options.expect
    if expected is not None and not SHA256.fullmatch(expected):
        raise InvalidRequest("--expect takes a SHA-256: 64 digits from 0 to f.")
    check = verify_audit(places(options)[0], expected)
    is_fine = check.misfit is None and (expected is None or check.expected_id is not None)
    if options.json:
        print_json({"ok": is_fine, **asdict(check)})
    else:
        print_check(check, expected)
    return 0 if is_fine else 1


def print_check(check: ChainCheck, expected: str | None) -> None:
    """The check as a person reads it."""
    if check.misfit is not None:
        print(f"Event {check.misfit.event_id} does not fit: {check.misfit.reason}.")
        print(f"{check.events} events before it fit; the last of them has the hash")
        print(f"  {check.head_sha256}")
    else:
        print(f"{check.events} events, and every one fits. The last one has the hash")
        print(f"  {check.head_sha256}")
        print("Note it elsewhere: it alone shows later that no event was cut off the end.")
    if expected is not None and check.expected_id is not None:
        print(f"The hash you expect is event {check.expected_id}: up to there nothing was changed.")
    elif expected is not None:
        print("The hash you expect is none of these: events were cut off, or made anew.")
