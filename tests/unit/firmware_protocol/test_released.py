"""Goal: what a release said on the wire and in flash is kept by every later registry.

Method: the registry of today as the release; then one promise at a time is broken, and what may be
added is added. The vectors of what came after a release follow the registry; the others stay.
"""

from pathlib import Path
from typing import Any

import pytest

from firmware_protocol.generate import released, vectors
from firmware_protocol.generate.__main__ import ROOT
from firmware_protocol.generate.registry import Registry, load
from firmware_protocol.generate.tables import BadRegistry

REGISTRY = ROOT / "firmware_protocol" / "registry.toml"
RULES = (
    "# ---------------------------------------------------------------- rules between parameters"
)

GREATEST = max(row.id for row in load(REGISTRY).parameters)

NEW_ROW = f"""[[parameter]]
id = 0x{GREATEST + 1:04X}
name = "chain_length_m"
group = "drivetrain"
type = "f32"
unit = "m"
min = 0.0
max = 9.0
default = 1.5
access = "DEALER"
doc = "Length of the chain."

"""


def release_of_today(folder: Path) -> dict[str, Any]:
    file = folder / "released.json"
    file.write_text(released.text("9.9.9", load(REGISTRY).schema))
    return released.read(file)


def changed(folder: Path, old: str, new: str) -> Registry:
    text = REGISTRY.read_text(encoding="utf-8")
    assert old in text
    file = folder / "registry.toml"
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    return load(file)


def test_the_registry_of_today_keeps_what_the_last_release_said() -> None:
    release = released.read(ROOT / "firmware_protocol" / "released.json")

    released.check(release, load(REGISTRY))


def test_a_new_parameter_goes_last_and_nothing_else_is_asked_of_it(tmp_path: Path) -> None:
    release = release_of_today(tmp_path)

    grown = changed(tmp_path, RULES, NEW_ROW + RULES)

    released.check(release, grown)
    assert released.new_names(release, grown) == {"chain_length_m"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "[[parameter]]\nid = 0x0300\n",
            NEW_ROW.replace(f"{GREATEST + 1:04X}", "0212") + "[[parameter]]\nid = 0x0300\n",
            f"chain_length_m: its id 0x0212 must be above 0x{GREATEST:04X}, the greatest of",
        ),
        ('name = "cog_teeth"', 'name = "sprocket_teeth"', r"cog_teeth \(0x0502\): its name was"),
        ('type = "u8"\nunit = ""\nmin = 8', 'type = "u16"\nunit = ""\nmin = 8', "type was 'u8'"),
        ('unit = "Nm/A"', 'unit = "mNm/A"', "its unit was 'Nm/A' in release 9.9.9 and stays"),
        ("length = 24\n", "length = 20\n", "its length was 24"),
        ("scale = 0.00005", "scale = 0.0001", "channel fuzzy_gain .* its scale was 5e-05"),
        ("POWER_ON = 0", "POWER_ON = 6", "enum.reset_cause: POWER_ON is 0 since release 9.9.9"),
        ('[["host_us", "u64"]]', '[["host_ms", "u64"]]', "TIM_SYNC request: its fields of release"),
        ('CONFIG_COMMITTED = [["generation", "u32"], ', "CONFIG_COMMITTED = [", "event CONFIG_COM"),
    ],
)
def test_a_broken_promise_is_refused_by_name(
    tmp_path: Path, old: str, new: str, words: str
) -> None:
    release = release_of_today(tmp_path)

    with pytest.raises(BadRegistry, match=words):
        released.check(release, changed(tmp_path, old, new))


def test_a_released_parameter_stays(tmp_path: Path) -> None:
    release = release_of_today(tmp_path)
    release["registry"]["parameter"].append({"id": GREATEST + 1, "name": "gone", "type": "u8"})

    with pytest.raises(BadRegistry, match=r"gone .* is in release 9.9.9 and must stay"):
        released.check(release, load(REGISTRY))


def test_a_released_vector_stays_and_one_that_came_later_follows_the_registry() -> None:
    written = [{"name": "old: largest", "hex": "01"}, {"name": "new: largest", "hex": "02"}]
    cases = [
        {"name": "new: largest", "hex": "12"},
        {"name": "old: largest", "hex": "11"},
        {"name": "new: least", "hex": "13"},
    ]

    grown = vectors.grown(written, cases, frozenset({"new"}))

    assert [case["hex"] for case in grown] == ["01", "12", "13"]
