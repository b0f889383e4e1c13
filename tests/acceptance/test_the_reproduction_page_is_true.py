"""Goal: the pages that tell what the simulated bike does say what a run of this very state says, to
the last figure: docs/thesis-reproduction.md, docs/tables.md, docs/torque-filter.md."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import pytest

from tools.reproduction import __main__ as reproduction
from tools.reproduction import filters, tables


@pytest.mark.slow
@pytest.mark.long
def test_the_page_is_what_make_reproduction_writes_now(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = reproduction.DOCS / "thesis-reproduction.md"
    pictures = reproduction.PICTURES
    monkeypatch.setattr(reproduction, "DOCS", tmp_path)
    monkeypatch.setattr(reproduction, "PICTURES", tmp_path / "pictures")

    reproduction.main()

    written = (tmp_path / "thesis-reproduction.md").read_text(encoding="utf-8")
    assert written == kept.read_text(encoding="utf-8"), "run `make reproduction`"
    drawn = sorted((tmp_path / "pictures").iterdir())
    assert drawn
    assert all((pictures / picture.name).is_file() for picture in drawn)


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("measured", [tables, filters], ids=["tables", "filters"])
def test_what_is_measured_of_tables_and_filters_is_so_now(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, measured: ModuleType
) -> None:
    kept = measured.PAGE
    monkeypatch.setattr(measured, "PAGE", tmp_path / kept.name)

    measured.main()

    written = (tmp_path / kept.name).read_text(encoding="utf-8")
    assert written == kept.read_text(encoding="utf-8"), "run `make reproduction`"


def test_the_page_tells_what_is_fitted_and_what_counts_as_arrived() -> None:
    """thesis_checks 3 and 4.1: scatter of the rig, weight of its pan, first crossing of 24.95."""
    page = (reproduction.DOCS / "thesis-reproduction.md").read_text(encoding="utf-8")

    assert '"Time to 25 km/h" is when 24.95 km/h are first passed' in page
    for fitted in ("0.223 Nm of scatter of the rig", "0.0796 Nm of pan and hook"):
        assert fitted in page
