"""SQL and objects: rides, revisions, the library, units, uploads, calibrations; the only door to
SQLAlchemy and pyarrow."""

from backend.store.bikes import UnitSighting
from backend.store.health import WriteFault, WriteWatch
from backend.store.logbook.book import Home, Logbook
from backend.store.logbook.derived import CardStore
from backend.store.logbook.find import RidePage, Sought
from backend.store.logbook.totals import Totals, Whose
from backend.store.marks import MarkStore
from backend.store.reader import RideReader
from backend.store.rides import RideStore
from backend.store.soundness import ROW_DAMAGED, expected_of
from backend.store.store import Store, open_store
from backend.store.upkeep.backup import StorePlace, backup_of, place_of
from backend.store.upload_rows import Upload
from backend.store.uploads import UploadStore, Verdict

__all__ = [
    "ROW_DAMAGED",
    "CardStore",
    "Home",
    "Logbook",
    "MarkStore",
    "RidePage",
    "RideReader",
    "RideStore",
    "Sought",
    "Store",
    "StorePlace",
    "Totals",
    "UnitSighting",
    "Upload",
    "UploadStore",
    "Verdict",
    "Whose",
    "WriteFault",
    "WriteWatch",
    "backup_of",
    "expected_of",
    "open_store",
    "place_of",
]
