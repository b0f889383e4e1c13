"""Goal: whatever changes something leaves its event, under the name of who did it; no secret gets
into one.

Method: the description gives every operation that may change something. Each is in one of two
tables: what it adds to the audit, or why nothing. A day in the workshop, through the whole server
with a simulated unit, then does all that the first table has, and each event is looked for; the
calibration is one of the bench's. What was secret that day is looked for in all events.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from sqlalchemy import Connection, select

from backend.core.actor import Actor, acting
from backend.core.audit import Action
from backend.store import Store
from backend.store.sql import tables as t
from backend.store.upkeep.audit import verify_audit
from tests.fakes.api import description
from tests.fakes.authenticator import Authenticator
from tests.fakes.house import PASSWORD
from tests.fakes.ride_in_time import end_ride, ride_on
from tests.fakes.server import ServerHere, api_client, eventually
from tests.fakes.track_files import gpx_file, gpx_track
from tests.fakes.workshop import Workshop, open_workshop
from tests.unit.calibration.calibration_job import Workshop as Bench
from tests.unit.visits.kept_visits import history_of_others

pytestmark = pytest.mark.slow
A = Action

# What each operation adds, the newest last.
AUDITED: dict[str, tuple[Action, ...]] = {
    "make_first_person": (A.ACCOUNT_FIRST_ADDED, A.ACCOUNT_SIGNED_IN),
    "sign_in": (A.ACCOUNT_SIGNED_IN,),
    # Everywhere; of one browser it is nobody else's affair.
    "sign_out": (A.ACCOUNT_SIGNED_OUT_EVERYWHERE,),
    "change_own_password": (A.ACCOUNT_PASSWORD_SET, A.ACCOUNT_SIGNED_IN),
    "add_passkey": (A.ACCOUNT_PASSKEY_ADDED,),
    "remove_passkey": (A.ACCOUNT_PASSKEY_REMOVED,),
    "sign_in_with_passkey": (A.ACCOUNT_SIGNED_IN,),
    "add_person": (A.ACCOUNT_ADDED,),
    "change_person": (A.ACCOUNT_CHANGED, A.ACCOUNT_PASSWORD_SET),
    "remove_person": (A.ACCOUNT_REMOVED,),
    "add_key": (A.KEY_ADDED,),
    "revoke_key": (A.KEY_REVOKED,),
    "join_by_pairing": (A.ACCOUNT_ADDED, A.BIKE_TAKEN, A.ACCOUNT_SIGNED_IN),
    "take_pairing": (A.BIKE_TAKEN,),
    "add_bike": (A.BIKE_ADDED,),
    "change_bike": (A.BIKE_CHANGED, A.BIKE_UNIT_CHANGED, A.BIKE_UNIT_CHANGED),
    "pair_bike": (A.BIKE_OFFERED,),
    "leave_bike": (A.BIKE_LEFT,),
    "give_rides": (A.BIKE_RIDES_GIVEN,),
    "remove_bike": (A.BIKE_REMOVED,),
    "open_visit": (A.VISIT_OPENED,),
    "close_visit": (A.VISIT_CLOSED,),
    "consent_to_visit": (A.VISIT_CONSENTED,),
    "remove_visit": (A.VISIT_REMOVED,),
    "add_bike_history": (A.VISIT_BROUGHT,),
    "add_device": (A.UNIT_CONNECTED,),
    "remove_device": (A.UNIT_REMOVED,),
    "clear_faults": (A.UNIT_FAULTS_CLEARED,),
    "erase_log": (A.UNIT_LOG_ERASED,),
    "set_trial_values": (A.UNIT_VALUES_TRIED,),
    "end_trial_values": (A.UNIT_VALUES_ENDED,),
    "patch_config": (A.CONFIGURATION_TRIED,),
    "confirm_config": (A.CONFIGURATION_CONFIRMED,),
    "rollback_config": (A.CONFIGURATION_ROLLED_BACK,),
    "put_part": (A.CONFIGURATION_WRITTEN,),
    "open_calibration": (A.CALIBRATION_OPENED,),
    "write_calibration": (A.CONFIGURATION_WRITTEN, A.CALIBRATION_WRITTEN),
    "restore_calibration": (A.CONFIGURATION_WRITTEN, A.CALIBRATION_RESTORED),
    "close_calibration": (A.CALIBRATION_CLOSED,),
    "patch_ride": (A.RIDE_CHANGED,),
    "tag_rides": (A.RIDE_CHANGED,),
    "delete_ride": (A.RIDE_DELETED,),
    "delete_rides": (A.RIDE_DELETED,),
    "delete_upload": (A.UPLOAD_DELETED,),
    "put_mapping": (A.TABLE_ANSWERED,),
    "forget_table": (A.TABLE_FORGOTTEN,),
    "add_library_item": (A.LIBRARY_ITEM_ADDED,),
    "change_library_item": (A.LIBRARY_ITEM_CHANGED,),
    "remove_library_item": (A.LIBRARY_ITEM_REMOVED,),
    # It changes nothing, and takes everything away.
    "get_backup": (A.STORE_BACKED_UP,),
}
# Not by an operation: found in a unit, by a command, or named when a unit is connected.
BESIDE = {A.UNIT_FIRST_SEEN, A.UNIT_NAMED, A.CONFIGURATION_FOUND, A.STORE_REBUILT}
EXEMPT = {
    "works out what it is asked and keeps nothing": "compute_surface compute_points "
    "compute_torque_surface compute_mode_curves lint_table why_steady why_of_device "
    "evaluate_calibration read_fis prove_limits compare replay_ride ride_again table_use propose "
    "cancel_proposal roll_out_wheel track_wheel count_wheel_pulses check_cadence check_by_climb",
    "adds a file or a ride, which says itself when it came and whose it is": "import_ride "
    "create_upload append_upload sample_ride start_log_download",
    "adds a mark to the ride that is being recorded": "mark_moment",
    "is a step of a calibration, which keeps each with author and moment": "set_up_calibration "
    "capture strike_capture fit_calibration verify_calibration",
    "is a step of a visit, which has each until it is closed": "change_visit look_at_unit "
    "add_visit_photo remove_visit_photo",
    "concerns a simulated unit's surroundings": "put_simulation advance_simulation",
    "gives half a minute of what its key or session allows": "give_ticket",
    "gives five minutes to answer, and keeps nothing": "begin_passkey begin_passkey_sign_in",
}

Step = Callable[[], object]


def may_change() -> set[str]:
    return {
        operation["operationId"]
        for methods in description()["paths"].values()
        for method, operation in methods.items()
        if method not in ("get", "head", "options")
    }


def test_every_operation_that_may_change_something_is_audited_or_exempt() -> None:
    exempt = [one for names in EXEMPT.values() for one in names.split()]

    assert sorted([*AUDITED, *exempt]) == sorted(may_change() | {"get_backup"})


def test_every_action_is_somebody_s() -> None:
    by_operations = {action for actions in AUDITED.values() for action in actions}

    assert by_operations | BESIDE == set(Action)


def store_of(server: ServerHere) -> Store:
    return server.services.store._store


def events_of(store: Store, after_id: int = 0) -> list[dict[str, Any]]:
    query = select(t.audit_event).where(t.audit_event.c.id > after_id).order_by(t.audit_event.c.id)
    return store.database.read(lambda c: [dict(row._mapping) for row in c.execute(query)])


class Watch:
    """Does one operation after the other, and knows what each added. who: acted in each."""

    def __init__(self, store: Store) -> None:
        self.store = store
        self.added: dict[str, tuple[Action, ...]] = {}
        self.events: dict[str, list[dict[str, Any]]] = {}

    def __call__(self, operation: str, step: Step, who: str | None = "Ben") -> Any:
        last = events_of(self.store)
        result = step()
        # What the server finds out meanwhile is its own.
        new = events_of(self.store, last[-1]["id"] if last else 0)
        own = [one for one in new if one["actor_kind"] != "server"]
        assert {one["actor_name"] for one in own} == {who}, operation
        self.added[operation] = tuple(Action(one["action"]) for one in own)
        self.events[operation] = own
        return result


@pytest.fixture(scope="module")
def workshop(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Workshop]:
    with open_workshop(tmp_path_factory.mktemp("day")) as opened:
        # What is asked without a name is Anna's.
        opened.server.client = opened.clients["Anna"]
        yield opened


@pytest.fixture(scope="module")
def day(workshop: Workshop) -> tuple[Watch, list[str]]:
    """All of it once, and the secrets there were."""
    watch = Watch(store_of(workshop.server))
    secrets = [PASSWORD]
    of_people(workshop, watch, secrets)
    of_bikes(workshop, watch, secrets)
    of_visits(workshop, watch, secrets)
    of_rides(workshop, watch)
    of_the_library(workshop, watch)
    of_a_unit(workshop, watch)
    watch("get_backup", lambda: workshop.clients["Anna"].get("/store/backup"), "Anna")
    return watch, secrets


def of_people(workshop: Workshop, watch: Watch, secrets: list[str]) -> None:
    ask, url = workshop.ask, workshop.server.url
    first, second, third = "Noras erstes Wort", "Noras zweites Wort", "Noras drittes Wort"
    secrets += [first, second, third]
    new = {"name": "Nora", "role": "dealer", "password": first}
    nora = watch("add_person", lambda: ask("Anna", "POST", "/people", json=new), "Anna")["id"]
    change = {"role": "rider", "password": second}
    watch("change_person", lambda: ask("Anna", "PATCH", f"/people/{nora}", json=change), "Anna")
    with api_client(url, origin=url) as own:

        def done(method: str, path: str, **body: str) -> None:
            answer = own.request(method, path, json=body or None)
            assert answer.is_success, answer.text
            secrets.extend(filter(None, [own.cookies.get("spindle_session")]))

        watch("sign_in", lambda: done("POST", "/sign-in", name="nora", password=second), "Nora")
        new = {"old": second, "new": third}
        watch("change_own_password", lambda: done("PUT", "/session/password", **new), "Nora")
        watch("sign_out", lambda: done("DELETE", "/session?everywhere=true"), "Nora")
    of_passkeys(url.replace("127.0.0.1", "localhost"), watch, {"name": "Nora", "password": third})
    watch("remove_person", lambda: ask("Anna", "DELETE", f"/people/{nora}"), "Anna")
    body = {"name": "bench", "scopes": ["change_register"]}
    key = watch("add_key", lambda: ask("Ben", "POST", "/keys", json=body))
    secrets += [key["secret"], key["secret"].split("_")[-1]]
    made = watch("add_bike", lambda: by_key(workshop, key["secret"], "/bikes", name="program's"))
    assert made.status_code == 201, made.text
    assert [one["actor_key"] for one in watch.events["add_bike"]] == ["bench"]
    watch("revoke_key", lambda: ask("Ben", "DELETE", f"/keys/{key['key']['id']}"))


def of_passkeys(url: str, watch: Watch, who: dict[str, str]) -> None:
    """By the server's name: at an address there are none."""
    with api_client(url, origin=url) as own:

        def done(method: str, path: str, body: dict[str, str] | None = None) -> Any:
            answer = own.request(method, path, json=body)
            assert answer.is_success, answer.text
            return answer.json() if answer.content else None

        done("POST", "/sign-in", who)
        asked = done("POST", "/session/passkeys/challenges", {"password": who["password"]})
        phone = Authenticator(url)
        made = {"name": "phone", **phone.make(asked)}
        passkey = watch("add_passkey", lambda: done("POST", "/session/passkeys", made), "Nora")
        proof = phone.prove(done("POST", "/sign-in/passkey/challenges"))
        watch("sign_in_with_passkey", lambda: done("POST", "/sign-in/passkey", proof), "Nora")
        own_key = f"/session/passkeys/{passkey['id']}"
        watch("remove_passkey", lambda: done("DELETE", own_key), "Nora")


