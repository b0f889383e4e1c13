"""Whether an authenticator's answer proves what it should. The only user of webauthn.

The library is loaded with the first passkey: it takes a third of a second, and its parsers of
attestations of all makes are asked nothing here.
"""

from __future__ import annotations

import json
from base64 import urlsafe_b64decode, urlsafe_b64encode
from dataclasses import dataclass

from backend.errors import InvalidRequest, NotSignedIn
from backend.people.passkeys.relying_party import RelyingParty
from backend.people.passkeys.types import PasskeyIn, PasskeyProof

# COSE: EdDSA, ES256, RS256; what level 3, 5.4 asks for at least, and Windows Hello has.
ALGORITHMS = (-8, -7, -257)
# None, or the authenticator's own signature: neither says of which make it is.
ATTESTATIONS = ("none", "packed")
WRONG = "This passkey is not known here, or it did not prove itself."


@dataclass(frozen=True)
class Credential:
    """What is kept of a passkey. id: base64url. public_key: COSE. sign_count: its counter."""

    id: str
    public_key: bytes
    sign_count: int


def decoded(text: str) -> bytes:
    """Bytes of base64url. Raises ValueError."""
    return urlsafe_b64decode(text + "=" * (-len(text) % 4))


def encoded(data: bytes) -> str:
    """Bytes as base64url without padding."""
    return urlsafe_b64encode(data).rstrip(b"=").decode()


def challenge_in(client_data: str) -> str:
    """The challenge that an answer is to; empty where it names none."""
    try:
        challenge = json.loads(decoded(client_data))["challenge"]
    except (ValueError, TypeError, KeyError, RecursionError):
        return ""
    return challenge if isinstance(challenge, str) else ""


def new_credential(answer: PasskeyIn, challenge: str, party: RelyingParty) -> Credential:
    """What an authenticator made. Raises InvalidRequest `bad_passkey`.

    challenge: that was given for it. party: where it is added.
    """
    from webauthn import verify_registration_response
    from webauthn.helpers import parse_attestation_object
    from webauthn.helpers.cose import COSEAlgorithmIdentifier
    from webauthn.helpers.structs import AuthenticatorAttestationResponse, RegistrationCredential

    try:
        attestation = decoded(answer.attestation)
        made = parse_attestation_object(attestation)
        if made.fmt not in ATTESTATIONS or made.auth_data.attested_credential_data is None:
            raise ValueError("an attestation that nobody asked for")
        number = made.auth_data.attested_credential_data.credential_id
        response = AuthenticatorAttestationResponse(decoded(answer.client_data), attestation)
        verified = verify_registration_response(
            credential=RegistrationCredential(encoded(number), number, response),
            expected_challenge=decoded(challenge),
            expected_rp_id=party.id,
            expected_origin=party.origin,
            require_user_verification=True,
            supported_pub_key_algs=[COSEAlgorithmIdentifier(one) for one in ALGORITHMS],
        )
    # Whatever its parsers raise: anybody's bytes go in.
    except Exception as error:
        message = "What the authenticator made cannot be taken: try again, or use another."
        raise InvalidRequest(message, "bad_passkey") from error
    return Credential(
        encoded(verified.credential_id), verified.credential_public_key, verified.sign_count
    )


def next_count(
    proof: PasskeyProof, credential: Credential, challenge: str, party: RelyingParty
) -> int:
    """The counter of an authenticator that proved to have a credential.

    It has gone on since the last time, or is 0 as it always was: a copy of an authenticator shows
    by one that went back. Raises NotSignedIn `wrong_passkey`.
    """
    from webauthn import verify_authentication_response
    from webauthn.helpers.structs import AuthenticationCredential, AuthenticatorAssertionResponse

    try:
        response = AuthenticatorAssertionResponse(
            decoded(proof.client_data), decoded(proof.authenticator_data), decoded(proof.signature)
        )
        verified = verify_authentication_response(
            credential=AuthenticationCredential(credential.id, decoded(credential.id), response),
            expected_challenge=decoded(challenge),
            expected_rp_id=party.id,
            expected_origin=party.origin,
            credential_public_key=credential.public_key,
            credential_current_sign_count=credential.sign_count,
            require_user_verification=True,
        )
    # Whatever its parsers raise: anybody's bytes go in.
    except Exception as error:
        raise NotSignedIn(WRONG, "wrong_passkey") from error
    return verified.new_sign_count
