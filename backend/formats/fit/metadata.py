"""What a FIT file tells beside its records: laps, pauses of the timer, and the devices it heard."""

from __future__ import annotations

import numpy as np

from backend.core.device_metadata import (
    INSTRUMENTS_MAX,
    LAPS_MAX,
    PAUSES_MAX,
    DeviceMetadata,
    Instrument,
    Lap,
    Pause,
)
from backend.formats.fit.fields import Bytes, Table, table_of, text
from backend.formats.fit.layout import Part
from backend.formats.fit.metadata_words import (
    BATTERY_STATUS,
    DEVICE_KINDS,
    LAP_TRIGGERS,
    LOCAL_KINDS,
    MANUFACTURERS,
)
from backend.formats.fit.profile import ProfileField
from backend.formats.fit_numbers import DEVICE_INFO, EPOCH_S, EVENT, LAP

LAP_FIELDS = {
    2: ProfileField("start_time"),
    7: ProfileField("total_elapsed_time", "s", 1000),
    8: ProfileField("total_timer_time", "s", 1000),
    9: ProfileField("total_distance", "m", 100),
    11: ProfileField("total_calories", "kcal"),
    24: ProfileField("lap_trigger"),
}
EVENT_FIELDS = {
    0: ProfileField("event"),
    1: ProfileField("event_type"),
    3: ProfileField("data"),
}
DEVICE_FIELDS = {
    0: ProfileField("device_index"),
    1: ProfileField("device_type"),
    2: ProfileField("manufacturer"),
    3: ProfileField("serial_number"),
    4: ProfileField("product"),
    5: ProfileField("software_version", "", 100),
    10: ProfileField("battery_voltage", "V", 256),
    11: ProfileField("battery_status"),
    25: ProfileField("source_type"),
}
PRODUCT_NAME = 27
TIMER, TIMER_STARTS, TIMER_STOPS = 0, (0,), (1, 4, 8, 9)
BY_HAND, BY_ITSELF = 0, 1
# Index of the device that wrote the file, and the source of what is built into it.
CREATOR, LOCAL = 0, 5


def metadata_of(data: bytes, cells: Bytes, part: Part) -> DeviceMetadata:
    """Laps and pauses with their times as Unix seconds, and the instruments."""
    return DeviceMetadata(
        laps_of(table_of(cells, part.of(LAP), LAP_FIELDS)),
        pauses_of(table_of(cells, part.of(EVENT), EVENT_FIELDS)),
        instruments_of(data, cells, part),
    )


def laps_of(laps: Table) -> tuple[Lap, ...]:
    """Every lap with a recorded beginning and end."""
    elapsed_s = laps.values("total_elapsed_time")
    ends_s, starts_s = laps.time_s, laps.values("start_time")
    starts_s = np.where(np.isnan(starts_s), ends_s - elapsed_s, starts_s)
    ends_s = np.where(np.isnan(elapsed_s), ends_s, starts_s + elapsed_s)
    triggers = laps.values("lap_trigger")
    read_laps = []
    for row in np.flatnonzero(ends_s > starts_s)[:LAPS_MAX]:
        columns = {
            name: number_or_none(laps.values(field)[row])
            for name, field in (
                ("timer_s", "total_timer_time"),
                ("distance_m", "total_distance"),
                ("calories_kcal", "total_calories"),
            )
        }
        trigger = number_or_none(triggers[row])
        word = None if trigger is None else LAP_TRIGGERS.get(int(trigger), "other")
        begins_s, over_s = EPOCH_S + float(starts_s[row]), EPOCH_S + float(ends_s[row])
        read_laps.append(Lap(begins_s, over_s, word, **columns))
    return tuple(read_laps)


def pauses_of(events: Table) -> tuple[Pause, ...]:
    """From each stop of the timer to its next start; a stop that ends the file is none."""
    kinds, who = events.values("event_type"), events.values("data")
    timer = np.flatnonzero((events.values("event") == TIMER) & np.isfinite(events.time_s))
    stopped: int | None = None
    pauses: list[Pause] = []
    for row in timer[np.argsort(events.time_s[timer], kind="stable")]:
        if kinds[row] in TIMER_STOPS and stopped is None:
            stopped = int(row)
        elif kinds[row] in TIMER_STARTS and stopped is not None:
            from_s, to_s = (EPOCH_S + float(events.time_s[at]) for at in (stopped, row))
            by = {BY_HAND: True, BY_ITSELF: False}.get(who[stopped])
            if to_s > from_s and len(pauses) < PAUSES_MAX:
                pauses.append(Pause(from_s, to_s, by))
            stopped = None
    return tuple(pauses)


def instruments_of(data: bytes, cells: Bytes, part: Part) -> tuple[Instrument, ...]:
    """Each device once, by its index in the file: devices are listed again as they are detected."""
    table = table_of(cells, part.of(DEVICE_INFO), DEVICE_FIELDS)
    names = [
        name
        for _, name in sorted(
            (offset, text(data, definition, offset, PRODUCT_NAME))
            for definition in part.of(DEVICE_INFO)
            for offset in definition.offsets
        )
    ]
    index = table.values("device_index")
    by_index: dict[float, dict[str, object]] = {}
    for row in range(len(table)):
        number = float(index[row])
        if np.isnan(number) or (number not in by_index and len(by_index) >= INSTRUMENTS_MAX):
            continue
        facts = instrument(table, row, names[row])
        before = by_index.setdefault(number, {})
        before |= {name: value for name, value in facts.items() if value is not None}
    return tuple(Instrument(**one) for one in by_index.values() if one)  # type: ignore[arg-type]


def instrument(table: Table, row: int, name: str) -> dict[str, object]:
    """What one message tells of a device; None for what it does not."""

    def value(field: str) -> float | None:
        return number_or_none(table.values(field)[row])

    def word(field: str, words: dict[int, str], other: str) -> str | None:
        number = value(field)
        return None if number is None else words.get(int(number), f"{other}_{int(number)}")

    product, version = value("product"), value("software_version")
    kinds = LOCAL_KINDS if value("source_type") == LOCAL else DEVICE_KINDS
    serial, kind = value("serial_number"), word("device_type", kinds, "device")
    return {
        "kind": "recorder" if value("device_index") == CREATOR else kind,
        "maker": word("manufacturer", MANUFACTURERS, "manufacturer"),
        "product": name or (None if product is None else str(int(product))),
        "serial_number": None if serial is None else str(int(serial)),
        "software_version": None if version is None else f"{version:.2f}",
        "battery_v": value("battery_voltage"),
        "battery_status": word("battery_status", BATTERY_STATUS, "status"),
    }


def number_or_none(value: float) -> float | None:
    """A number, None for a missing one."""
    return float(value) if np.isfinite(value) else None
