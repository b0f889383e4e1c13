"""Goal: the registry is the one source, and a broken registry is caught before it is generated.

Method: generate again and compare with what is committed; then break one rule at a time.
"""

import re
import zlib
from pathlib import Path

import pytest

from firmware_protocol.generate.__main__ import ROOT, stale
from firmware_protocol.generate.registry import BadRegistry, load
from firmware_protocol.generate.schema import compress, schema_hash

REGISTRY = ROOT / "firmware_protocol" / "registry.toml"


def test_every_generated_file_is_what_the_registry_says() -> None:
    assert stale(ROOT) == []


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('id = 0x0101\nname = "sensor_gain', 'id = 0x0100\nname = "sensor_gain', "is not above"),
        ('id = 2\nname = "cadence_rpm"', 'id = 1\nname = "cadence_rpm"', "share an id"),
        ('["offset", "u32"]', '["offset", "u24"]', "unknown type u24"),
        ('[["text", "bytes"]]', '[["text", "bytes"], ["late", "u8"]]', "must be the last field"),
        ('["git", "u8[8]"]', '["git", "u8[80]"]', "HELLO: its fields are more than the 115 bytes"),
        ('enum = "label"', 'enum = "labels"', "enum labels must exist"),
        ('doc = "Teeth of the chainring."', 'dok = "Teeth."', "chainring_teeth: it needs doc"),
        ('doc = "Teeth of the chainring."', 'doc = ""\nstep = 1', "chainring_teeth: there is no s"),
        ('name = "cog_teeth"', 'name = "Cog teeth"', "a name is lower case with underscores"),
        ('group = "drivetrain"', 'group = "gears"', "gear_ratio: a group is one of sensor"),
        ('type = "f32"\nunit = "s"', 'type = "f64"\nunit = "s"', "a type is one of f32, u8"),
        ("length = 24\n", "", "fuzzy_table_name: a text needs its length"),
        ('access = "FACTORY"', 'access = "MAKER"', "gear_ratio: access is one of RIDER, DEALER"),
        ("default = 40.34", "default = 140.34", "gear_ratio: its default 140.34 is not a value"),
        ("default = 44", "default = 44.5", "chainring_teeth: its default 44.5 is not a value"),
        ('default = "HOLD_ZERO_RATE"', 'default = "HOLD"', "its default HOLD is not a value"),
        ('default = "thesis 4-2"', f'default = "{"x" * 25}"', "is not a value it may have"),
        ("[5.0, 10.0, 15.0, 20.0, 25.0]", "[5.0, 10.0, 10.0, 20.0, 25.0]", "its default 10.0 is"),
        ("[5.0, 10.0, 15.0, 20.0, 25.0]", "[5.0, 10.0, 20.0]", "must have the shape"),
        ("id = 0x0633", "id = 0x0212", "offset_counts_factory: its id 0x0212 is not above 0x0632"),
        ("length = 16\nshape = [5]", "length = 124\nshape = [5]", r"has 9\d\d bytes, and two "),
        ('\nnone = "nan"', "\nnone = 0", 'only a single f32 may be none, and "nan" says so'),
        (
            '"1/K"\nmin = -0.002\nmax = 0.002\nnone = "nan"',
            '"1/K"\nmin = -0.002\nmax = 0.002',
            "none is not a value it may",
        ),
        ("max = 4294967295", "max = 4294967294", "a u32 has its whole range"),
        ('low = "fixed_taper_start_kmh"', 'low = "taper"', "order of unknown parameters taper"),
        ("max = 100.0\n", "", "numbers need min and max"),
        ("within_pct = 4.0\n", "", "within_pct or within, one of them"),
        ('times = "sensor_gain_nm_per_count_factory"', 'times = "cog_teeth"', "single f32"),
        ('around = "wheel_circumference_m_factory"', 'around = "torque_filter_s"', "the factory's"),
    ],
)
@pytest.mark.slow
def test_a_registry_that_breaks_its_own_rules_is_refused(
    tmp_path: Path, old: str, new: str, words: str
) -> None:
    text = REGISTRY.read_text(encoding="utf-8")
    broken = tmp_path / "registry.toml"
    assert old in text
    broken.write_text(text.replace(old, new, 1), encoding="utf-8")

    with pytest.raises((BadRegistry, KeyError), match=words):
        load(broken)


def test_better_words_do_not_make_a_unit_look_foreign(tmp_path: Path) -> None:
    text = REGISTRY.read_text(encoding="utf-8")
    reworded = tmp_path / "registry.toml"
    reworded.write_text(re.sub(r'(?m)^doc = ".*"$', 'doc = "Other words."', text))

    assert schema_hash(load(reworded).schema) == schema_hash(load(REGISTRY).schema)


def test_a_changed_unit_does(tmp_path: Path) -> None:
    text = REGISTRY.read_text(encoding="utf-8")
    changed = tmp_path / "registry.toml"
    changed.write_text(text.replace('unit = "km/h"', 'unit = "m/s"', 1), encoding="utf-8")

    assert schema_hash(load(changed).schema) != schema_hash(load(REGISTRY).schema)


def test_another_zlib_keeps_the_bytes_that_are_committed() -> None:
    schema = load(REGISTRY).schema
    other = zlib.compress(schema.encode(), 1)
    committed = f"ebl_schema[N] = {{ {', '.join(f'0x{byte:02x}' for byte in other)} }}"

    assert compress(schema, committed) == other
    assert zlib.decompress(compress(schema + " ", committed)) == (schema + " ").encode()


def test_the_page_says_when_a_bike_moves_as_the_registry_does() -> None:
    riding = load(REGISTRY).riding
    page = " ".join((ROOT / "firmware_protocol" / "SPEC.md").read_text(encoding="utf-8").split())

    assert f"ends after {riding['standing_s']} s of standstill" in page
    assert f"faster than {riding['moving_kmh']:g} km/h" in page
    assert f"turn faster than {riding['moving_rpm']:g} rpm" in page


def test_what_the_wire_does_not_carry_makes_no_other_schema(tmp_path: Path) -> None:
    text = REGISTRY.read_text(encoding="utf-8")
    (tmp_path / "registry.toml").write_text(text.replace("standing_s = 20", "standing_s = 30"))

    assert load(tmp_path / "registry.toml").schema == load(REGISTRY).schema
