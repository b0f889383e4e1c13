"""What is told of passkeys, and what an authenticator answers, as the page sends it.

Bytes are base64url without padding, as browsers have them.
"""

from __future__ import annotations

from datetime import datetime
from typing import Annotated

from pydantic import Field, SecretStr

from backend.core.api_models import RequestBody
from backend.core.described import described
from backend.people.types import PASSWORD_LENGTH_MAX, NameIn

BASE64URL = r"^[A-Za-z0-9_-]*$"
# A thousand bytes of a credential's name (level 3, 5.8.3), in base64url.
CREDENTIAL_ID_MAX = 1_364
# Far beyond what authenticators send; bounds what is parsed.
Bytes = Annotated[str, Field(min_length=1, max_length=8_192, pattern=BASE64URL)]
CredentialId = Annotated[str, Field(min_length=1, max_length=CREDENTIAL_ID_MAX, pattern=BASE64URL)]


@described
class Passkey:
    """One of a person's passkeys, without its key."""

    id: int
    name: str
    rp_id: str
    """The name of this server that it is for."""
    created_at: datetime
    used_at: datetime | None


@described
class Passkeys:
    items: tuple[Passkey, ...]


@described
class PasskeyChallenge:
    """What a passkey that is there has to sign."""

    challenge: str
    """Random bytes, for one answer."""
    rp_id: str
    """The name of this server that the passkey is for."""
    valid_s: float


@described
class NewPasskeyChallenge:
    """What an authenticator is given to make a passkey."""

    challenge: str
    """Random bytes, for one answer."""
    rp_id: str
    """The name of this server that the passkey will be for."""
    user_handle: str
    """Stands for the account and says nothing of it."""
    user_name: str
    algorithms: tuple[int, ...]
    """COSE numbers of the signatures that are understood, the preferred one first."""
    known: tuple[str, ...]
    """Ids of the account's credentials for this name: an authenticator that has one makes none."""
    valid_s: float


class OwnPasswordOnly(RequestBody):
    """Whoever finds an open browser must not leave a way in behind."""

    password: SecretStr = Field(max_length=4 * PASSWORD_LENGTH_MAX)


class PasskeyIn(RequestBody):
    """What an authenticator made, and what it is called."""

    name: str = NameIn
    client_data: Bytes = Field(description="`clientDataJSON`.")
    attestation: Bytes = Field(description="`attestationObject`; `none` is enough.")


class PasskeyProof(RequestBody):
    """What an authenticator signed."""

    credential_id: CredentialId
    client_data: Bytes = Field(description="`clientDataJSON`.")
    authenticator_data: Bytes
    signature: Bytes
    user_handle: Bytes
