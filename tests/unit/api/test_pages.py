"""Goal: the built pages are served to browsers, deep links included, and scripts never as HTML."""

from __future__ import annotations

from pathlib import Path

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

from backend.web import pages
from backend.web import problem as errors


def client_of(folder: Path | None) -> TestClient:
    app = FastAPI(docs_url=None)
    errors.install(app)
    pages.install(app, folder)
    return TestClient(app)


@pytest.fixture
def built(tmp_path: Path) -> TestClient:
    (tmp_path / "assets").mkdir()
    (tmp_path / "index.html").write_text("<!doctype html><title>Spindle</title>")
    (tmp_path / "assets" / "app-1a2b.js").write_text("export {}")
    (tmp_path.parent / "secret.txt").write_text("for nobody")
    return client_of(tmp_path)


@pytest.mark.parametrize("path", ["/", "/tune", "/rides/7", "/rides/7?from=3"])
def test_every_page_of_the_app_is_its_entry_page_never_cached(built: TestClient, path: str) -> None:
    response = built.get(path, headers={"accept": "text/html,application/xhtml+xml,*/*;q=0.8"})

    assert response.status_code == 200
    assert "<title>Spindle</title>" in response.text
    assert response.headers["cache-control"] == "no-cache"


def test_what_makes_it_a_page_of_its_own_is_served_as_that() -> None:
    app = FastAPI()
    app.mount("/", pages.Pages(Path(__file__).resolve().parents[3] / "frontend" / "public"))
    public = TestClient(app)

    manifest = public.get("/spindle.webmanifest")

    assert manifest.headers["content-type"] == "application/manifest+json"
    # Found from its own address, wherever a proxy has put it.
    members = manifest.json()
    assert (members["start_url"], members["scope"]) == ("./", "./")
    for icon in [*members["icons"], {"src": "icons/apple-touch-icon.png"}]:
        assert public.get(f"/{icon['src']}").content.startswith(b"\x89PNG\r\n\x1a\n")


def test_hashed_files_are_cached_for_good(built: TestClient) -> None:
    response = built.get("/assets/app-1a2b.js")

    assert "javascript" in response.headers["content-type"]
    assert "immutable" in response.headers["cache-control"]


@pytest.mark.parametrize("accept", ["*/*", "text/html"])
@pytest.mark.parametrize(
    "path", ["/assets/app-old.js", "/missing.css", "/api/v1/nothing", "/metrics", "/api", "/apis.x"]
)
def test_what_is_missing_is_a_problem_and_not_a_page(
    built: TestClient, path: str, accept: str
) -> None:
    response = built.get(path, headers={"accept": accept})

    assert response.status_code == 404
    assert response.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize("path", ["/tune", "/wp-login", "/metrics/x"])
@pytest.mark.parametrize("accept", ["*/*", "application/json", ""])
def test_who_does_not_ask_for_a_page_gets_none_for_a_path_that_is_not_there(
    built: TestClient, path: str, accept: str
) -> None:
    response = built.get(path, headers={"accept": accept})

    assert response.status_code == 404
    assert response.headers["content-type"] == "application/problem+json"


@pytest.mark.parametrize(
    "path", ["/../secret.txt", "/%2e%2e/secret.txt", "/assets/../../secret.txt"]
)
def test_nothing_outside_the_folder_is_served(built: TestClient, path: str) -> None:
    assert "for nobody" not in built.get(path).text


def test_without_built_pages_it_says_what_to_do(tmp_path: Path) -> None:
    for folder in (None, tmp_path):
        response = client_of(folder).get("/")

        assert response.status_code == 200
        assert "make setup" in response.text
