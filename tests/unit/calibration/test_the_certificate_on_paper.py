"""Goal: the certificate on paper says what its file says, in both languages, to any reader of PDF,
and is the same bytes for the same file.

Method: a calibration of a simulated bench; the paper's text read by pypdf, which did not write it,
and compared with the numbers of the file's JSON; its pages drawn by PDFium.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import replace
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any

import pypdf
import pypdfium2
import pytest

from backend.calibration.certificate import About, certificate
from backend.calibration.coefficients import Coefficients
from backend.calibration.judgement import Limits
from backend.calibration.paper import words_zh
from backend.calibration.paper.pdf import certificate_paper
from backend.calibration.paper.words import EN, MEANING
from backend.cli import main
from backend.errors import InvalidRequest
from tests.fakes.calibration_bench import DISOBEYS, OBEYS, SETUP, Workshop

CAPTURES = tuple(Workshop(OBEYS["drifted"], 3).captures())
BENT = tuple(Workshop(DISOBEYS["bent"], 3).captures())
FITTED_US = 1_795_000_000_000_000  # 2026-11-18 11:06:40 UTC
ABOUT = About(
    3,
    FITTED_US,
    "ebl:29f015f2",
    "spindle 0.5.0",
    serial="29f015f2",
    market="eu_epac",
    bike="Cargo bike 7",
    technician="Łukasz Źdźbło",
)


def file_of(about: About = ABOUT, captures: tuple[Any, ...] = CAPTURES) -> dict[str, Any]:
    body = certificate(about, SETUP, captures, Coefficients(0.0, 0.01), Limits())
    read: dict[str, Any] = json.loads(json.dumps(body))
    return read


def printed(body: dict[str, Any], **manner: Any) -> bytes:
    asked = {"language": "en", "zone": "UTC", "paper": "a4"} | manner
    return certificate_paper(body, "calibration-1.json", **asked)


@cache
def printed_once(body: str, **manner: Any) -> bytes:
    return printed(json.loads(body), **manner)


def paper_of(body: dict[str, Any], **manner: Any) -> bytes:
    """The paper of a file; the same one is printed once."""
    return printed_once(json.dumps(body), **manner)


def read(paper: bytes) -> str:
    """All text, white space as one blank."""
    pages = pypdf.PdfReader(BytesIO(paper)).pages
    return " ".join(" ".join(page.extract_text().split()) for page in pages)


def shown(value: float, digits: int) -> str:
    return f"{value:.{digits}f}".replace("-", "−")


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_paper_has_the_numbers_of_the_file(language: str) -> None:
    body = file_of()
    document, worked = body["document"], body["document"]["worked"]

    text = read(paper_of(body, language=language))

    assert body["sha256"] in text
    assert "spindle calibrate evaluate calibration-1.json" in text
    assert shown(worked["fit"]["coefficients"]["gain_nm_per_count"], 7) in text
    assert shown(worked["fit"]["coefficients"]["offset_counts"], 3) in text
    assert shown(worked["verifications"][0]["reading_nm"], 2) in text
    residuals = {one["capture"]: one for one in worked["fit"]["residuals"]}
    for capture in document["captures"]:
        assert shown(capture["mean_counts"], 2) in text
        if capture["number"] in residuals:
            assert shown(residuals[capture["number"]]["reading_nm"], 2) in text
    budget = worked["budget"]
    for contribution in budget["contributions"]:
        assert shown(contribution["standard_nm"][-1], 4) in text
    assert shown(budget["expanded_nm"][-1], 3) in text
    for side in worked["figures"]:
        assert shown(side["hysteresis_pct"], 2) in text


def test_the_same_file_gives_the_same_paper_and_another_does_not() -> None:
    body = file_of()

    assert printed(body) == printed(body)
    assert paper_of(body) != paper_of(file_of(replace(ABOUT, bike="another")))


def test_every_page_says_which_of_how_many_it_is_and_of_which_certificate() -> None:
    body = file_of()

    pages = pypdf.PdfReader(BytesIO(paper_of(body))).pages

    assert 2 <= len(pages) <= 5
    for number, page in enumerate(pages, 1):
        text = page.extract_text()
        assert f"Page {number} of {len(pages)}" in text
        assert body["sha256"][:16] in text


def test_moments_stand_with_their_zone() -> None:
    body = file_of()

    assert "2026-11-18 11:06:40 UTC" in read(paper_of(body))
    assert "2026-11-18 12:06:40 +01:00" in read(paper_of(body, zone="Europe/Zurich"))
    with pytest.raises(InvalidRequest, match="Nowhere"):
        paper_of(body, zone="Nowhere/Else")


def test_a_fail_is_told_with_its_causes() -> None:
    body = file_of(captures=BENT)
    judgement = body["document"]["worked"]["judgement"]

    text = read(paper_of(body))

    assert judgement["verdict"] == "fail"
    for cause in judgement["causes"]:
        assert " ".join(cause["sentence"].split())[1:] in text


def test_a_file_that_was_changed_says_so_on_paper() -> None:
    body = file_of()
    assert "WAS CHANGED" not in read(paper_of(body))

    body["document"]["worked"]["fit"]["coefficients"]["gain_nm_per_count"] *= 1.01

    assert "WAS CHANGED: 1 of its values" in read(paper_of(body))


@pytest.mark.parametrize(
    ("name", "stands"),
    [
        ("<b>Tom & Jerry</b> &amp;", "<b>Tom & Jerry</b> &amp;"),
        ("Fahrrad 🚲", "Fahrrad [U+1F6B2]"),
        ("אופניים", "[U+05D0][U+05D5]"),
        ("李雷的车", "李雷的车"),
        ("Велосипед Ωμέγα", "Велосипед Ωμέγα"),
        ("one\x00two\u202eeno", "one[U+0000]two[U+202E]eno"),
        ("W" * 200, "W" * 20),
        ("车" * 200, "车" * 20),
        ("🚲" * 200, "[U+1F6B2]"),
    ],
)
def test_any_name_stays_words_and_on_the_page(name: str, stands: str) -> None:
    paper = paper_of(file_of(replace(ABOUT, bike=name)))

    # A name that wraps may do so anywhere.
    assert stands.replace(" ", "") in read(paper).replace(" ", "")
    for page in pypdfium2.PdfDocument(paper):
        letters = page.get_textpage()
        for place in range(letters.count_chars()):
            left, _, right, _ = letters.get_charbox(place)
            assert left >= -1
            assert right <= page.get_width() + 1


@pytest.mark.parametrize(("paper", "width"), [("a4", 595), ("letter", 612)])
def test_its_pages_are_drawn_with_pictures_inside_the_margins(paper: str, width: int) -> None:
    document = pypdfium2.PdfDocument(paper_of(file_of(), paper=paper))

    assert round(document[0].get_width()) == width
    colours = set()
    for page in document:
        picture = page.render(scale=1).to_pil().convert("RGB")
        edge = picture.crop((0, 0, 36, picture.height))
        assert edge.getextrema() == ((255, 255),) * 3
        colours |= {colour for _, colour in picture.getcolors(1 << 20) or []}
    # The marks of the way up and the way down.
    assert {(196, 71, 10), (8, 104, 168)} <= colours


def test_latin_is_embedded_and_chinese_is_named() -> None:
    fonts: dict[str, bool] = {}
    for page in pypdf.PdfReader(BytesIO(paper_of(file_of(), language="zh"))).pages:
        for font in page["/Resources"]["/Font"].get_object().values():
            told = font.get_object()
            inner = told["/DescendantFonts"][0].get_object() if "/DescendantFonts" in told else told
            descriptor = inner.get("/FontDescriptor", {})
            name = re.sub(r"^[A-Z]{6}\+", "", told["/BaseFont"].lstrip("/"))
            fonts[name] = "/FontFile2" in descriptor.get_object() if descriptor else False

    assert {name for name, embedded in fonts.items() if not embedded} <= {
        "STSong-Light-UniGB-UCS2-H",
        "STSong-Light",
        "Helvetica",  # reportlab names it on every page; nothing is written in it
    }
    assert any(name.startswith("SourceSansPro") for name, embedded in fonts.items() if embedded)


def test_both_languages_have_every_word() -> None:
    holes = {name: set(re.findall(r"{(\w+)}", words)) for name, words in EN.items()}

    assert holes == {name: set(re.findall(r"{(\w+)}", text)) for name, text in words_zh.ZH.items()}
    assert set(words_zh.MEANING_ZH) <= set(MEANING)


def test_the_command_makes_the_paper_of_a_file_without_a_server(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    body = file_of()
    file, paper = tmp_path / "kept.json", tmp_path / "kept.pdf"
    file.write_text(json.dumps(body), encoding="utf-8")

    assert main(["calibrate", "paper", str(file), str(paper)]) == 0

    assert body["sha256"] in read(paper.read_bytes())
    assert "spindle calibrate evaluate kept.json" in read(paper.read_bytes())
    file.write_text("{}", encoding="utf-8")
    assert main(["calibrate", "paper", str(file), str(paper)]) == 2
    assert "no certificate" in capsys.readouterr().err


@pytest.mark.slow
def test_reportlab_is_not_in_memory_before_somebody_asks_for_paper() -> None:
    asked = "import sys, backend.main, backend.cli.parser; print('reportlab' in sys.modules)"
    told = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True)

    assert told.stdout.strip() == "False"
