"""Goal: a ride's report is one file that says what its ride says, asks nobody, and runs nothing of
its ride's words; and plotly is not in memory before somebody asks for a picture.

Method: reports of rides in a real store, read as text; a process of its own that imports Spindle.
"""

from __future__ import annotations

import re
import subprocess
import sys
from dataclasses import asdict

import numpy as np
import pytest

from backend.rides.insight.crank import CrankTorque, crank_torque
from backend.rides.questions import Insight
from backend.rides.report.page import crank
from backend.rides.report.words import EN, ZH
from backend.store import Store
from tests.unit.rides.test_why_a_moment_was_as_it_was import ROWS, config_of, kept

PUSH = np.full(ROWS, 20.0)


def report_of(store: Store, ride_id: int, language: str = "en") -> str:
    told = Insight(store, config_of).report(ride_id, language, threshold_power_w=130.0)
    return b"".join(told.chunks).decode()


def without_the_library(text: str) -> str:
    return re.sub(r"<script>.*?</script></head>", "</head>", text, count=1, flags=re.DOTALL)


def test_a_report_says_what_the_ride_says(store: Store) -> None:
    ride_id = kept(store, rider_torque_nm=PUSH)
    text = report_of(store, ride_id)
    said = without_the_library(text)

    assert len(text) > 4_000_000, "the library is in it"
    assert len(said) < 100_000
    # 12 km/h for 10 s, 125.7 W of the rider, 72 W of the battery.
    for expected in ("0.03 km", "126 W", "sport", "Z4", "Nothing found.", "0.2 Wh"):
        assert expected in said
    assert not re.findall(r'(?:src|href)="', said)
    assert "Plotly.newPlot" in said


def test_a_report_speaks_both_languages_with_the_same_words(store: Store) -> None:
    ride_id = kept(store, rider_torque_nm=PUSH + 5.0, speed_kmh=np.zeros(ROWS))
    fields = re.compile(r"{(\w+)}")

    assert list(EN) == list(ZH)
    for key in EN:
        assert sorted(fields.findall(EN[key])) == sorted(fields.findall(ZH[key])), key
    assert 'lang="zh"' in report_of(store, ride_id, "zh")
    assert "曲柄受力转动而车轮静止" in report_of(store, ride_id, "zh")


def test_what_people_wrote_is_text_and_no_markup(store: Store) -> None:
    ride_id = kept(store)
    store.rides.patch(ride_id, name="<img src=x onerror=alert(1)>", notes="<script>a</script>")
    said = without_the_library(report_of(store, ride_id))

    assert "<img" not in said
    assert "<script>a" not in said


def test_torque_round_the_crank_is_drawn_where_it_can_be_told(store: Store) -> None:
    # 30 s at 60 rpm and 100 Hz: hardest with the cranks level, least at their dead spots.
    turned = np.radians(np.arange(3000) * 3.6)
    rider = 20.0 - 10.0 * np.cos(2.0 * turned)
    # The motor swings as much, 18 degrees later: 50 ms.
    motor = 20.0 - 10.0 * np.cos(2.0 * (turned - np.radians(18.0)))
    told = crank_torque(
        np.degrees(turned) % 360.0, rider, motor, np.full(3000, 60.0), np.full(3000, 0.01)
    )
    assert isinstance(told, CrankTorque)

    english, chinese = (crank(asdict(told), words) for words in (EN, ZH))

    assert "50 % of the work in the left leg’s half." in english
    assert "18° or 50 ms later" in english
    assert "左腿半圈做功占 50 %。" in chinese
    assert crank(None, EN) == ""
    # Of a ride of ten seconds, as of one without positions, nothing is drawn.
    said = without_the_library(report_of(store, kept(store)))
    assert EN["crank"] not in said
    assert "<svg" not in said


@pytest.mark.slow
def test_plotly_is_imported_by_the_first_picture_only() -> None:
    code = (
        "import sys, backend.main, backend.app, backend.cli;"
        "sys.exit(any(name.split('.')[0] == 'plotly' for name in sys.modules))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
