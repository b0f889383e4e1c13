"""Where everything is kept, as the API tells it."""

from __future__ import annotations

from pydantic import Field

from backend.web.models import Answer


class StorePlace(Answer):
    """The database and the folder of rides and files, with what they hold."""

    database: str = Field(description="Its URL, without a password.")
    folder: str = Field(description="Of rides and originals, on the server's machine.")
    rides: int
    database_bytes: int | None = Field(description="Null where a database server keeps it.")
    object_bytes: int
    free_bytes: int = Field(description="On the disk of the folder.")
