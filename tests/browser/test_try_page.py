"""Goal: a tuner sees what other tables would have made of a ride he knows, and is told what the
answer is worth; and why the motor gave what it gave at a moment of it.

Method: a simulated unit rides for half a minute of virtual time, and its ride records itself.
Rules that say the largest gain everywhere must give more work for every kilometre; nothing changed
must give what was recorded.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Page, expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk, sideways
from tests.browser.judged import JUDGE
from tests.browser.recorded_ride import record_ride
from tests.browser.test_rides_page import drop_file, steady_ride
from tests.fakes.ride_in_time import ride_on
from tests.fakes.server import ServerHere, SpindleServer, eventually

SENTENCE = "[data-testid=try-sentence]"
SHIFTS = """
    window.shifted = 0
    new PerformanceObserver((list) => {
        for (const e of list.getEntries()) if (!e.hadRecentInput) window.shifted += e.value
    }).observe({ type: 'layout-shift', buffered: true })
"""
SHIFT_MAX = 0.02


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SpindleServer]:
    unit = "sim:try?seed=5&scenario=none&clock=virtual"
    with ServerHere(tmp_path_factory.mktemp("try"), [unit]) as running:
        yield running


@pytest.fixture(scope="module")
def braked(workshop: SpindleServer) -> int:
    """The id of a ride on which the brake was touched twice, which cut the motor."""
    device = workshop.ready_device()
    for _ in range(2):
        ride_on(workshop, device, 12.0)
        workshop.simulate(device, brake=True)
        workshop.advance(device, 0.5)
    return record_ride(workshop, device)


@pytest.fixture(scope="module")
def ride(workshop: SpindleServer, braked: int) -> int:
    """The id of the newest ride, in the mode that the first table rules."""
    return record_ride(workshop, workshop.ready_device())


@pytest.fixture
def tuner(open_desk: OpenDesk, workshop: SpindleServer, ride: int) -> Desk:
    return open_desk(width=1440, height=900, address=workshop.url)


def answered(page: Page) -> None:
    page.wait_for_selector("[data-testid=traces][data-draws]")


def figure(page: Page, name: str) -> tuple[float, float]:
    """A figure as ridden and replayed."""
    cells = page.locator(f"[data-figure={name}] td")
    recorded, replayed = (float(re.split(r"[\s+−±]", cells.nth(i).inner_text())[0]) for i in (0, 1))
    return recorded, replayed


def test_a_bigger_gain_is_tried_from_tune_and_takes_more_work(tuner: Desk, ride: int) -> None:
    page = tuner.open("/tune")
    page.wait_for_selector("[data-cell='0,0']")
    page.focus("[data-cell='0,0']")
    page.keyboard.press("Control+a")
    page.keyboard.press("5")
    page.get_by_test_id("draft-bar").get_by_role("link", name="Try on a ride").click()

    expect(page.locator(SENTENCE)).to_contain_text("more")
    answered(page)
    assert page.url.endswith(f"/tune/try?with=draft&ride={ride}")
    expect(page.get_by_test_id("try-answer")).to_contain_text(
        "Open loop: speed and legs as recorded; it ranks tables and is no forecast"
    )
    expect(page.get_by_test_id("try-tables")).to_contain_text("changed, not yet in the unit")
    for name in ("wh_per_km", "motor_work_wh", "torque_nm"):
        recorded, replayed = figure(page, name)
        assert replayed > recorded > 0.0, name
    expect(page.locator("[data-source=ride]")).to_be_visible()
    tuner.picture("try", full=True)

    page.get_by_label("Try").select_option("unit")

    # The unit's own tables, on its own ride: what the motor did.
    eventually(lambda: figure(page, "wh_per_km"), lambda f: f[1] == pytest.approx(f[0], rel=0.02))
    assert f"with=unit&ride={ride}" in page.url


def test_nothing_changed_gives_what_was_recorded(tuner: Desk, ride: int) -> None:
    page = tuner.open(f"/tune/try?ride={ride}&with=ride")
    answered(page)

    recorded, replayed = figure(page, "wh_per_km")
    assert replayed == pytest.approx(recorded, rel=0.02)
    expect(page.get_by_label("Try")).to_have_value("ride")
    names = tuner.plot("gd.data.map((line) => line.name)")
    assert names[:2] == ["Motor torque at the shaft", "Motor torque, replayed"]
    again = page.get_by_test_id("try-again")
    cells = again.locator("[data-again=wh_per_km] td")
    expect(cells).to_have_count(3)
    ridden, _, band = cells.all_inner_texts()
    low, high = band.split(" – ")
    assert float(low) <= float(ridden) <= float(high)
    # Both loops tell the same of the ride as it was.
    for name in ("motor_power_w_mean", "ripple_nm_per_s"):
        told = again.locator(f"[data-again={name}] td").first
        assert float(told.inner_text()) == figure(page, name)[0]
    expect(again).to_contain_text("With nothing changed the twin is off by")
    expect(again.locator("[data-again=km_per_100_wh] td")).to_have_count(3)
    expect(page.get_by_test_id("try-again-sentence")).to_contain_text("of motor work instead of")

    # Three rides over one road, by distance and by time, and a cursor that keys move.
    curves = page.get_by_test_id("road-curves")
    expect(curves.locator("path.replayed")).to_have_count(2)
    again.get_by_role("button", name="again with it").click()
    expect(curves.locator("path.replayed")).to_have_count(0)
    page.keyboard.press("c")
    expect(curves.locator("path.replayed")).to_have_count(2)
    page.keyboard.press("c")
    expect(curves.locator("path.replayed")).to_have_count(0)
    page.keyboard.press("o")
    traces = "gd.data.map((line) => line.name)"
    eventually(lambda: tuner.plot(traces), lambda lines: len(lines) == len(names) // 2)
    page.keyboard.press("o")
    eventually(lambda: tuner.plot(traces), lambda lines: len(lines) == len(names))
    curves.press("ArrowRight")
    expect(page.get_by_test_id("road-cursor")).to_contain_text("as ridden")
    expect(page.get_by_test_id("road-cursor")).not_to_contain_text("again with it")
    curves.press("k")
    expect(curves).to_have_attribute("data-by", "time")
    expect(again.get_by_role("button", name="time")).to_have_attribute("aria-pressed", "true")


def test_settings_for_a_wish_become_the_draft_and_nothing_is_written(
    tuner: Desk, workshop: SpindleServer, ride: int
) -> None:
    page = tuner.open(f"/tune/try?ride={ride}&with=ride")
    before = workshop.get("/devices")["items"][0]["config"]
    proposals = page.get_by_test_id("proposals")
    page.get_by_label("Rider and bike").fill("95")
    for knob in ("torque filter", "torque-rate points", "rules, as a monotone table"):
        proposals.get_by_label(knob).uncheck()
    look = proposals.get_by_role("button", name="Look on this ride")

    look.click()
    proposals.get_by_role("button", name="Stop looking").click()
    expect(proposals.get_by_test_id("proposal-status")).to_contain_text("Nothing was changed")
    look.click()
    wished = proposals.locator("[data-candidate]", has_text="as wished")
    expect(wished).to_be_visible(timeout=60_000)
    expect(wished).to_contain_text("Assist ratio of each mode")
    with page.expect_request("**/replay") as opened, page.expect_request("**/again") as closed:
        wished.get_by_role("button", name="Try").click()

    # Both loops are asked with the whole draft, whatever the proposal turned.
    tried = opened.value.post_data_json["parameters"]
    assert closed.value.post_data_json["parameters"] == tried
    assert {"mode_ratios", "assist_cutoff_band_kmh", "torque_filter_s"} <= tried.keys()
    expect(page.get_by_label("Try", exact=True)).to_have_value("draft")
    expect(page.get_by_test_id("try-tables")).to_contain_text("changed, not yet in the unit")
    eventually(lambda: figure(page, "wh_per_km"), lambda f: f[1] < 0.97 * f[0])
    assert workshop.get("/devices")["items"][0]["config"] == before


def test_a_table_that_comes_with_spindle_is_tried_in_place_of_the_first(
    tuner: Desk, ride: int
) -> None:
    tuner.page.add_init_script(SHIFTS)
    page = tuner.open(f"/tune/try?ride={ride}&with=library:strong-start")
    answered(page)

    recorded, replayed = figure(page, "wh_per_km")
    assert replayed > recorded
    expect(page.get_by_test_id("try-tables")).to_contain_text("stands in for the first table")
    assert page.evaluate("window.shifted") < SHIFT_MAX
    tuner.picture("try-library")


def test_the_picture_is_also_told_in_words_and_numbers(tuner: Desk, ride: int) -> None:
    page = tuner.open(f"/tune/try?ride={ride}&with=unit")
    answered(page)

    expect(page.get_by_test_id("try-summary")).to_contain_text("Motor torque up to")
    page.get_by_role("button", name="Data table").press("Enter")

    table = page.get_by_role("group", name="Data table").locator("table")
    expect(table).to_contain_text("Motor torque, replayed (Nm)")
    assert 20 <= table.locator("tbody tr").count() <= 40


def test_a_ride_without_torque_is_refused_with_the_reason(tuner: Desk, ride: int) -> None:
    page = tuner.open("/rides")
    drop_file(page, "club ride.fit", steady_ride(5))
    page.click("text=Open the ride")

    page.get_by_role("link", name="Try a table on this ride").click()

    refused = page.get_by_test_id("try-refused")
    expect(refused).to_contain_text("Missing in it")
    for missing in ("Assist mode", "Rider torque"):
        expect(refused).to_contain_text(missing)
    expect(page.locator(SENTENCE)).to_have_count(0)
    tuner.picture("try-refused")
    # The list offers the one that can be tried.
    page.get_by_label("On the ride").select_option(str(ride))
    answered(page)


def test_a_motor_torque_that_was_only_asked_is_called_so(tuner: Desk, ride: int) -> None:
    def of_before(answer: dict[str, Any]) -> dict[str, Any]:
        """What the server says of a ride whose unit did not measure what the motor gave."""
        channels = answer["series"]["channels"]
        answer["series"]["channels"] = [
            c for c in channels if c["name"] != "motor_torque_demanded_nm"
        ]
        for name in ("wh_per_km", "motor_work_wh", "motor_torque_nm_max"):
            answer[name] |= {"recorded": None, "difference": None}
        nothing = {"motor_torque_nm_difference_max": None, "limit_shares_recorded": None}
        return answer | nothing | {"motor_torque_meaning": "demanded", "config_source": "defaults"}

    tuner.page.route("**/replay", lambda route: route.fulfill(json=of_before(route.fetch().json())))
    page = tuner.open(f"/tune/try?ride={ride}&with=ride")
    answered(page)

    expect(page.locator(SENTENCE)).to_contain_text("as ridden it is not known")
    expect(page.locator("[data-figure=demanded_nm]")).to_be_visible()
    expect(page.locator("[data-figure=wh_per_km] td").first).to_have_text("—")
    expect(page.get_by_test_id("try-answer")).to_contain_text("the two are not compared")
    expect(page.locator("[data-source=defaults]")).to_contain_text("not known")
    names = tuner.plot("gd.data.map((line) => line.name)")
    assert names[:2] == ["Motor torque requested, at the shaft", "Motor torque requested, replayed"]
    page.unroute_all(behavior="ignoreErrors")


@pytest.mark.parametrize(
    ("width", "theme", "language"),
    [(1440, "light", "en-GB"), (1024, "dark", "en-GB"), (390, "dark", "zh-CN")],
)
def test_the_page_works_for_everyone(
    open_desk: OpenDesk,
    workshop: SpindleServer,
    ride: int,
    axe: str,
    width: int,
    theme: str,
    language: str,
) -> None:
    desk = open_desk(width=width, height=900, theme=theme, language=language, address=workshop.url)
    desk.page.add_init_script(SHIFTS)
    page = desk.open(f"/tune/try?ride={ride}&with=unit")
    answered(page)

    assert page.evaluate("window.shifted") < SHIFT_MAX
    assert sideways(page) == 0
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    assert re.findall(r"\b[a-z]+\.[a-z_]+\b", page.inner_text("main")) == []
    desk.picture(f"try-{width}-{theme}", full=True)


def shown_nm(page: Page, row: str) -> float:
    """What a row of the waterfall says at its end."""
    cell = page.locator(f"[data-testid=waterfall] tr.{row} td.number")
    return float(cell.inner_text().split()[0].replace("\u2212", "-"))


def test_a_moment_says_who_took_what_and_the_next_cut_is_a_key_away(
    tuner: Desk, workshop: SpindleServer, braked: int, axe: str
) -> None:
    cuts = workshop.get(f"/rides/{braked}/cuts")["items"]
    page = tuner.open(f"/rides/{braked}")
    expect(page.get_by_test_id("energy")).to_contain_text("sport")
    page.get_by_role("link", name="Why").click()
    page.wait_for_selector("[data-testid=waterfall]")

    # It opens at the first cut, which the law asked for more than arrived.
    page.wait_for_function(f"() => location.search.includes('t_s={cuts[0]['at_s']:.2f}')")
    expect(page.get_by_test_id("why-sentence")).to_contain_text(" took ")
    expect(page.get_by_test_id("why-bar")).to_contain_text(f"cut 1 of {len(cuts)}")
    why = workshop.get(f"/rides/{braked}/why", params={"t_s": cuts[0]["at_s"]})
    assert shown_nm(page, "delivered") == pytest.approx(why["delivered_nm"], abs=0.06)
    expect(page.locator("[data-testid=fired-rules] tbody tr")).to_have_count(len(why["rules"]))

    page.keyboard.press("Shift+ArrowRight")
    page.wait_for_function(f"() => location.search.includes('t_s={cuts[0]['at_s'] + 1:.2f}')")
    page.keyboard.press("n")
    page.wait_for_function(f"() => location.search.includes('t_s={cuts[1]['at_s']:.2f}')")
    page.wait_for_selector("[data-testid=traces][data-draws]")
    assert page.get_by_test_id("cursor").is_visible()
    page.evaluate(axe)
    assert page.evaluate(JUDGE) == []
    page.get_by_role("button", name="What if").click()
    answered(page)
    page.get_by_role("link", name="Why").last.click()
    page.set_viewport_size({"width": 390, "height": 844})
    page.wait_for_selector("[data-testid=waterfall]")
    assert sideways(page) == 0
    page.get_by_role("button", name="A steady state").click()
    expect(page.get_by_test_id("why-bar")).to_contain_text("With what the unit is set to now")
    assert shown_nm(page, "rider") == 30.0
    expect(page.locator("[data-testid=waterfall] tr.commanded")).to_be_visible()