def by_key(workshop: Workshop, secret: str, path: str, **body: str) -> httpx.Response:
    with api_client(workshop.server.url) as program:
        return program.post(path, json=body, headers={"authorization": f"Bearer {secret}"})


def of_bikes(workshop: Workshop, watch: Watch, secrets: list[str]) -> None:
    ask = workshop.ask
    bike = ask("Ben", "POST", "/bikes", json={"name": "Blue"})["bike"]["id"]

    def offer() -> str:
        code: str = ask("Ben", "POST", f"/bikes/{bike}/pairing", json={})["code"]
        secrets.extend([code, code.replace("-", "")])
        return code

    code = watch("pair_bike", offer)
    watch("take_pairing", lambda: ask("Rita", "POST", f"/pairings/{code}"), "Rita")
    watch("leave_bike", lambda: ask("Ben", "DELETE", f"/bikes/{bike}/owner"))
    other = offer()
    account = {"name": "Zoe", "password": "Zoes einziges Wort"}
    secrets.append("Zoes einziges Wort")
    with api_client(workshop.server.url) as stranger:
        path = f"/pairings/{other}/account"
        watch("join_by_pairing", lambda: stranger.post(path, json=account), "Zoe")
    track = gpx_file(gpx_track((9000, 9100)))
    [ride] = workshop.send("Ben", "found.gpx", track)["ride_ids"]
    empty = ask("Ben", "POST", "/bikes", json={"name": "Red"})["bike"]["id"]
    watch("remove_bike", lambda: ask("Ben", "DELETE", f"/bikes/{empty}"))
    given = {"ride_ids": [ride]}
    watch("give_rides", lambda: ask("Ben", "POST", f"/bikes/{bike}/rides", json=given))


