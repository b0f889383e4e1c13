"""Passkeys of the signed-in user, and signing in with one.

A challenge is given for one answer, at one address of this server: with another process of it, or
after five minutes, it is nothing. The answer to an unknown passkey, a wrong signature, a counter
that went back and a disabled account is the same.
"""

from __future__ import annotations

import hashlib
import time
from collections.abc import Callable
from dataclasses import dataclass

from backend.core.person import Caller, Person
from backend.errors import Conflict, NotSignedIn
from backend.people.names import good_name
from backend.people.passkeys.proof import (
    ALGORITHMS,
    WRONG,
    challenge_in,
    encoded,
    new_credential,
    next_count,
)
from backend.people.passkeys.records import PasskeyStore
from backend.people.passkeys.relying_party import RelyingParty
from backend.people.passkeys.types import (
    NewPasskeyChallenge,
    Passkey,
    PasskeyChallenge,
    PasskeyIn,
    PasskeyProof,
)
from backend.people.sign_in import SignIn
from backend.people.tokens import OneUse, new_token, token_sha256

# What level 3, 15.1 recommends where a person has to be verified.
VALID_S = 300.0


@dataclass(frozen=True)
class Purpose:
    """What a challenge was given for. account_id, session_id: of who adds a passkey; None to sign
    in."""

    party: RelyingParty
    account_id: int | None = None
    session_id: int | None = None


class Passkeys:
    """Passkeys, from any thread. now_s: a clock that only goes forward."""

    def __init__(
        self,
        passkeys: PasskeyStore,
        sign_in: SignIn,
        now_s: Callable[[], float] = time.monotonic,
        now_us: Callable[[], int] = lambda: time.time_ns() // 1000,
    ) -> None:
        self._passkeys = passkeys
        self._sign_in = sign_in
        self._now_us = now_us
        # Apart: strangers, who may ask for as many as they like, push out none but strangers'.
        self._to_add: OneUse[Purpose] = OneUse(VALID_S, now_s)
        self._to_sign_in: OneUse[Purpose] = OneUse(VALID_S, now_s)

    def list(self, caller: Caller) -> tuple[Passkey, ...]:
        """The caller's, the oldest first. Raises StoreError."""
        return self._passkeys.list(caller.person.id)

    def begin(
        self, caller: Caller, password: str, party: RelyingParty, address: str
    ) -> NewPasskeyChallenge:
        """What an authenticator makes a passkey of. password: the caller's, now.

        Raises InvalidRequest `wrong_password`, TooManyTries, StoreError.
        """
        self._sign_in.require_own_password(caller, password, address)
        purpose = Purpose(party, caller.person.id, caller.session_id)
        return NewPasskeyChallenge(
            challenge=self._to_add.give(purpose),
            rp_id=party.id,
            user_handle=handle_of(caller.person),
            user_name=caller.person.name,
            algorithms=ALGORITHMS,
            known=self._passkeys.credential_ids(caller.person.id, party.id),
            valid_s=VALID_S,
        )

    def add(self, caller: Caller, answer: PasskeyIn, party: RelyingParty) -> Passkey:
        """A new passkey of the caller. Raises InvalidRequest `bad_passkey`; Conflict
        `challenge_over`, `passkeys_full`, `passkey_known`; StoreError."""
        name = good_name(answer.name)
        purpose = Purpose(party, caller.person.id, caller.session_id)
        challenge = taken(self._to_add, answer.client_data, purpose)
        credential = new_credential(answer, challenge, party)
        person_id = caller.person.id
        return self._passkeys.add(person_id, name, party.id, credential, self._now_us())

    def remove(self, caller: Caller, passkey_id: int) -> None:
        """End one of the caller's. Raises NotFound, StoreError."""
        self._passkeys.remove(caller.person.id, passkey_id)

    def begin_sign_in(self, party: RelyingParty) -> PasskeyChallenge:
        """What whoever has a passkey for this name signs."""
        challenge = self._to_sign_in.give(Purpose(party))
        return PasskeyChallenge(challenge, party.id, VALID_S)

    def sign_in(self, proof: PasskeyProof, party: RelyingParty, address: str) -> tuple[str, Person]:
        """A new session's token, and who it is. address: where the request comes from.

        Raises NotSignedIn `wrong_passkey`, Conflict `challenge_over`, TooManyTries, StoreError.
        """
        with self._sign_in.counted(address):
            challenge = taken(self._to_sign_in, proof.client_data, Purpose(party))
            known = self._passkeys.of_credential(proof.credential_id, party.id)
            if known is None or proof.user_handle != handle_of(known[2]):
                raise NotSignedIn(WRONG, "wrong_passkey")
            passkey_id, credential, _ = known
            count = next_count(proof, credential, challenge, party)
            token = new_token()
            counts = (credential.sign_count, count)
            person = self._passkeys.open(passkey_id, counts, token_sha256(token), self._now_us())
        return token, person


def taken(challenges: OneUse[Purpose], client_data: str, purpose: Purpose) -> str:
    """The challenge that an answer is to; it is used up, whatever becomes of the answer.

    Raises Conflict `challenge_over` where it was not given for this purpose, or is over.
    """
    challenge = challenge_in(client_data)
    if challenges.take(challenge) != purpose:
        raise Conflict("This took too long or was used already: begin again.", "challenge_over")
    return challenge


def handle_of(person: Person) -> str:
    """What an authenticator knows an account by: it says nothing of it (level 3, 14.6.1).

    Other servers called localhost have an account of the same number, but none made in the same
    microsecond; an authenticator keeps one passkey for a name and a handle.
    """
    text = f"spindle account {person.id} {person.created_at.isoformat()}"
    return encoded(hashlib.sha256(text.encode()).digest())
