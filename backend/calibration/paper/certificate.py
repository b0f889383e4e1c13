"""The certificate as a document: who, when, with what; the judgement; all it rests on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from backend.calibration.paper.content import Certified, Manner, number
from backend.calibration.paper.tables import (
    budget_table,
    captures_table,
    figures_table,
    fit_table,
    loop_picture,
    residual_picture,
    verification_table,
    what,
)
from backend.calibration.paper.words import LANGUAGES, cause
from backend.calibration.setup import Mass
from backend.calibration.worked import Worked
from backend.paper.sheet import (
    BAD,
    OK,
    QUIET,
    SMALL,
    WARN,
    Cover,
    facts,
    printed,
    section,
    side_by_side,
    signatures,
    text,
    together,
)

MM_PER_M, G_PER_KG = 1000, 1000
VERDICTS = {"pass": OK, "conditional": WARN, "fail": BAD}


def certificate_pdf(certified: Certified, manner: Manner) -> bytes:
    """The file; the same bytes for the same certificate and manner."""
    about, sha256 = certified.evaluated.content.about, certified.evaluated.sha256
    title = manner.say("title")
    named = about.bike or about.serial or about.unit_key
    cover = Cover(
        title=f"{title} · {named}",
        author=about.technician or "",
        foot=f"{title} · {manner.say('number', number=about.number)} · SHA-256 {sha256[:16]}",
        pages=manner.say("page", page="{page}", pages="{pages}"),
        language=LANGUAGES[manner.language],
        paper=manner.paper,
    )
    return printed(cover, list(_parts(certified, manner)))


def _parts(certified: Certified, manner: Manner) -> Iterator[Any]:
    say, worked = manner.say, certified.evaluated.worked
    yield text(say("title"), 17, bold=True, below=2)
    yield text(say("number", number=certified.evaluated.content.about.number), 10, QUIET, below=5)
    if not certified.evaluated.reproduced:
        count = len(certified.evaluated.differences)
        yield text(say("changed", count=count), 10, BAD, bold=True, below=4)
    if certified.closed_us is None:
        yield text(say("open"), colour=WARN, bold=True, below=4)
    for one in certified.clock_set:
        words = "clock_set_dated" if one.dated else "clock_set"
        yield text(say(words, when=manner.moment(one.at_us)), colour=WARN, below=4)
    yield facts(list(_whose(certified, manner)), manner.width)
    yield from section(say("judgement"), *_judgement(worked, manner))
    yield from section(
        say("instruments"), facts(list(_instruments(certified, manner)), manner.width)
    )
    if worked.fit is not None:
        yield from _fitted(certified, worked, manner)
    yield from section(say("captures"), captures_table(certified, worked, manner))
    if certified.struck:
        yield from section(say("struck"), *_struck(certified, manner))
    signed = signatures((say("sign_technician"), say("sign_owner")), manner.width)
    yield together(*section(say("reproduce"), *_reproduce(certified, manner)), signed)


def _fitted(certified: Certified, worked: Worked, manner: Manner) -> Iterator[Any]:
    """What there is with a fit only."""
    say, fit = manner.say, worked.fit
    assert fit is not None
    yield from section(say("fit"), fit_table(certified, fit, manner))
    if fit.coefficients.reference_degc is not None and len(fit.names) > 2:
        degc = f"{fit.coefficients.reference_degc:g}"
        yield text(say("reference", degc=degc), SMALL, QUIET)
    if worked.verifications:
        yield from section(say("verification"), verification_table(worked, manner))
    else:
        yield from section(say("verification"), text(say("no_verification")))
    yield from section(say("figures"), figures_table(certified, worked, manner))
    pictures = (residual_picture(certified, worked, manner), loop_picture(worked, manner))
    heads = (text(say("residuals"), 11, bold=True), text(say("loop"), 11, bold=True))
    columns = [[head, picture] for head, picture in zip(heads, pictures, strict=True)]
    yield side_by_side(columns, manner.width)
    yield text(say("legend"), SMALL, QUIET)
    if worked.piecewise is not None:
        pairs = "; ".join(
            f"{number(at, 1)}: {number(more, 3, sign=True)}"
            for at, more in zip(
                worked.piecewise.reading_nm, worked.piecewise.correction_nm, strict=True
            )
        )
        yield text(say("piecewise", pairs=pairs), SMALL, QUIET)
    if worked.budget is not None:
        yield from section(say("budget"), budget_table(worked, manner))


def _whose(certified: Certified, manner: Manner) -> Iterator[tuple[str, str]]:
    say, about = manner.say, certified.evaluated.content.about
    times = [one.at_utc_us for one in certified.evaluated.content.captures]
    degc = [
        one.state.sensor_degc
        for one in certified.evaluated.content.captures
        if one.state.sensor_degc is not None
    ]
    yield say("bike"), about.bike or ""
    yield say("technician"), about.technician or say("nobody")
    yield say("serial"), about.serial or ""
    if times:
        first, last = manner.moment(min(times)), manner.moment(max(times))
        yield say("captured"), say("from_to", first=first, last=last)
    yield say("unit"), about.unit_key
    yield say("fitted"), manner.moment(about.created_utc_us)
    yield say("model"), about.model or ""
    yield say("closed"), "" if certified.closed_us is None else manner.moment(certified.closed_us)
    yield say("firmware"), about.firmware_version or ""
    change = certified.change
    yield (
        say("in_unit"),
        say("not_written")
        if change is None
        else say(change.kind, when=manner.moment(change.at_us), generation=change.generation),
    )
    yield say("market"), about.market or ""
    yield say("software"), about.software
    if degc:
        between = say("from_to", first=f"{min(degc):.1f}", last=f"{max(degc):.1f}")
        yield say("sensor_degc"), f"{between} °C"


def _judgement(worked: Worked, manner: Manner) -> Iterator[Any]:
    judged = worked.judgement
    yield text(manner.say(judged.verdict), 14, VERDICTS[judged.verdict], bold=True, below=2)
    for one in judged.causes:
        sentence = cause(manner.language, one)
        yield text(f"{manner.say(one.weight)}: {sentence}", colour=VERDICTS.get(one.weight, QUIET))
    if not judged.causes:
        yield text(manner.say("no_causes"))


def _instruments(certified: Certified, manner: Manner) -> Iterator[tuple[str, str]]:
    say, setup = manner.say, certified.evaluated.content.setup
    gravity = setup.gravity
    pull = f"{number(gravity.gravity_ms2, 5)} ± {number(gravity.standard_ms2, 5)} m/s² (k = 1)"
    if gravity.source == "place":
        place = {"latitude": f"{gravity.latitude_deg:g}", "height": f"{gravity.height_m:g}"}
        pull = say("gravity_place", value=pull, **place)
    arm, limit = (MM_PER_M * value for value in (setup.arm_m, setup.arm_limit_m))
    yield say("arm"), f"{number(arm, 1)} ± {number(limit, 2)} mm"
    yield say("gravity"), pull
    yield say("masses"), "; ".join(_mass(mass, manner) for mass in setup.masses)
    yield say("loads"), f"{', '.join(f'{kg:g}' for kg in setup.loads_kg)} kg"
    sides = ", ".join(say(side).lower() for side in setup.sides)
    yield say("strokes"), say("strokes_of", count=setup.strokes, sides=sides)
    yield say("angles"), f"{', '.join(f'{deg:g}' for deg in setup.angles_deg)}°"
    yield say("level"), f"± {setup.level_limit_deg:g}°"
    yield say("full_scale"), f"{setup.full_scale_nm:g} Nm"
    yield say("resolution"), say("counts", value=f"{setup.resolution_counts:g}")
    yield say("thermometer"), f"± {setup.thermometer_limit_k:g} K"
    yield say("limits"), manner.choice(certified.evaluated.content.limits.source)


def _mass(mass: Mass, manner: Manner) -> str:
    sure = (
        f"± {number(mass.limit_kg * G_PER_KG, 1)} g"
        if mass.limit_kg is not None
        else manner.say("class", name=mass.mass_class)
    )
    return f"{mass.name}, {mass.mass_kg:g} kg ({sure})"


def _struck(certified: Certified, manner: Manner) -> Iterator[Any]:
    for one in certified.struck:
        yield text(
            manner.say(
                "struck_one",
                number=one.capture.number,
                what=what(one.capture.state, manner),
                mean=number(one.capture.mean_counts, 2),
                author=one.author or manner.say("nobody"),
                reason=one.reason or manner.say("no_reason"),
            )
        )


def _reproduce(certified: Certified, manner: Manner) -> Iterator[Any]:
    yield text(manner.say("reproduce_text"))
    yield text(f"spindle calibrate evaluate {certified.file}", bold=True, below=2)
    pairs = [(manner.say("sha256"), certified.evaluated.sha256)]
    if certified.unit_sha256 is not None:
        pairs.append((manner.say("unit_sha256"), certified.unit_sha256))
    yield facts(pairs, manner.width, columns=1)