def of_visits(workshop: Workshop, watch: Watch, secrets: list[str]) -> None:
    ask, bike = workshop.ask, workshop.bikes["Rita"]
    words = {"complaint": "rattles at night", "customer": "Ritas Tante"}
    secrets += words.values()

    def begun() -> Any:
        return ask("Ben", "POST", f"/bikes/{bike}/visits", json=words)

    mistake = watch("open_visit", begun)["id"]
    watch("remove_visit", lambda: ask("Ben", "DELETE", f"/visits/{mistake}"))
    visit = begun()
    hashed = {"content_sha256": visit["content_sha256"]}
    signed = {"name": "Ritas Tante", "strokes": [[0.1, 0.1, 0.5, 0.5]], **hashed}
    path = f"/visits/{visit['id']}"
    watch("consent_to_visit", lambda: ask("Ben", "POST", f"{path}/consent", json=signed))
    watch("close_visit", lambda: ask("Ben", "POST", f"{path}/close"))
    history = workshop.clients["Ben"].get(f"/bikes/{bike}/history").content
    # As another server would have it: the visits of this one are known here.
    theirs = {"content": history_of_others(history, visit["token"])}
    path = f"/bikes/{bike}/history"
    added = watch("add_bike_history", lambda: ask("Ben", "POST", path, **theirs))
    assert added == {"added": 1, "known": 0}


