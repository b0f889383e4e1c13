"""`spindle calibrate start`, `setup`, `capture` ... `close`: a calibration from the shell."""

from __future__ import annotations

import sys
import time
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from backend.cli.client import Server, print_json, print_table, text_of
from backend.cli.device import read_json, server_of
from backend.errors import RequestRefused

LOOK_S = 0.5
STATE = ("kind", "side", "mass_kg", "crank_angle_deg", "stroke", "direction")

Job = dict[str, Any]


def start(options: Namespace) -> int:
    """Opens a calibration, or finds the open one."""
    server = server_of(options)
    question = {"device_id": server.device_id(options.unit)}
    return told(server.ask("POST", "/calibrations", json=question), options)


def setup(options: Namespace) -> int:
    """Instruments and plan from a file."""
    server, path = job_path(options)
    return told(server.ask("PUT", f"{path}/setup", json=read_json(options.file)), options)


def capture(options: Namespace) -> int:
    """Waits until the reading is steady, then takes it; of the next step if none is named."""
    server, path = job_path(options)
    state = asked_state(options) or planned_state(server.ask("GET", path))
    wait_steady(server, path, options.wait)
    free = {"pedals_free": options.pedals_free}
    job = server.ask("POST", f"{path}/captures", json={**state, **free})
    if options.json:
        return told(job, options)
    taken = job["captures"][-1]
    print(capture_line(taken))
    for refusal in taken["refusals"]:
        print(f"  {refusal['code']}: {refusal['sentence']}")
    following = job["next_step"]
    print("All steps are done." if following is None else f"Next: {words(job['steps'][following])}")
    return 0


def drop(options: Namespace) -> int:
    """Strikes a capture out."""
    server, path = job_path(options)
    asked = {"reason": options.reason}
    return told(server.ask("DELETE", f"{path}/captures/{options.number}", params=asked), options)


def fit(options: Namespace) -> int:
    """Holds what follows from the captures; 1 where that would not pass."""
    server, path = job_path(options)
    job = server.ask("POST", f"{path}/fit")
    told(job, options)
    return 0 if job["worked"]["judgement"]["verdict"] != "fail" else 1


def change(options: Namespace) -> int:
    """`write` and `restore`: the unit's record."""
    server, path = job_path(options)
    asked = {"reason": options.reason}
    if options.token is not None:
        asked["token"] = options.token
    return told(server.ask("POST", f"{path}/{options.verb}", params=asked), options)


def verify(options: Namespace) -> int:
    """Waits until the reading is steady, then compares it; 1 where it is not explained."""
    server, path = job_path(options)
    wait_steady(server, path, options.wait)
    question = {"side": options.side, "mass_kg": options.kg, "crank_angle_deg": options.angle}
    job = server.ask("POST", f"{path}/verify", json=question)
    told(job, options)
    last = job["worked"]["verifications"][-1]
    return 0 if last["en"] <= 1 else 1


def close(options: Namespace) -> int:
    """Closes it; nothing of it changes any more."""
    server, path = job_path(options)
    return told(server.ask("POST", f"{path}/close"), options)


def show(options: Namespace) -> int:
    """All of one."""
    server, path = job_path(options)
    return told(server.ask("GET", path), options)


def list_jobs(options: Namespace) -> int:
    """Newest first."""
    server = server_of(options)
    asked = {} if options.unit is None else {"unit_key": unit_key(server, options.unit)}
    answer = server.ask("GET", "/calibrations", params=asked)
    if options.json:
        print_json(answer)
        return 0
    headings = ["", "unit", "state", "opened", "verdict", "uncertainty Nm", "by"]
    print_table([list(row_of(job)) for job in answer["items"]], headings)
    return 0


def certificate(options: Namespace) -> int:
    """The file that `evaluate` reads, or its paper; that of a file without a server."""
    which, manner = options.which, {n: getattr(options, n) for n in ("language", "zone", "paper")}
    output = options.output if options.pdf is None else options.pdf
    if which is not None and not which.isdecimal():
        if options.pdf is None:
            raise RequestRefused("Say with --pdf where the paper of a certificate's file goes.")
        from backend.calibration.paper.pdf import certificate_paper

        data = certificate_paper(read_json(Path(which)), Path(which).name, **manner)
    else:
        options.job = options.job if which is None else int(which)
        server, path = job_path(options)
        if options.pdf is None:
            data = server.response("GET", f"{path}/certificate").content
        else:
            data = server.response("GET", f"{path}/certificate.pdf", params=manner).content
    if output is None:
        sys.stdout.buffer.write(data)
    else:
        Path(output).write_bytes(data)
    return 0


def job_path(options: Namespace) -> tuple[Server, str]:
    """The server, and the path of the calibration that is meant: the only open one unless named.

    Raises RequestRefused where there is none, or several.
    """
    server = server_of(options)
    number = options.job
    if number is None:
        jobs = server.ask("GET", "/calibrations")["items"]
        open_jobs = [job["id"] for job in jobs if job["state"] != "closed"]
        if len(open_jobs) != 1:
            known = ", ".join(map(str, open_jobs)) or "none"
            raise RequestRefused(f"Say which calibration with --job. Open are: {known}.")
        number = open_jobs[0]
    return server, f"/calibrations/{number}"


