"""Goal: who the unit is, how its link stands, and how the bike is."""

from __future__ import annotations

import re
from collections.abc import Callable

from playwright.sync_api import expect

from tests.browser.conftest import OpenDesk
from tests.browser.desk import Desk
from tests.fakes.server import SpindleServer, eventually

PILL = "[data-testid=device-pill]"


def test_the_unit_says_who_it_is(desk: Desk, server: SpindleServer, standing: str) -> None:
    known = server.get(f"/devices/{standing}")
    page = desk.open("/")

    expect(page.locator("main")).to_contain_text(known["identity"]["serial_number"])
    stamp = f"{known['config']['crc32']:08x}"
    expect(page.locator("[data-testid=config-stamp]")).to_contain_text(stamp)
    expect(page.locator("dt:has-text('Last start') + dd")).to_have_text("switched on")
    expect(page.locator(PILL)).to_contain_text("Connected")
    desk.picture("bike", full=True)


def test_the_simulated_rider_obeys_the_panel(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = desk.open("/")

    page.select_option("label:has-text('Rider') >> select", value="constant")
    page.select_option("label:has-text('Speed of time') >> select", value="2")

    eventually(
        lambda: server.get(f"/devices/{standing}/simulation"),
        lambda now: (now["rider"]["kind"], now["speed_factor"]) == ("constant", 2),
    )
    server.simulate(standing, speed_factor=1.0)


def test_the_scenarios_are_those_the_server_knows(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    known = server.get("/scenarios")["items"]
    commute = next(one for one in known if one["name"] == "commute")
    page = desk.open("/")
    scenarios = page.get_by_label("Scenario")
    expect(scenarios.locator("option")).to_have_count(len(known) + 1)

    scenarios.select_option("commute")

    expect(page.locator("main")).to_contain_text(commute["description"])
    desk.picture("simulation", full=True)


def test_a_run_that_makes_energy_says_so_and_an_honest_one_says_its_books_close(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    simulation = server.get(f"/devices/{standing}/simulation")
    simulation |= {"energy_consistent": True, "energy_balance_error_pct": 0.0}
    desk.page.route("**/simulation", lambda route: route.fulfill(json=simulation))
    page = desk.open("/")
    expect(page.get_by_test_id("energy-books")).to_contain_text("0.00 %")
    expect(page.get_by_test_id("not-consistent")).to_have_count(0)

    simulation |= {"energy_consistent": False, "energy_balance_error_pct": 201.4}

    # The panel asks again by itself.
    expect(page.get_by_test_id("not-consistent")).to_contain_text("Not energy consistent")
    expect(page.get_by_test_id("energy-books")).to_contain_text("201.40 %")


def test_the_words_of_the_wireless_link_are_counted_on_the_page(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    simulation = server.get(f"/devices/{standing}/simulation")
    assert simulation["rotor_link"]["words_good"] > 0
    simulation["rotor_link"] = {"words_good": 12345, "words_bad": 67, "words_lost": 8}
    desk.page.route("**/simulation", lambda route: route.fulfill(json=simulation))
    page = desk.open("/")

    counted = page.get_by_test_id("rotor-link")
    expect(counted).to_contain_text("12,345 words good, 67 damaged, 8 lost")


def test_what_a_simulated_unit_can_break_is_broken_from_the_panel(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    simulation = server.get(f"/devices/{standing}/simulation")
    simulation["faults"] = {"speed_sensor": "lost"}
    desk.page.route("**/simulation", lambda route: route.fulfill(json=simulation))
    page = desk.open("/")
    broken = page.get_by_role("group", name="What is broken")
    expect(broken.get_by_label("Speed sensor")).to_have_value("lost")
    desk.picture("simulation-faults", full=True)

    # Its answer, too: a request still under way when the test ends would reach the unit.
    with page.expect_response(lambda answer: answer.request.method == "PUT") as changed:
        broken.get_by_label("Torque sensor").select_option("drifting")

    sent = changed.value.request.post_data_json
    assert sent == {"faults": {"torque_sensor": "drifting"}}
    assert server.get(f"/devices/{standing}/simulation")["faults"] == {}


def test_the_bike_s_surroundings_are_set_from_the_panel(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    simulation = server.get(f"/devices/{standing}/simulation")
    simulation |= {"grip": 0.25, "ambient_degc": -5.0, "walk_button": False}
    desk.page.route("**/simulation", lambda route: route.fulfill(json=simulation))
    page = desk.open("/")
    panel = page.get_by_role("region", name="Simulation")
    expect(panel.get_by_label("Ground under the tyres")).to_have_value("0.25")
    expect(panel.get_by_role("slider", name="Air temperature")).to_have_value("-5")
    expect(panel.get_by_role("slider", name="Rider torque")).to_be_visible()

    def asked(act: Callable[[], None]) -> object:
        with page.expect_response(lambda answer: answer.request.method == "PUT") as change:
            act()
        return change.value.request.post_data_json

    ground = panel.get_by_label("Ground under the tyres")
    assert asked(lambda: ground.select_option(label="ice") and None) == {"grip": 0.1}
    walk = panel.get_by_label("Walk button held")
    assert asked(lambda: walk.dispatch_event("click")) == {"walk_button": True}
    air = panel.get_by_role("slider", name="Air temperature")
    assert asked(lambda: air.press("ArrowRight")) == {"ambient_degc": -4}
    desk.picture("simulation-surroundings", full=True)


def test_a_unit_without_rides_shows_no_other_bike_s(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    identity = {**server.get(f"/devices/{standing}")["identity"], "serial_number": "0" * 24}
    another = {"identity": identity, "unit_key": f"ebl:{identity['serial_number']}"}
    device = {**server.get(f"/devices/{standing}"), **another}
    page = desk.page
    listed = {"items": [device], "next": None}
    page.route("**/api/v1/devices", lambda route: route.fulfill(json=listed))

    desk.open("/")

    expect(page.get_by_role("region", name="Last ride")).to_contain_text("No ride yet")


def test_a_chinese_reader_is_told_why_in_chinese(open_desk: OpenDesk, standing: str) -> None:
    page = open_desk(language="zh-CN").open("/")

    link = page.get_by_role("region", name="链路")
    expect(link).to_contain_text("已与单元建立联系。")
    expect(link).not_to_contain_text("Connected to")


def test_the_first_sentence_says_how_the_bike_is_and_each_part_has_a_lamp(
    desk: Desk, server: SpindleServer, standing: str
) -> None:
    page = desk.open("/")
    name = server.get(f"/devices/{standing}")["identity"]["serial_number"][-6:]
    headline, lamps = page.get_by_test_id("headline"), page.get_by_test_id("lamps")
    expect(headline).to_have_text(f"Simulated {name} is ready to ride")
    expect(lamps.locator("li.ok")).to_have_count(6)
    expect(lamps.locator("[data-lamp=battery]")).to_contain_text("%")
    # By the unit's own law: the fixed law of mode eco has a ratio of one half.
    motor = page.get_by_role("region", name="What is set").locator("dt:has-text('eco') + dd")
    expect(motor).to_have_text("15 Nm")
    told = page.get_by_role("region", name="What is set")
    limits = server.get(f"/devices/{standing}/config")["parameters"]
    cutoff, current = limits["assist_cutoff_kmh"], limits["battery_current_a_max"]
    expect(told).to_contain_text(f"ends at {cutoff:.0f}\u00a0km/h · {current:.0f}\u00a0A")

    unit = server.get(f"/devices/{standing}")
    answers = [{**unit, "faults_active": ["torque_stuck"]}, {**unit, "state": "lost"}]
    listed = {"items": [answers[0]], "next": None}
    page.route("**/api/v1/devices", lambda route: route.fulfill(json=listed))

    expect(headline).to_contain_text("gives no assist")
    expect(lamps.locator("li.bad")).to_contain_text("Torque sensor stuck")
    expect(page.get_by_role("region", name="Do next")).to_contain_text("Mend the fault")
    page.keyboard.press("Enter")
    expect(page.locator("h1")).to_have_text("Service")
    page.go_back()

    listed["items"] = [answers[1]]

    # What was known stays; what only a unit that answers can tell is a dash.
    expect(headline).to_contain_text("was last seen at")
    expect(page.locator(PILL)).to_contain_text("read-only")
    ways = page.get_by_role("link", name="Other ways to connect")
    expect(ways).to_have_attribute("href", "connect")
    expect(lamps.locator("[data-lamp=motor]")).to_contain_text("only while connected")
    expect(lamps.locator("[data-lamp=firmware]")).to_contain_text(
        unit["identity"]["firmware_version"]
    )
    expect(motor).to_have_text("15 Nm")
    expect(page.get_by_role("region", name="Now").locator("dd").first).to_have_text("—")
    desk.picture("bike-lost", full=True)
    page.unroute_all(behavior="ignoreErrors")


def test_the_last_minute_and_the_last_ride_are_drawn_and_told(
    desk: Desk, server: SpindleServer, riding: str
) -> None:
    page = desk.open("/")
    now = page.get_by_role("region", name="Now").get_by_role("img")

    expect(now).to_have_accessible_name(
        re.compile(r"yours up to [1-9]\d*\sW, the motor up to \d+\sW")
    )
    expect(now.locator("path").first).to_have_attribute("d", re.compile(r"^M.*L"))


def test_while_a_ride_is_recorded_the_one_before_it_is_the_last(
    desk: Desk, server: SpindleServer, riding: str
) -> None:
    key = server.get(f"/devices/{riding}")["unit_key"]
    done = {"id": 7, "state": "done", "name": "Morning commute", "unit_key": key}
    live = eventually(
        lambda: server.get("/rides")["items"][0], lambda ride: ride["state"] == "live"
    )
    desk.page.route(
        "**/api/v1/rides?device=*",
        lambda route: route.fulfill(json={"items": [live, {**live, **done}], "next": None}),
    )
    page = desk.open("/")

    expect(page.locator(".headline")).to_contain_text("sport")
    last = page.get_by_role("region", name="Last ride")
    expect(last.get_by_role("link", name="Morning commute")).to_have_attribute("href", "rides/7")