def of_rides(workshop: Workshop, watch: Watch) -> None:
    ask = workshop.ask
    mine, another = workshop.rides["Rita"], workshop.rides["Olaf"]
    words = {"name": "to the clinic", "notes": "met nobody"}
    watch("patch_ride", lambda: ask("Rita", "PATCH", f"/rides/{mine}", json=words), "Rita")
    tags = {"ride_ids": [another], "add": ["secretive"]}
    watch("tag_rides", lambda: ask("Olaf", "POST", "/rides/tags", json=tags), "Olaf")
    watch("delete_ride", lambda: ask("Rita", "DELETE", f"/rides/{mine}"), "Rita")
    gone = {"ride_ids": [another]}
    watch("delete_rides", lambda: ask("Olaf", "POST", "/rides/delete", json=gone), "Olaf")
    junk = workshop.send("Ben", "clinic.fit", b"no ride at all")["id"]
    watch("delete_upload", lambda: ask("Ben", "DELETE", f"/uploads/{junk}"))
    rows = "".join(f"2023-07-01T09:04:{s:02},5.0,{70 + s}\n" for s in range(30))
    table = workshop.send("Ben", "one.csv", f"timestamp,speed,cadence\n{rows}".encode())
    answer = {"time_zone": "Europe/Dublin", "units": {"speed": "m/s"}}
    path = f"/uploads/{table['id']}/mapping"
    watch("put_mapping", lambda: ask("Ben", "PUT", path, json=answer))
    [known] = ask("Ben", "GET", "/tables")["items"]
    watch("forget_table", lambda: ask("Ben", "DELETE", f"/tables/{known['header_sha256']}"))


def of_the_library(workshop: Workshop, watch: Watch) -> None:
    ask = workshop.ask
    document = ask("Ben", "GET", "/library/even") | {"name": "Evener"}
    row = watch("add_library_item", lambda: ask("Ben", "POST", "/library", json=document))
    path, other = f"/library/{row['id']}", document | {"comment": "flat"}
    watch("change_library_item", lambda: ask("Ben", "PUT", path, json=other))
    watch("remove_library_item", lambda: ask("Ben", "DELETE", path))


