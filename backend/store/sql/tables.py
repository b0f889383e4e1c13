"""The tables: rides with tails and figures, uploads, units, bikes, configurations, calibrations,
people, the audit.

Times are microseconds since 1970 UTC in BIGINT, because SQLite drops time zones. Primary keys are
BIGINT on PostgreSQL and the rowid on SQLite: a blob table without one doubles in size, since
SQLite then spills every blob to overflow pages (measured: 13.7 instead of 6.1 bytes a row).
"""

from __future__ import annotations

from sqlalchemy import (
    JSON,
    BigInteger,
    Boolean,
    Column,
    Float,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    String,
    Table,
    Text,
    UniqueConstraint,
)

from backend.store.sql.audit_tables import audit_event as audit_event
from backend.store.sql.audit_tables import audit_head as audit_head
from backend.store.sql.every_table import KEY, key, lasting_key
from backend.store.sql.every_table import last_number as last_number
from backend.store.sql.every_table import metadata as metadata

# One row: which folder of objects this database belongs to. rebuilding: a rebuild is not through.
# server_id: the server that took the lock last; on PostgreSQL only its transactions commit.
store_identity = Table(
    "store_identity",
    metadata,
    Column("store_id", String(32), primary_key=True),
    Column("rebuilding", Boolean, nullable=False),
    Column("server_id", String(32)),
    Column("created_us", BigInteger, nullable=False),
)

# Objects that the store itself gave up: a deleted ride's, one that a fuller one replaced. ride_id:
# whose it was before that. due_us: from when on nobody reads it any more.
discarded_object = Table(
    "discarded_object",
    metadata,
    Column("key", String(160), primary_key=True),
    Column("ride_id", KEY),
    Column("due_us", BigInteger, nullable=False, server_default="0"),
)

# Every unit there was, by the key of core.unit_key. name: its owner's.
unit = Table(
    "unit",
    metadata,
    Column("key", Text, primary_key=True),
    Column("serial_number", Text),
    Column("name", Text),
    Column("model", Text),
    Column("firmware_version", Text),
    Column("created_us", BigInteger, nullable=False),
    Column("last_seen_us", BigInteger, nullable=False),
    Column("last_url", Text),
)

bike = Table(
    "bike",
    metadata,
    lasting_key("bike"),
    Column("name", Text, nullable=False),
    Column("created_us", BigInteger, nullable=False),
    Column("model", Text),
    Column("frame_number", Text),
    Column("battery", Text),
    # What its counter showed, and when.
    Column("mileage_km", Float),
    Column("mileage_us", BigInteger),
    Column("lost_us", BigInteger),
)

# Whose a bike was, from when to when; to_us is null while it is. account_id: null once the account
# was removed; the name stays.
bike_owner = Table(
    "bike_owner",
    metadata,
    key(),
    Column("bike_id", KEY, ForeignKey("bike.id"), nullable=False, index=True),
    Column("account_id", KEY, index=True),
    Column("name", String(64), nullable=False),
    Column("from_us", BigInteger, nullable=False),
    Column("to_us", BigInteger),
)

# A code that makes its taker the bike's owner, once. owned_from_us: since when, null for then.
pairing = Table(
    "pairing",
    metadata,
    key(),
    Column("bike_id", KEY, ForeignKey("bike.id"), nullable=False, index=True),
    Column("code_sha256", String(64), nullable=False, unique=True),
    Column("owned_from_us", BigInteger),
    Column("created_us", BigInteger, nullable=False),
    Column("expires_us", BigInteger, nullable=False),
)

# Which unit was on which bike, from when to when; to_us is null while it is on it.
bike_unit = Table(
    "bike_unit",
    metadata,
    key(),
    Column("bike_id", KEY, ForeignKey("bike.id"), nullable=False, index=True),
    Column("unit_key", Text, ForeignKey("unit.key"), nullable=False, index=True),
    Column("from_us", BigInteger, nullable=False),
    Column("to_us", BigInteger),
)

revision = Table(
    "revision",
    metadata,
    key(),
    Column("unit_key", Text, ForeignKey("unit.key"), nullable=False),
    Column("parent_id", KEY, ForeignKey("revision.id")),
    Column("seq", Integer, nullable=False),
    Column("body", JSON, nullable=False),
    Column("sha256", String(64), nullable=False),
    Column("generation", BigInteger),
    Column("crc32", BigInteger),
    Column("changed", JSON, nullable=False),
    Column("author", String(128), nullable=False),
    Column("author_proof", String(16)),
    Column("reason", Text, nullable=False),
    Column("state", String(16), nullable=False),
    Column("created_us", BigInteger, nullable=False),
    UniqueConstraint("unit_key", "seq"),
)

