"""Goal: the owner sees where everything is kept, and takes a backup that another Spindle opens."""

from __future__ import annotations

from pathlib import Path
from zipfile import ZipFile

from playwright.sync_api import expect

from backend.store.upkeep.check import check_store
from tests.browser.conftest import OpenDesk
from tests.browser.desk import sideways
from tests.browser.judged import COVERED, JUDGE, moved
from tests.fakes.server import SpindleServer


def test_a_backup_is_saved_from_where_everything_is_told(
    open_desk: OpenDesk, server: SpindleServer, standing: str, axe: str, tmp_path: Path
) -> None:
    place = server.get("/store")
    desk = open_desk(width=1440, height=900)
    page = desk.open("/settings")
    data = page.get_by_test_id("data-folder")
    expect(data).to_contain_text(place["folder"])
    expect(data).to_contain_text("rides ·")
    assert moved(page) == []
    data.locator("summary").click()
    expect(data).to_contain_text("spindle serve --data FOLDER")
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []

    with page.expect_download() as downloading:
        data.get_by_role("link", name="Save a backup").click()

    with ZipFile(downloading.value.path()) as archive:
        archive.extractall(tmp_path)
    found = check_store(f"sqlite:///{tmp_path}/spindle.db", f"file://{tmp_path}/objects")
    assert found.is_fine
    assert found.database.rides == place["rides"]
    desk.picture("settings-data")


def test_a_dark_phone_shows_where_everything_is_in_chinese(
    open_desk: OpenDesk, standing: str, axe: str
) -> None:
    desk = open_desk(width=390, height=844, theme="dark", language="zh-CN", touch=True)
    page = desk.open("/settings")
    expect(page.get_by_test_id("data-folder")).to_contain_text("次骑行")

    page.evaluate(axe)

    assert page.evaluate(JUDGE) == []
    assert sideways(page) == 0
    assert page.evaluate(COVERED) == []
