"""A sample ride, for who has none yet: simulated, named so, and deleted as any ride."""

from __future__ import annotations

from backend.core.person import ANYBODY, Sender
from backend.errors import StoreError
from backend.formats.blocks import BLOCKS_SUFFIX
from backend.imports.service import Uploads
from backend.law.presets import sample_log
from backend.store import Store

NAME = "Sample ride, simulated"
NOTES = "Simulated by Spindle for exploring: nobody rode it."


def sample_ride(store: Store, uploads: Uploads, sender: Sender = ANYBODY) -> int:
    """Id of the sample ride, if need be of a rider: made where it is not here, else as it is.

    Raises StoreError.
    """
    upload = uploads.receive_file(NAME + BLOCKS_SUFFIX, sample_log(), sender)
    if upload.duplicate_of is not None:
        return upload.duplicate_of
    if not upload.ride_ids:
        raise StoreError(f"The sample ride was not kept: {upload.detail}")
    store.rides.patch(upload.ride_ids[0], notes=NOTES)
    return upload.ride_ids[0]
