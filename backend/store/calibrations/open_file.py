"""An open job as a file beside the objects: `calibrating/<hash of the unit's key>.json`.

It is written in the transaction that changes the job, so that SQL and file say the same, and a
database that is made again from its folder still has what was captured. Once the job is closed its
own file tells all, and this one goes.
"""

from __future__ import annotations

import logging
from hashlib import sha256

from backend.errors import StoreError
from backend.store.calibrations.kept import KeptCalibration, KeptCapture, document_of
from backend.store.objects import CALIBRATING, Objects

LOG = logging.getLogger(__name__)


def open_key(unit_key: str) -> str:
    """Key of the file of a unit's open job; a unit has one at most."""
    return f"{CALIBRATING}/{sha256(unit_key.encode()).hexdigest()}.json"


def keep_open(objects: Objects, job: KeptCalibration, captures: tuple[KeptCapture, ...]) -> None:
    """Write an open job with all its captures, in place of what was there. Raises StoreError."""
    objects.publish_json(open_key(job.unit_key), document_of(job, captures, None))


def forget_open(objects: Objects, unit_key: str) -> None:
    """A job is closed. A file that cannot be removed is passed over by a rebuild."""
    try:
        objects.remove(open_key(unit_key))
    except StoreError as error:
        LOG.warning("%s", error.message)