def of_a_unit(workshop: Workshop, watch: Watch) -> None:
    ask, server = workshop.ask, workshop.server
    body = {"url": "sim:day?seed=5&clock=virtual&scenario=none"}
    device = watch("add_device", lambda: ask("Ben", "POST", "/devices", json=body))["id"]
    path = f"/devices/{device}"
    eventually(lambda: server.get(path)["state"], lambda state: state == "ready")
    eventually(lambda: server.get(f"{path}/config/revisions")["items"])
    ask("Ben", "POST", "/devices", json=body | {"name": "City"})
    found = ask("Ben", "GET", path)
    change = {"unit_key": found["unit_key"], "frame_number": "WBK1"}
    bike = f"/bikes/{workshop.bikes['Olaf']}"
    watch("change_bike", lambda: ask("Ben", "PATCH", bike, json=change))
    of_a_configuration(workshop, watch, path, device)
    of_faults_and_logs(workshop, watch, path, device)
    watch("remove_device", lambda: ask("Ben", "DELETE", path))


def of_a_configuration(workshop: Workshop, watch: Watch, path: str, device: str) -> None:
    ask, server = workshop.ask, workshop.server

    def tried(value: float) -> Any:
        server.until_writable(device)
        body = {"parameters": {"motor_torque_nm_max": value}, "reason": "it bucked"}
        return ask("Ben", "PATCH", f"{path}/config", json=body | {"confirm_s": 60})

    watch("patch_config", lambda: tried(1.5))
    watch("rollback_config", lambda: ask("Ben", "POST", f"{path}/config/rollback"))
    tried(1.75)
    watch("confirm_config", lambda: ask("Ben", "POST", f"{path}/config/confirm"))
    values = {"parameters": {"torque_filter_s": 0.75}, "ttl_s": 60}
    watch("set_trial_values", lambda: ask("Ben", "POST", f"{path}/trial-values", json=values))
    watch("end_trial_values", lambda: ask("Ben", "DELETE", f"{path}/trial-values"))
    server.until_writable(device)
    modes = ask("Ben", "GET", f"{path}/parts/assist_modes")
    modes["modes"][1]["ratio"] = 0.75
    watch("put_part", lambda: ask("Ben", "PUT", f"{path}/parts/assist_modes", json=modes))


def of_faults_and_logs(workshop: Workshop, watch: Watch, path: str, device: str) -> None:
    ask, server = workshop.ask, workshop.server
    ride_on(server, device, 15.0)
    end_ride(server, device)
    log = ask("Ben", "GET", f"{path}/logs")["items"][-1]["log_id"]
    server.simulate(device, clock="real")
    ask("Ben", "POST", f"{path}/logs/{log}/download")
    eventually(
        lambda: ask("Ben", "GET", f"{path}/logs/{log}/download")["state"],
        lambda state: state == "done",
    )
    watch("erase_log", lambda: ask("Ben", "DELETE", f"{path}/logs/{log}"))
    server.simulate(device, clock="virtual", faults={"torque_sensor": "open_high"})
    server.advance(device, 2.0)
    server.simulate(device, faults={"torque_sensor": "sound"})
    server.advance(device, 5.0)
    watch("clear_faults", lambda: ask("Ben", "POST", f"{path}/faults/clear"))


BY_HAND = {
    "make_first_person",
    "open_calibration",
    "write_calibration",
    "restore_calibration",
    "close_calibration",
}


def test_each_of_them_leaves_its_events(day: tuple[Watch, list[str]]) -> None:
    watch, _ = day

    assert watch.added == {name: AUDITED[name] for name in AUDITED if name not in BY_HAND}


def test_who_signs_in_by_the_first_link_is_its_first_event(tmp_path: Path) -> None:
    with ServerHere(tmp_path / "new", SPINDLE_AUTH="required") as server:
        people = server.services.people
        assert people is not None
        token = people.accounts.first_token()
        watch = Watch(store_of(server))
        body = {"name": "Anna", "password": PASSWORD, "token": token}
        watch("make_first_person", lambda: server.ask("POST", "/first-person", json=body), "Anna")

        assert watch.added == {"make_first_person": AUDITED["make_first_person"]}
        assert hidden_in(watch.store, [PASSWORD, str(token)]) == []


