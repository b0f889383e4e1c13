"""`spindle people ...`: accounts, straight in the data folder of a server that does not run.

For the first account on a machine without a browser, and for who lost the last password.
"""

from __future__ import annotations

import getpass
import sys
from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from backend.cli.client import print_json, print_table
from backend.cli.store import as_command, places
from backend.core.person import ROLES, Person, folded
from backend.errors import InvalidRequest, NotFound

if TYPE_CHECKING:
    from backend.people.service import Accounts

WORDS = "accounts: list, add, role, disable, enable, reset (while no server runs)"


def add_arguments(group: Any) -> None:
    """The verbs below `spindle people`."""
    verbs = (
        ("list", list_people, "who has an account"),
        ("add", add, "a new account; asks for its password"),
        ("role", role, "give somebody another role"),
        ("disable", disable, "sign somebody out everywhere; nothing of them is deleted"),
        ("enable", enable, "let them in again"),
        ("reset", reset, "another password; asks for it"),
    )
    for name, run, words in verbs:
        command = group.add_parser(name, help=words)
        command.add_argument("--data", type=Path, help="the folder of `spindle serve --data`")
        command.add_argument("--json", action="store_true", help="one JSON object")
        if run is not list_people:
            command.add_argument("name")
        if run in (add, role):
            command.add_argument("--role", choices=list(ROLES), required=True)
        if run in (add, reset):
            help_text = "one line of standard input instead of a question"
            command.add_argument("--password-stdin", action="store_true", help=help_text)
        command.set_defaults(run=run)


def list_people(options: Namespace) -> int:
    """Everybody with an account."""
    with opened(options) as accounts:
        people = accounts.list()
    if options.json:
        print_json({"items": [as_json(one) for one in people]})
    else:
        rows = [
            [one.name, one.role, "yes" if one.enabled else "no", as_json(one)["signed_in_at"]]
            for one in people
        ]
        print_table(rows, ["name", "role", "enabled", "signed in"])
    return 0


def add(options: Namespace) -> int:
    """A new account."""
    password = read_password(options)
    with opened(options) as accounts:
        return print_account(options, accounts.add(options.name, options.role, password))


def role(options: Namespace) -> int:
    """Another role."""
    return changed(options, role=options.role)


def disable(options: Namespace) -> int:
    """No way in any more."""
    return changed(options, enabled=False)


def enable(options: Namespace) -> int:
    """A way in again."""
    return changed(options, enabled=True)


def reset(options: Namespace) -> int:
    """Another password."""
    return changed(options, password=read_password(options))


def changed(options: Namespace, **change: Any) -> int:
    """Changes the account of the name on the command line. Raises NotFound."""
    from backend.people.types import PersonChange

    with opened(options) as accounts:
        folded_name = folded(options.name)
        account = next((one for one in accounts.list() if folded(one.name) == folded_name), None)
        if account is None:
            raise NotFound(f"Nobody is called {options.name!r}; `spindle people list` names all.")
        return print_account(options, accounts.change(account.id, PersonChange(**change)))


@contextmanager
def opened(options: Namespace) -> Iterator[Accounts]:
    """The accounts of a data folder. Raises StoreError while a server has it."""
    from backend.people.service import PeopleService
    from backend.store import open_store

    with as_command(), open_store(*places(options)) as store:
        yield PeopleService(store.database).accounts


def read_password(options: Namespace) -> str:
    """A password, typed twice or from a pipe; never an argument, which every user could read."""
    if options.password_stdin:
        return sys.stdin.readline().rstrip("\r\n")
    first = getpass.getpass("Password: ")
    if getpass.getpass("Again: ") != first:
        raise InvalidRequest("The two are not the same: nothing was changed.")
    return first


def print_account(options: Namespace, person: Person) -> int:
    """Says what an account is now."""
    if options.json:
        print_json(as_json(person))
    else:
        print(f"{person.name}: {person.role}{'' if person.enabled else ', disabled'}")
    return 0


def as_json(person: Person) -> dict[str, Any]:
    """An account as the API says it."""
    from pydantic import TypeAdapter

    plain: dict[str, Any] = TypeAdapter(Person).dump_python(person, mode="json")
    return plain