def unit_key(server: Server, name: str) -> str:
    """The key of a unit by any of its names; of one that is away its key itself."""
    for device in server.ask("GET", "/devices")["items"]:
        if name in (device["id"], device["url"]) and device["unit_key"] is not None:
            return str(device["unit_key"])
    return name


def asked_state(options: Namespace) -> Job | None:
    """What is said to hang there; None where nothing is said."""
    if options.zero:
        kind = "zero"
    elif options.kg is not None:
        kind = "load"
    else:
        return None
    return {
        "kind": kind,
        "side": options.side,
        "mass_kg": options.kg or 0.0,
        "crank_angle_deg": options.angle,
        "stroke": options.stroke,
        "direction": options.direction,
    }


def planned_state(job: Job) -> Job:
    """The next step of the plan. Raises RequestRefused when there is none."""
    if job["next_step"] is None:
        raise RequestRefused("No step is left to be captured: name one, with --kg or --zero.")
    state = job["steps"][job["next_step"]]["state"]
    return {name: state[name] for name in STATE}


def wait_steady(server: Server, path: str, seconds: float) -> None:
    """Until a capture may be taken. When the time is over the server says why not."""
    end_s = time.monotonic() + seconds
    while time.monotonic() < end_s:
        if server.ask("GET", f"{path}/reading")["steady"]:
            return
        time.sleep(LOOK_S)


def told(job: Job, options: Namespace) -> int:
    print_json(job) if options.json else print_job(job)
    return 0


def print_job(job: Job) -> None:
    """Where it stands, and what comes next."""
    where = job["device_id"] or "not connected"
    print(f"Calibration {job['id']} of {job['unit_key']} ({where}): {job['state']}")
    for check in job["checks"]:
        mark = {True: "ok", False: "NOT OK", None: "?"}[check["passed"]]
        print(f"  {mark:6} {check['sentence']}")
    for one in job["captures"]:
        print(f"  {capture_line(one)}")
    print_worked(job["worked"])
    for line in job["record"]:
        if line["planned"] is not None:
            beyond = "  needs the maker's token" if line["beyond"] else ""
            print(
                f"  {line['name']}: {text_of(line['found'])} -> {text_of(line['planned'])}{beyond}"
            )
    if job["unsure"] is not None:
        print(f"Nobody knows whether the unit has it: repeat `{job['unsure']}`.")
    for one in job["clock_set"]:
        dates = "were moved with it" if one["dated"] else "are of the wrong clock"
        print(f"The server's clock was set right at {one['at']}; the dates before {dates}.")
    if job["next_step"] is not None and "capture" in job["may"]:
        print(f"Next: {words(job['steps'][job['next_step']])}")
    print(f"Can be done now: {', '.join(job['may']) or 'nothing'}")


def print_worked(worked: Job | None) -> None:
    """What follows from the captures."""
    if worked is None:
        return
    for refusal in worked["refusals"]:
        print(f"  REFUSED {refusal['code']}: {refusal['sentence']}")
    if worked["fit"] is None:
        return
    for name, value in worked["fit"]["coefficients"].items():
        print(f"  {name:20} {text_of(value)}")
    budget = worked["budget"]
    print(
        f"  uncertainty          {budget['expanded_nm'][-1]:.2f} Nm at {budget['torque_nm'][-1]:g}"
    )
    for one in worked["verifications"]:
        print(
            f"  verified at {one['load_nm']:.2f} Nm: {one['difference_nm']:+.2f} Nm off, "
            f"{one['expanded_nm']:.2f} Nm are explained"
        )
    print(f"  {'judgement':20} {worked['judgement']['verdict']}")
    for cause in worked["judgement"]["causes"]:
        print(f"    {cause['weight']}: {cause['sentence']}")


def capture_line(one: Job) -> str:
    """A capture in one line."""
    struck = "" if one["struck"] is None else f"  struck out: {one['struck']['reason']}"
    reading = "" if one["fitted_nm"] is None else f" {one['fitted_nm']:8.2f} Nm"
    return f"{one['number']:3} {words(one)}: {one['mean_counts']:.1f} counts{reading}{struck}"


def words(step: Job) -> str:
    """What hangs where."""
    state = step["state"]
    what = "zero" if state["kind"] == "zero" else f"{state['mass_kg']:g} kg"
    rest = [state["side"], state["direction"], f"stroke {state['stroke']}"]
    if state["crank_angle_deg"]:
        rest.append(f"at {state['crank_angle_deg']:g}°")
    return f"{what} ({step['load_nm']:.2f} Nm) {', '.join(filter(None, rest))}"


def row_of(job: Job) -> Iterator[Any]:
    """A line of the list."""
    result = job["result"]
    yield from (job["id"], job["unit_key"], job["state"], job["opened_at"][:16])
    yield from (result["verdict"], result["expanded_nm"], job["author"])