# open_for: its bike while it is open, so that a bike has one open visit at most.
visit = Table(
    "visit",
    metadata,
    lasting_key("visit"),
    Column("token", String(32), nullable=False, unique=True),
    Column("bike_id", KEY, ForeignKey("bike.id"), nullable=False, index=True),
    Column("open_for", KEY, unique=True),
    Column("opened_us", BigInteger, nullable=False),
    Column("opened_by", String(128), nullable=False),
    Column("closed_us", BigInteger),
    Column("version", Integer, nullable=False),
    Column("imported", Integer, nullable=False),
    Column("body", JSON, nullable=False),
    Column("consent", JSON),
)

# An item of the library that its user made. name: nobody else's; null once it is deleted.
library_item = Table(
    "library_item",
    metadata,
    key(),
    Column("name", Text, unique=True),
    Column("created_us", BigInteger, nullable=False),
)

# Every state an item was in, appended and never changed. body: the whole document. deleted: from
# here on nobody sees it, and what it held last is still here.
library_version = Table(
    "library_version",
    metadata,
    key(),
    Column("item_id", KEY, ForeignKey("library_item.id"), nullable=False),
    Column("seq", Integer, nullable=False),
    Column("deleted", Boolean, nullable=False),
    Column("body", JSON, nullable=False),
    Column("sha256", String(64), nullable=False),
    Column("author", String(128), nullable=False),
    Column("author_proof", String(16)),
    Column("created_us", BigInteger, nullable=False),
    UniqueConstraint("item_id", "seq"),
)

# What was proven of a configuration, by the hash of what the law reads of it: derived, and worked
# out anew at any time. body: the limit proof as it was made first.
limit_proof = Table(
    "certificate",
    metadata,
    Column("config_sha256", String(64), primary_key=True),
    Column("method", Integer, primary_key=True, autoincrement=False),
    Column("firmware_version", String(32), primary_key=True),
    Column("sha256", String(64), nullable=False),
    Column("body", JSON, nullable=False),
    Column("created_us", BigInteger, nullable=False),
)

# A calibration of a unit's torque sensor. open_for: the unit while the job is open, so that there
# is one; null once it is closed, and then sha256 names its file. body: all but the captures.
calibration = Table(
    "calibration",
    metadata,
    key(),
    Column("unit_key", Text, ForeignKey("unit.key"), nullable=False, index=True),
    Column("bike_id", KEY, ForeignKey("bike.id"), index=True),
    Column("model", Text, index=True),
    Column("open_for", Text, unique=True),
    Column("body", JSON, nullable=False),
    Column("author", String(128), nullable=False),
    Column("author_proof", String(16)),
    Column("opened_us", BigInteger, nullable=False),
    Column("closed_us", BigInteger),
    Column("sha256", String(64), unique=True),
)

# Appended; struck: by whom, when and why it does not count any more.
calibration_capture = Table(
    "calibration_capture",
    metadata,
    key(),
    Column("calibration_id", KEY, ForeignKey("calibration.id"), nullable=False),
    Column("number", Integer, nullable=False),
    Column("body", JSON, nullable=False),
    Column("struck", JSON(none_as_null=True)),
    UniqueConstraint("calibration_id", "number"),
)

# part_of: the container it came in, which is an upload too.
upload = Table(
    "upload",
    metadata,
    key(),
    Column("token", String(32), nullable=False, unique=True),
    Column("name", Text, nullable=False),
    Column("length", BigInteger, nullable=False),
    Column("received", BigInteger, nullable=False),
    Column("declared_sha256", String(64)),
    Column("sha256", String(64), index=True),
    Column("state", String(16), nullable=False),
    Column("code", String(40)),
    Column("detail", Text),
    Column("completeness", Float),
    Column("duplicate_of", KEY),
    Column("object_key", String(128)),
    Column("created_us", BigInteger, nullable=False),
    Column("expires_us", BigInteger),
    Column("part_of", KEY, index=True),
    # Of a table that is not read before somebody says more: the hash of its header.
    Column("asks_sha256", String(64)),
    # The rider who sent it; null for others, who send anybody's. answer: what a rider said of a
    # table; of others it is kept for all its like. key_id: the key it was sent with; bike_id: the
    # one bike which that key was for.
    Column("owner_id", KEY, index=True),
    Column("answer", JSON(none_as_null=True)),
    Column("key_id", KEY, index=True),
    Column("bike_id", KEY),
)

