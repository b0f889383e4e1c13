"""The report's page: tables as text, pictures as plotly figures with the library beside them.

The library is the one that plotly's Python package carries (4.8 MB): it is here wherever the server
is, while the pages' own smaller build need not be. The file asks nobody for anything.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

from backend.core.quantities import plain
from backend.core.ride_events import RideEvent
from backend.rides.insight.charge import Charge
from backend.rides.report.charts import crank_chart, curve_chart, energy_chart, zones_chart
from backend.rides.report.track_map import track_map
from backend.rides.report.words import WORDS
from backend.rides.traces.track import Track

PICTURE = {"displaylogo": False, "plotlyServerURL": "", "responsive": True}
FIGURES = (
    ("distance_km", "km", 2),
    ("duration_s", "", 0),
    ("moving_s", "", 0),
    ("speed_kmh_mean", "km/h", 1),
    ("speed_kmh_max", "km/h", 1),
    ("ascent_m", "m", 0),
    ("rider_wh", "Wh", 1),
    ("motor_wh", "Wh", 1),
    ("battery_wh", "Wh", 1),
    ("rider_power_w_mean", "W", 0),
    ("cadence_rpm_mean", "rpm", 0),
)
UNITS = {"power": "W", "heart_rate": "bpm", "torque": "Nm", "cadence": "rpm"}
STYLE = """
body{font:15px/1.5 system-ui,sans-serif;max-width:62rem;margin:1.5rem auto;padding:0 1rem}
h1{font-size:1.5rem;margin:0}h2{font-size:1.1rem;margin:1.6rem 0 .4rem}
table{border-collapse:collapse;width:100%}
th,td{padding:.25rem .6rem;border-bottom:1px solid #ccd5d1}
th{text-align:left}td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}
dl{display:grid;grid-template-columns:repeat(auto-fill,minmax(9rem,1fr));gap:.6rem;margin:0}
dt{font-size:.85rem;color:#4a5753}dd{margin:0;font-size:1.15rem;font-weight:600}
.quiet{color:#4a5753;font-size:.85rem}.two{display:grid;grid-template-columns:1fr 1fr;gap:1rem}
section{break-inside:avoid}
.map{display:block;width:100%;background:#f1f3ef;border-radius:5px;print-color-adjust:exact}
.map path,.key path{fill:none;stroke-linejoin:round}.map path[fill]{fill:#00795a}
.map text{font-size:13px;fill:#4b5956}
.map .b{font-weight:650;fill:#10201d;paint-order:stroke;stroke:#f1f3ef;stroke-width:3px}
.key{width:48px;height:14px;vertical-align:middle}
.keys{display:flex;flex-wrap:wrap;gap:.2rem 1.4rem;margin:.4rem 0}
@media(max-width:700px){.two{grid-template-columns:1fr}}
@media print{body{margin:0;max-width:none}.modebar{display:none}}
"""


@dataclass(frozen=True)
class ReportContent:
    """What a report is made of: title, facts below it, figures by name, where and in which modes
    it went, and the answers that the API gives. traces: a plotly Figure, None for a ride without
    any."""

    title: str
    facts: str
    version: str
    figures: Mapping[str, float | None]
    track: Track
    events: Sequence[RideEvent]
    traces: Any
    energy: Mapping[str, Any]
    effort: Mapping[str, Any]
    pedalling: Mapping[str, Any]
    diagnosis: Mapping[str, Any]


def page(content: ReportContent, language: str) -> Iterator[str]:
    """The file, piece by piece. language: one of WORDS."""
    from plotly.offline import get_plotlyjs

    words = WORDS[language]
    yield f'<!doctype html><html lang="{language}"><head><meta charset="utf-8">'
    yield '<meta name="viewport" content="width=device-width">'
    yield f"<title>{escape(content.title)}</title><style>{STYLE}</style>"
    yield "<script>"
    yield get_plotlyjs()
    yield "</script></head><body>"
    yield f'<h1>{escape(content.title)}</h1><p class="quiet">{escape(content.facts)}</p>'
    yield figures(content.figures, words)
    names = {mode["mode"]: mode["name"] for mode in content.energy["modes"]}
    if drawn := track_map(content.track, content.events, names, words):
        yield f"<section><h2>{words['map']}</h2>{drawn}</section>"
    if content.traces is not None:
        yield f"<section><h2>{words['traces']}</h2>{picture(content.traces)}</section>"
    yield from energy(content.energy, words)
    yield from effort(content.effort, words)
    yield crank(content.pedalling["crank"], words)
    yield health(content.diagnosis, words)
    made = words["made"].format(version=content.version)
    yield f'<p class="quiet">{escape(made)}</p></body></html>'


def figures(figures_by_name: Mapping[str, float | None], words: Mapping[str, str]) -> str:
    """The headline, without what the ride does not have."""
    cells = []
    for name, unit, digits in FIGURES:
        value = figures_by_name.get(name)
        if value is not None:
            text = clock(value) if name.endswith("_s") else f"{number(value, digits)} {unit}"
            cells.append(f"<div><dt>{words[name]}</dt><dd>{text}</dd></div>")
    return f"<section><h2>{words['figures']}</h2><dl>{''.join(cells)}</dl></section>"


def energy(values: Mapping[str, Any], words: Mapping[str, str]) -> Iterator[str]:
    """By mode and by gradient, and the charge."""
    bands = values["gradients"] or []
    parts = [
        ("mode", values["modes"], [mode_name(one, words) for one in values["modes"]]),
        ("gradient", bands, [span(one, "pct", "%") for one in bands]),
    ]
    yield f"<section><h2>{words['energy']}</h2>"
    for key, shares, labels in parts:
        if shares:
            yield energy_table(words[key], labels, shares, words)
            if any(share["rider_wh"] or share["motor_wh"] for share in shares):
                yield picture(energy_chart(labels, shares, words[key], words))
    if bands:
        yield f'<p class="quiet">{words["gradient_method"]}</p>'
    if values["charge"]:
        yield f"<p>{charge(values['charge'], words)}</p>"
    yield "</section>"


def energy_table(
    head: str, labels: Sequence[str], shares: Sequence[Mapping[str, Any]], words: Mapping[str, str]
) -> str:
    """One row a group."""
    columns = [("distance_km", "km", 2), ("seconds", words["time"], 0)]
    columns += [(name, f"{words[name]}, Wh", 1) for name in ("rider_wh", "motor_wh", "battery_wh")]
    columns.append(("motor_per_rider", words["ratio"], 2))
    shown = [one for one in columns if any(share[one[0]] is not None for share in shares)]
    rows = [
        [
            label,
            *(
                clock(share[name]) if name == "seconds" else number(share[name], digits)
                for name, _, digits in shown
            ),
        ]
        for label, share in zip(labels, shares, strict=True)
    ]
    return table([head, *(title for _, title, _ in shown)], rows)


def charge(used: Charge, words: Mapping[str, str]) -> str:
    """What was used, and the range with its band where there is one."""
    ends = {"first": used.soc_pct_first, "last": used.soc_pct_last, "used": used.used_pct}
    texts = [words["charge"].format(**{name: number(pct, 1) for name, pct in ends.items()})]
    texts += [
        words["jump"].format(
            time=clock(jump.at_s), before=number(jump.from_pct, 0), after=number(jump.to_pct, 0)
        )
        for jump in used.jumps
    ]
    if used.range_km is not None:
        most = used.range_km_most
        range_text = words["range"].format(
            range=number(used.range_km, 0),
            least=number(used.range_km_least, 0),
            most=words["no_end"] if most is None else f"{number(most, 0)} km",
            full=number(used.full_range_km, 0),
        )
        texts.append(range_text)
    return " ".join(texts)


def effort(values: Mapping[str, Any], words: Mapping[str, str]) -> Iterator[str]:
    """Zones, bands and the power curve."""
    yield '<section class="two">'
    for name, unit in UNITS.items():
        if values[name]:
            bands = values[name]["bands"]
            labels = [span(band, "", "", ("low", "high")) for band in bands]
            title = f"{words[name]}, {unit}"
            if values[name]["zones"]:
                labels = [f"Z{place} {label}" for place, label in enumerate(labels, start=1)]
                reference = f"{number(values[name]['reference'], 0)} {unit}"
                title += f", {words['zones_of'].format(reference=reference)}"
            spent = [band["seconds"] for band in bands]
            yield f"<div>{picture(zones_chart(labels, spent, title))}</div>"
    if values["power_curve"]:
        yield f"<div>{picture(curve_chart(values['power_curve'], words['power_curve']))}</div>"
    yield "</section>"


def crank(values: Mapping[str, Any] | None, words: Mapping[str, str]) -> str:
    """Torque round the crank, where it was recorded fast enough to tell."""
    if values is None:
        return ""
    facts = [words["dead_spot"].format(angle=number(values["dead_spot_deg"], 0))]
    if values["left_share"] is not None:
        share = number(100.0 * values["left_share"], 0)
        facts.insert(0, words["left_share"].format(share=share))
    if values["lag_deg"] is not None:
        angle, late_ms = number(values["lag_deg"], 0), number(values["lag_ms"], 0)
        facts.append(words["lag"].format(angle=angle, late_ms=late_ms))
    return (
        f"<section><h2>{words['crank']}</h2>{picture(crank_chart(values, words))}"
        f"<p>{escape(' '.join(facts))}</p></section>"
    )


def health(values: Mapping[str, Any], words: Mapping[str, str]) -> str:
    """Every question with its answer."""
    rows = []
    for check in values["checks"]:
        if check["state"] == "found":
            answer = "<br>".join(finding_line(one, words) for one in check["findings"])
        elif check["state"] == "impossible":
            answer = escape(words["impossible"].format(missing=named(check["missing"], words)))
        else:
            answer = words["clean"]
        rows.append(f"<tr><th>{words[check['name']]}</th><td>{answer}</td></tr>")
    return f"<section><h2>{words['health']}</h2><table>{''.join(rows)}</table></section>"


def named(missing: Sequence[str], words: Mapping[str, str]) -> str:
    """What a question lacks, in words."""
    return ", ".join(words.get(name, name) for name in missing)


def finding_line(one: Mapping[str, Any], words: Mapping[str, str]) -> str:
    """A finding in a line: how bad, where, and what, with its numbers."""
    numbers = {name: plain(value, 3) for name, value in one["numbers"].items()}
    channel = words.get(one["channel"] or "", one["channel"])
    sentence = words[f"{one['kind']}_found"].format(channel=channel, **numbers)
    where = f"{clock(one['from_s'])}–{clock(one['to_s'])}"
    return f"<b>{words[one['severity']]}</b>, {where}: {escape(sentence)}"


def table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Text in the first column, numbers in the others."""

    def line(cells: Sequence[str], tag: str) -> str:
        first, *others = map(escape, cells)
        return f"<tr><{tag}>{first}</{tag}>" + "".join(
            f'<{tag} class="n">{cell}</{tag}>' for cell in others
        )

    body = "".join(line(row, "td") for row in rows)
    return f"<table>{line(heads, 'th')}{body}</table>"


def picture(drawn: Any) -> str:
    """A figure as a part of the page."""
    text: str = drawn.to_html(full_html=False, include_plotlyjs=False, config=PICTURE)
    return text


def mode_name(mode: Mapping[str, Any], words: Mapping[str, str]) -> str:
    """As the configuration calls it, else its number, as the unit or the file has it."""
    return mode["name"] or words["slot"].format(number=mode["mode"])


def span(
    band: Mapping[str, Any], ending: str, unit: str, ends: tuple[str, str] = ("from", "to")
) -> str:
    """From low up to high; an open end has a sign."""
    low, high = (band[f"{end}_{ending}" if ending else end] for end in ends)
    if low is None:
        return f"< {number(high, 0)} {unit}" if high is not None else "…"
    return f"≥ {number(low, 0)} {unit}" if high is None else f"{low:.0f} … {high:.0f} {unit}"


def number(value: float | None, digits: int) -> str:
    """A dash for what is missing."""
    return "—" if value is None else f"{value:.{digits}f}"


def clock(seconds: float) -> str:
    """Hours, minutes and seconds."""
    total = round(seconds)
    hours, minutes = divmod(total // 60, 60)
    return f"{hours}:{minutes:02}:{total % 60:02}" if hours else f"{minutes}:{total % 60:02}"
