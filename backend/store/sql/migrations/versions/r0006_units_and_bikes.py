"""Units by their keys, and the bikes they are on: one bike for every unit there was."""

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0006"
down_revision = "0005"
branch_labels = None
depends_on = None

KEY = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
# Every unit of before keys was of this family.
FAMILY = "ebl"
NAMES = (
    *("id", "parent_id", "seq", "body", "sha256", "generation", "crc32"),
    *("changed", "author", "reason", "state", "created_us"),
)
REVISION_COLUMNS = ", ".join(NAMES)


def upgrade() -> None:
    """Units, bikes and revisions by the unit's key, and both in rides."""
    make_tables()
    op.add_column("ride", sa.Column("unit_key", sa.Text()))
    # With its constraint in one statement: SQLite would copy the table for a separate one.
    link = "CONSTRAINT fk_ride_bike_id_bike REFERENCES bike (id)"
    op.execute(f"ALTER TABLE ride ADD COLUMN bike_id {key_type()} {link}")
    for column in ("unit_key", "bike_id"):
        op.create_index(f"ix_ride_{column}", "ride", [column])
    fill_units()
    make_bikes()
    op.execute(
        f"UPDATE ride SET unit_key = '{FAMILY}:' || device_serial WHERE device_serial IS NOT NULL"
    )
    op.execute(
        "UPDATE ride SET bike_id = (SELECT bike_id FROM bike_unit "
        "WHERE bike_unit.unit_key = ride.unit_key)"
    )
    op.execute(
        f"INSERT INTO revision (unit_key, {REVISION_COLUMNS}) "
        f"SELECT '{FAMILY}:' || device.serial, {qualified('config_revision')} "
        "FROM config_revision JOIN device ON device.id = config_revision.device_id "
        "ORDER BY config_revision.id"
    )
    count_on("revision")
    op.drop_table("config_revision")
    op.drop_table("device")


def qualified(table: str) -> str:
    return ", ".join(f"{table}.{name}" for name in NAMES)


def key_type() -> str:
    return "BIGINT" if op.get_bind().dialect.name == "postgresql" else "INTEGER"


def count_on(table: str) -> None:
    """PostgreSQL's own count goes on behind the rows that brought their ids."""
    if op.get_bind().dialect.name == "postgresql":
        op.execute(
            f"SELECT setval(pg_get_serial_sequence('{table}', 'id'), greatest(max(id), 1)) "
            f"FROM {table}"
        )