ride = Table(
    "ride",
    metadata,
    lasting_key("ride"),
    Column("state", String(8), nullable=False, index=True),
    Column("origin", String(16), nullable=False),
    Column("name", Text, nullable=False),
    Column("notes", Text, nullable=False),
    Column("device_serial", String(64), index=True),
    Column("unit_key", Text, index=True),
    Column("bike_id", KEY, ForeignKey("bike.id"), index=True),
    Column("started_us", BigInteger, nullable=False),
    Column("row_count", BigInteger, nullable=False),
    Column("period_us", BigInteger),
    Column("channels", JSON, nullable=False),
    Column("context", JSON, nullable=False),
    Column("gaps", JSON, nullable=False),
    Column("filled", JSON, nullable=False, server_default="[]"),
    Column("sport", String(32)),
    Column("same_ride_as", KEY),
    Column("intake", JSON(none_as_null=True)),
    Column("noted", JSON(none_as_null=True)),
    Column("events", JSON, nullable=False, server_default="[]"),
    Column("completeness", Float),
    Column("upload_id", KEY, ForeignKey("upload.id"), index=True),
    Column("object_key", String(128), index=True),
    Column("object_sha256", String(64)),
    Column("object_bytes", BigInteger),
    Column("created_us", BigInteger, nullable=False),
    Column("server_id", String(32)),
    Column("heartbeat_us", BigInteger),
    Column("cut_short", Boolean),
    # Codes of doubts that somebody accepted.
    Column("accepted_doubts", JSON, nullable=False, server_default="[]"),
    # The account whose ride it is: its bike's owner when it began, or the rider who sent it.
    Column("owner_id", KEY),
    # A list goes by it, newest first; with the bike in it totals need no row of this wide table.
    Index(None, "started_us", "id", "bike_id"),
    Index(None, "owner_id", "started_us", "id"),
)

ride_tag = Table(
    "ride_tag",
    metadata,
    Column("ride_id", KEY, ForeignKey("ride.id"), primary_key=True, autoincrement=False),
    Column("tag", String(40), primary_key=True, index=True),
)

# core.ride_card.RideCard: derived, worked out anew by a newer method or for another object.
# words: all that a search looks at, in lower case, a line each, tags as #tag.
ride_card = Table(
    "ride_card",
    metadata,
    Column("ride_id", KEY, ForeignKey("ride.id"), primary_key=True, autoincrement=False),
    Column("method", Integer, nullable=False),
    Column("object_key", String(128), nullable=False),
    Column("speed_line", LargeBinary, nullable=False),
    Column("notable", Integer, nullable=False),
    Column("ascent_m", Float, index=True),
    Column("power_w_best_5s", Float, index=True),
    Column("power_w_best_60s", Float, index=True),
    Column("power_w_best_300s", Float, index=True),
    Column("power_w_best_1200s", Float, index=True),
    Column("place", Text),
    Column("country", String(2)),
    Column("zone", String(64)),
    Column("is_loop", Boolean),
    Column("words", Text, nullable=False),
    # core.doubts.Doubt, and how many of them nobody accepted.
    Column("doubts", JSON, nullable=False, server_default="[]"),
    Column("open_doubts", Integer, nullable=False, server_default="0"),
)

# core.ride_zero.RideZero: derived, like a card.
ride_zero = Table(
    "ride_zero",
    metadata,
    Column("ride_id", KEY, ForeignKey("ride.id"), primary_key=True, autoincrement=False),
    Column("method", Integer, nullable=False),
    Column("object_key", String(128), nullable=False),
    Column("zero_nm", Float),
    Column("uncertainty_nm", Float),
    Column("zero_counts", Float),
    Column("temperature_degc", Float),
    Column("pieces", Integer, nullable=False),
    Column("reason", String(16)),
)

# Whose bytes a ride lives on: it was `made` of an upload, `filled` from it, or is `beside` it, the
# same ride in another file. The original lives as long as one of its rides.
ride_source = Table(
    "ride_source",
    metadata,
    key(),
    Column("ride_id", KEY, ForeignKey("ride.id"), nullable=False),
    Column("upload_id", KEY, ForeignKey("upload.id"), nullable=False, index=True),
    Column("part", String(8), nullable=False),
    UniqueConstraint("ride_id", "upload_id"),
)