def test_a_calibration_is_written_taken_back_and_closed_under_a_name(tmp_path: Path) -> None:
    bench = Bench(tmp_path)
    watch, record = Watch(bench.store), bench.use.record
    try:
        with acting(Actor("person", "Ada", 3)):
            watch("open_calibration", bench.open, "Ada")
            job = bench.fitted()
            write = "write_calibration"
            watch(write, lambda: record.write(job.id, "spring service", "Ada"), "Ada")
            watch("restore_calibration", lambda: record.restore(job.id, "", "Ada"), "Ada")
            watch("close_calibration", lambda: record.close(job.id, "Ada"), "Ada")
    finally:
        bench.stop()

    assert watch.added == {name: AUDITED[name] for name in BY_HAND if "calibration" in name}
    written = watch.events["write_calibration"][-1]
    before, after = json.loads(written["before"]), json.loads(written["after"])
    assert "sensor_gain_nm_per_count" in before.keys() & after.keys()
    assert (written["reason"], written["object_id"]) == ("spring service", str(job.id))
    assert written["unit_key"] == job.unit_key


def hidden_in(store: Store, secrets: list[str]) -> list[str]:
    """Those secrets, and hashes of secrets, that stand in an event."""

    def hashes(connection: Connection) -> list[str]:
        columns = (
            t.account.c.password,
            t.session.c.token_sha256,
            t.api_key.c.secret_sha256,
            t.pairing.c.code_sha256,
        )
        return [one for column in columns for one in connection.execute(select(column)).scalars()]

    kept = store.database.read(hashes)
    made = [hashlib.sha256(one.encode()).hexdigest() for one in secrets]
    everything = json.dumps(events_of(store), ensure_ascii=False)
    return [one for one in (*secrets, *made, *kept) if one in everything]


def test_no_secret_and_no_hash_of_one_is_in_an_event(day: tuple[Watch, list[str]]) -> None:
    watch, secrets = day

    assert len(set(secrets)) >= 11
    assert all(len(one) >= 8 for one in secrets)
    assert hidden_in(watch.store, secrets) == []


def test_no_word_of_a_ride_or_a_file_is_in_an_event(day: tuple[Watch, list[str]]) -> None:
    """What somebody deletes is gone; the audit stays."""
    watch, _ = day

    for word in ("clinic", "nobody", "secretive", "Rita.gpx", "found.gpx"):
        assert word not in json.dumps(events_of(watch.store))
    [changed] = watch.events["patch_ride"]
    assert json.loads(changed["after"]) == {"changed": ["name", "notes"]}


def test_a_configuration_tells_from_what_to_what_and_why(day: tuple[Watch, list[str]]) -> None:
    watch, _ = day
    [tried] = watch.events["patch_config"]
    [confirmed] = watch.events["confirm_config"]

    assert json.loads(tried["before"]) == {"motor_torque_nm_max": 2.0}
    assert json.loads(tried["after"]) == {"motor_torque_nm_max": 1.5}
    assert (tried["reason"], tried["actor_name"]) == ("it bucked", "Ben")
    assert int(confirmed["object_id"]) > int(tried["object_id"])
    assert {tried["bike_id"], confirmed["bike_id"]} == {watch.events["change_bike"][0]["bike_id"]}


def test_what_no_operation_is_for_has_its_events_too(day: tuple[Watch, list[str]]) -> None:
    watch, _ = day
    events = {one["action"]: one for one in events_of(watch.store)}
    seen, named = events[A.UNIT_FIRST_SEEN], events[A.UNIT_NAMED]

    assert {seen["actor_kind"], events[A.CONFIGURATION_FOUND]["actor_kind"]} == {"server"}
    assert (seen["unit_key"], seen["bike_id"]) == (named["unit_key"], named["bike_id"])
    assert (named["actor_name"], named["object_name"]) == ("Ben", "City")
    moved = watch.events["change_bike"][1:]
    assert {one["unit_key"] for one in moved} == {seen["unit_key"]}
    assert [json.loads(one["before"])["unit_key"] for one in moved] == [None, seen["unit_key"]]


def test_the_chain_of_that_day_fits(day: tuple[Watch, list[str]], workshop: Workshop) -> None:
    watch, _ = day
    url = watch.store.database.engine.url.render_as_string(hide_password=False)

    check = verify_audit(url)

    assert check.misfit is None
    assert check.events == len(events_of(watch.store)) > 60