def make_tables() -> None:
    op.create_table(
        "unit",
        sa.Column("key", sa.Text(), nullable=False),
        sa.Column("serial_number", sa.Text()),
        sa.Column("name", sa.Text()),
        sa.Column("model", sa.Text()),
        sa.Column("firmware_version", sa.Text()),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.Column("last_seen_us", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("key", name="pk_unit"),
    )
    op.create_table(
        "bike",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("name", sa.Text(), nullable=False),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_bike"),
    )
    op.create_table(
        "bike_unit",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("bike_id", KEY, nullable=False),
        sa.Column("unit_key", sa.Text(), nullable=False),
        sa.Column("from_us", sa.BigInteger(), nullable=False),
        sa.Column("to_us", sa.BigInteger()),
        sa.ForeignKeyConstraint(["bike_id"], ["bike.id"], name="fk_bike_unit_bike_id_bike"),
        sa.ForeignKeyConstraint(["unit_key"], ["unit.key"], name="fk_bike_unit_unit_key_unit"),
        sa.PrimaryKeyConstraint("id", name="pk_bike_unit"),
    )
    for column in ("bike_id", "unit_key"):
        op.create_index(f"ix_bike_unit_{column}", "bike_unit", [column])
    make_revisions("revision", sa.Column("unit_key", sa.Text(), nullable=False), "unit.key")


def make_revisions(table: str, owner: "sa.Column[Any]", owner_key: str) -> None:
    """Configurations in order, of whoever has them."""
    parent, link = f"fk_{table}_parent_id_{table}", f"fk_{table}_{owner.name}_"
    op.create_table(
        table,
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        owner,
        sa.Column("parent_id", KEY),
        sa.Column("seq", sa.Integer(), nullable=False),
        sa.Column("body", sa.JSON(), nullable=False),
        sa.Column("sha256", sa.String(64), nullable=False),
        sa.Column("generation", sa.BigInteger()),
        sa.Column("crc32", sa.BigInteger()),
        sa.Column("changed", sa.JSON(), nullable=False),
        sa.Column("author", sa.String(128), nullable=False),
        sa.Column("reason", sa.Text(), nullable=False),
        sa.Column("state", sa.String(16), nullable=False),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint([owner.name], [owner_key], name=link + owner_key.split(".")[0]),
        sa.ForeignKeyConstraint(["parent_id"], [f"{table}.id"], name=parent),
        sa.PrimaryKeyConstraint("id", name=f"pk_{table}"),
        sa.UniqueConstraint(owner.name, "seq", name=f"uq_{table}_{owner.name}_seq"),
    )


def fill_units() -> None:
    """Every unit that was seen, has a configuration or rode."""
    op.execute(
        "INSERT INTO unit "
        "(key, serial_number, model, firmware_version, created_us, last_seen_us) "
        f"SELECT '{FAMILY}:' || serial, serial, model, firmware_version, created_us, last_seen_us "
        "FROM device"
    )
    op.execute(
        "INSERT INTO unit (key, serial_number, created_us, last_seen_us) "
        f"SELECT '{FAMILY}:' || device_serial, device_serial, min(started_us), max(started_us) "
        "FROM ride WHERE device_serial IS NOT NULL "
        "AND device_serial NOT IN (SELECT serial FROM device) GROUP BY device_serial"
    )


def make_bikes() -> None:
    """A bike for every unit, since the first that is known of it."""
    connection = op.get_bind()
    units = connection.execute(
        sa.text(
            "SELECT serial_number, model, created_us, (SELECT min(started_us) FROM ride "
            "WHERE ride.device_serial = unit.serial_number) AS rode_us FROM unit "
            "ORDER BY created_us, key"
        )
    ).all()
    bike = sa.table("bike", sa.column("id", KEY), sa.column("name"), sa.column("created_us"))
    bike_unit = sa.table(
        "bike_unit", sa.column("bike_id"), sa.column("unit_key"), sa.column("from_us")
    )
    for unit in units:
        name = " ".join(filter(None, (unit.model, unit.serial_number[-6:])))
        values = {"name": name, "created_us": unit.created_us}
        made = connection.execute(sa.insert(bike).values(values).returning(bike.c.id))
        from_us = unit.created_us if unit.rode_us is None else min(unit.created_us, unit.rode_us)
        connection.execute(
            sa.insert(bike_unit).values(
                bike_id=made.scalar_one(),
                unit_key=f"{FAMILY}:{unit.serial_number}",
                from_us=from_us,
            )
        )


def downgrade() -> None:
    """Units by serial number again. Those without one, and what is theirs, are given up."""
    op.create_table(
        "device",
        sa.Column("id", KEY, autoincrement=True, nullable=False),
        sa.Column("serial", sa.String(64), nullable=False),
        sa.Column("model", sa.String(64)),
        sa.Column("firmware_version", sa.String(32)),
        sa.Column("created_us", sa.BigInteger(), nullable=False),
        sa.Column("last_seen_us", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_device"),
        sa.UniqueConstraint("serial", name="uq_device_serial"),
    )
    op.execute(
        "INSERT INTO device (serial, model, firmware_version, created_us, last_seen_us) "
        "SELECT serial_number, model, firmware_version, created_us, last_seen_us "
        f"FROM unit WHERE key = '{FAMILY}:' || serial_number"
    )
    make_revisions("config_revision", sa.Column("device_id", KEY, nullable=False), "device.id")
    op.execute(
        f"INSERT INTO config_revision (device_id, {REVISION_COLUMNS}) "
        f"SELECT device.id, {qualified('revision')} "
        f"FROM revision JOIN device ON revision.unit_key = '{FAMILY}:' || device.serial "
        "ORDER BY revision.id"
    )
    count_on("config_revision")
    with op.batch_alter_table("ride") as ride:
        ride.drop_index("ix_ride_bike_id")
        ride.drop_index("ix_ride_unit_key")
        ride.drop_column("bike_id")
        ride.drop_column("unit_key")
    for name in ("revision", "bike_unit", "bike", "unit"):
        op.drop_table(name)