# Real columns, one for each figure of core.ride.RideSummary: they are searched and summed. Worked
# out anew by a newer method.
ride_summary = Table(
    "ride_summary",
    metadata,
    Column("ride_id", KEY, ForeignKey("ride.id"), primary_key=True),
    Column("duration_s", Float, nullable=False),
    Column("distance_source", String(16)),
    Column("method", Integer, nullable=False, server_default="0"),
    # 1 where a better recording of the same ride counts in its place.
    Column("outdone", Integer, nullable=False, server_default="0"),
    *(
        Column(name, Float)
        for name in (
            "moving_s",
            "distance_km",
            "rider_wh",
            "rider_excluded_s",
            "motor_wh",
            "motor_excluded_s",
            "battery_wh",
            "battery_excluded_s",
            "speed_kmh_mean",
            "speed_kmh_max",
            "cadence_rpm_mean",
            "cadence_rpm_max",
            "rider_torque_nm_mean",
            "rider_torque_nm_max",
            "rider_power_w_mean",
            "rider_power_w_max",
            "motor_torque_nm_max",
            "motor_power_w_mean",
            "motor_power_w_max",
            "battery_soc_pct_used",
            "motor_temperature_degc_max",
        )
    ),
)

# Records are looked up from the top.
Index(None, ride_summary.c.distance_km)
Index(None, ride_summary.c.speed_kmh_mean)

ride_tail = Table(
    "ride_tail",
    metadata,
    key(),
    Column("ride_id", KEY, ForeignKey("ride.id"), nullable=False),
    Column("row_start", BigInteger, nullable=False),
    Column("row_count", Integer, nullable=False),
    Column("payload", LargeBinary, nullable=False),
    UniqueConstraint("ride_id", "row_start"),
)

ride_lod = Table(
    "ride_lod",
    metadata,
    key(),
    Column("ride_id", KEY, ForeignKey("ride.id"), nullable=False),
    Column("step", Integer, nullable=False),
    Column("payload", LargeBinary, nullable=False),
    UniqueConstraint("ride_id", "step"),
)

# A person. folded: the name as it is compared. password: as argon2 writes it, with its salt.
account = Table(
    "account",
    metadata,
    lasting_key("account"),
    Column("name", String(64), nullable=False),
    Column("folded", String(128), nullable=False, unique=True),
    Column("role", String(16), nullable=False),
    Column("enabled", Boolean, nullable=False),
    Column("password", Text, nullable=False),
    Column("created_us", BigInteger, nullable=False),
    Column("signed_in_us", BigInteger),
)

# A browser that signed in. token_sha256: of what its cookie holds, which is kept nowhere.
session = Table(
    "session",
    metadata,
    lasting_key("session"),
    Column("account_id", KEY, ForeignKey("account.id"), nullable=False, index=True),
    Column("token_sha256", String(64), nullable=False, unique=True),
    Column("created_us", BigInteger, nullable=False),
    Column("used_us", BigInteger, nullable=False),
)

# What programs sign in with. secret_sha256: of a random secret, which is shown once.
api_key = Table(
    "api_key",
    metadata,
    lasting_key("api_key"),
    Column("account_id", KEY, ForeignKey("account.id"), nullable=False, index=True),
    Column("name", String(64), nullable=False),
    Column("prefix", String(16), nullable=False, unique=True),
    Column("secret_sha256", String(64), nullable=False),
    Column("scopes", JSON, nullable=False),
    Column("created_us", BigInteger, nullable=False),
    Column("expires_us", BigInteger),
    Column("used_us", BigInteger),
    Column("revoked_us", BigInteger),
    # The one bike whose files it sends.
    Column("bike_id", KEY, index=True),
)

# With what a browser signs in instead of a password. credential_id: base64url.
# public_key: COSE. sign_count: as the authenticator last counted; 0 for one that does not. rp_id:
# the server's name that it is for.
passkey = Table(
    "passkey",
    metadata,
    lasting_key("passkey"),
    Column("account_id", KEY, ForeignKey("account.id"), nullable=False, index=True),
    Column("credential_id", Text, nullable=False, unique=True),
    Column("public_key", LargeBinary, nullable=False),
    Column("sign_count", BigInteger, nullable=False),
    Column("rp_id", Text, nullable=False),
    Column("name", String(64), nullable=False),
    Column("created_us", BigInteger, nullable=False),
    Column("used_us", BigInteger),
)
