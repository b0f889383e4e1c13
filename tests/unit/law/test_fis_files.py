"""Goal: a table goes out as a .fis file that others read as the unit does, and comes back the same;
what a unit cannot do is refused with its line.

Method: tables drawn at random, judged by zadeh, a reader of .fis files that is not ours; a Sugeno
file by the mean of its constants that the same reader's sets weigh; files spoilt line by line.
"""

from __future__ import annotations

import configparser
import contextlib
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from zadeh.mparser import parse_variable, read_mfis

from backend.core.fuzzy_table import INFERENCES, LABELS, THESIS_TABLE, FuzzyTable
from backend.errors import InvalidRequest
from backend.law import points
from backend.law.fis import deviation, read_fis, table_of, write_fis

# zadeh sums the output at so many places and weighs both ends in full, which costs about half a
# step of 0.5 / 2000.
STEPS = 2001
CENTROID_OFF = 2e-4
# MATLAB's 101 samples are 2e-3 off the thesis's exact centroid; half a set at the end is worst.
MATLAB_OFF = 4e-3
POINTS = 15


def increasing(low: float, high: float, step: float) -> st.SearchStrategy[tuple[float, ...]]:
    """Five points with at least two steps between them, as decimals."""
    count = round((high - low) / step) - 8
    drawn = st.lists(st.integers(0, count), min_size=5, max_size=5)
    return drawn.map(
        lambda places: tuple(
            round(low + (place + 2 * index) * step, 3) for index, place in enumerate(sorted(places))
        )
    )


tables = st.builds(
    FuzzyTable,
    name=st.text(st.characters(categories=["L", "Nd"]), min_size=1, max_size=6),
    inference=st.sampled_from(INFERENCES),
    speed_points_kmh=increasing(0.0, 45.0, 0.5),
    torque_rate_points=increasing(0.0, 2.0, 0.02),
    gain_points=increasing(0.0, 0.5, 0.02),
    rules=st.tuples(*[st.tuples(*[st.sampled_from(LABELS)] * 5)] * 5),
)


@pytest.mark.slow
@given(tables)
@settings(max_examples=200, deadline=None)
def test_a_table_comes_back_as_it_went_out(table: FuzzyTable) -> None:
    assert table_of(read_fis(write_fis(table))) == table


@given(tables)
@settings(max_examples=25, deadline=None)
def test_the_file_and_the_unit_are_as_near_as_their_samples_allow(table: FuzzyTable) -> None:
    found = deviation(read_fis(write_fis(table)), table)

    is_centroid = table.inference == "mamdani_centroid"
    assert found.gain < (5 * MATLAB_OFF if is_centroid else 1e-6)
    assert (found.samples is None) != is_centroid


def test_the_thesis_s_table_is_as_far_from_matlab_s_samples_as_was_found_elsewhere() -> None:
    found = deviation(read_fis(write_fis(THESIS_TABLE)), THESIS_TABLE)

    assert found.gain == pytest.approx(2.0e-3, abs=5e-5)


@pytest.mark.slow
@given(tables)
@settings(max_examples=6, deadline=None, derandomize=True)
def test_another_reader_computes_what_the_unit_does(
    tmp_path_factory: pytest.TempPathFactory, table: FuzzyTable
) -> None:
    file = tmp_path_factory.mktemp("fis") / "table.fis"
    file.write_text(write_fis(table), encoding="utf-8")
    random = np.random.default_rng(1)
    speeds = random.uniform(0.0, 45.0, POINTS)
    rates = random.uniform(0.0, 2.5, POINTS)

    judge = by_sugeno if table.inference == "weighted_average" else by_mamdani
    judged = judge(file, speeds, rates)

    off = CENTROID_OFF if judge is by_mamdani else 1e-6
    assert np.abs(judged - points(table, speeds, rates)).max() < off


def by_mamdani(file: Path, speeds: np.ndarray, rates: np.ndarray) -> np.ndarray:
    system = read_mfis(file, steps=STEPS)
    pairs = zip(speeds, rates, strict=True)
    return np.array([system.get_crisp_output({"speed_kmh": s, "torque_rate": r}) for s, r in pairs])


def by_sugeno(file: Path, speeds: np.ndarray, rates: np.ndarray) -> np.ndarray:
    """zadeh has no Sugeno systems: its sets, and the weighted mean of the file's constants."""
    config = configparser.ConfigParser(inline_comment_prefixes="%")
    config.read(file)
    inputs = [parse_variable(config[name]) for name in ("Input1", "Input2")]
    constants = [
        float(re.search(r"\[(.*)\]", config["Output1"][f"MF{n}"])[1])  # type: ignore[index]
        for n in range(1, 6)
    ]
    found = []
    for pair in zip(speeds, rates, strict=True):
        weights, total = 0.0, 0.0
        for rule in config["Rules"]:
            one, other, result = (int(word) for word in re.findall(r"\d+", rule)[:3])
            grades = [
                list(variable.values.values())[index - 1](value)
                for variable, index, value in zip(inputs, (one, other), pair, strict=True)
            ]
            weights += grades[0] * grades[1]
            total += grades[0] * grades[1] * constants[result - 1]
        found.append(total / weights)
    return np.array(found)


def test_a_file_of_another_tool_is_read_as_it_means() -> None:
    text = write_fis(THESIS_TABLE)
    # Sets in another order, the rate first, rounded feet, comments, the thesis's own universes.
    text = text.replace("trimf',[-0.225 0 0.225]", "trimf',[-0.2 0 0.2249]")
    text = text.replace("[0 45]", "[0 25]").replace("25 45 45", "25 30 31")
    text = text.replace("[0 5]", "[0, 0.9]").replace("0.9 5 5", "0.9 0.9 0.9")
    text = "% made by hand\r\n" + text.replace("\n", "\r\n")
    swapped = text.replace("[Input1]", "[Input9]").replace("[Input2]", "[Input1]")
    swapped = swapped.replace("[Input9]", "[Input2]")
    swapped = re.sub(r"(?m)^(\d) (\d),", r"\2 \1,", swapped)

    for each in (text, swapped):
        system = read_fis(each)
        assert table_of(system) == THESIS_TABLE
        assert deviation(system, THESIS_TABLE).gain < MATLAB_OFF


SPOILT = {
    "another curve": ("'trimf',[5 10 15]", "'gaussmf',[2 10]", "gaussmf"),
    "OR": ("3 4, 4 (1) : 1", "3 4, 4 (1) : 2", "OR"),
    "NOT": ("3 4, 4 (1) : 1", "3 -4, 4 (1) : 1", "NOT"),
    "any": ("3 4, 4 (1) : 1", "3 0, 4 (1) : 1", "set 0"),
    "a weight": ("3 4, 4 (1) : 1", "3 4, 4 (0.5) : 1", "weight"),
    "a rule twice": ("3 4, 4 (1) : 1", "3 3, 4 (1) : 1", "same two sets"),
    "a third input": ("3 4, 4 (1) : 1", "3 4 1, 4 (1) : 1", "two sets"),
    "no rule": ("3 4, 4 (1) : 1", "if speed is slow", "form"),
    "sets apart": ("'trimf',[5 10 15]", "'trimf',[6 10 15]", "sum to one"),
    "no shoulder": ("'trapmf',[0 0 5 10]", "'trimf',[0 5 10]", "shoulder"),
    "a plateau": ("'trimf',[5 10 15]", "'trapmf',[5 9 11 15]", "flat"),
    "falling corners": ("'trimf',[5 10 15]", "'trimf',[5 15 10]", "do not fall"),
    "too few corners": ("'trimf',[5 10 15]", "'trimf',[5 10]", "3 numbers"),
    "NaN": ("'trimf',[5 10 15]", "'trimf',[5 nan 15]", "finite"),
    "words": ("'trimf',[5 10 15]", "'trimf',[5 ten 15]", "no number"),
    "a thousand numbers": ("'trimf',[5 10 15]", f"'trimf',[{'1 ' * 1000}]", "more than"),
    "another operator": ("AndMethod='min'", "AndMethod='prod'", "andmethod"),
    "another result": ("DefuzzMethod='centroid'", "DefuzzMethod='mom'", "defuzzmethod"),
    "another kind": ("Type='mamdani'", "Type='anfis'", "anfis"),
    "another universe": ("Range=[0 0.5]", "Range=[0 1]", "Range"),
    "an empty universe": ("Range=[0 0.5]", "Range=[1 1]", "lower one first"),
    "an end of its own": ("'trimf',[0.4 0.5 0.6]", "'trapmf',[0.4 0.5 0.6 0.7]", "trapmf"),
    "a section twice": ("[Output1]", "[Input1]", "twice"),
    "a foreign section": ("[Output1]", "[Output1x]", "no section"),
    "a key twice": ("NumRules=25", "NumInputs=25", "twice"),
    "no key": ("NumRules=25", "hello", "Name=Value"),
    "a gap in the sets": ("MF2='NS':'trimf',[5 10 15]", "MF7='NS':'trimf',[5 10 15]", "numbered"),
}


@pytest.mark.parametrize("spoilt", SPOILT.values(), ids=SPOILT.keys())
def test_what_the_unit_cannot_do_is_refused_with_its_line(spoilt: tuple[str, str, str]) -> None:
    old, new, says = spoilt
    text = write_fis(THESIS_TABLE)
    assert text.count(old) == 1
    line = text[: text.index(old)].count("\n") + 1

    with pytest.raises(InvalidRequest, match=says) as refused:
        table_of(read_fis(text.replace(old, new)))

    told = int(re.search(r"Line (\d+)", refused.value.message)[1])  # type: ignore[index]
    # Sets that are not numbered through are told of the variable that has them.
    assert told == (14 if says == "numbered" else line)


TOO_NEAR = (
    write_fis(THESIS_TABLE)
    .replace("[0 0 5 10]", "[0 0 9.99 10]")
    .replace("[5 10 15]", "[9.99 10 15]")
)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "no \\[System\\]"),
        ("x" * 70_000, "longer"),
        ("Name='early'\n[System]\n", "before"),
        (write_fis(THESIS_TABLE).split("[Rules]")[0], "25 of the 25 pairs"),
        (TOO_NEAR, "not at least 0.1"),
    ],
)
def test_a_file_that_is_no_table_says_so(text: str, says: str) -> None:
    with pytest.raises(InvalidRequest, match=says):
        table_of(read_fis(text))


@pytest.mark.slow
@given(st.data())
@settings(max_examples=300, deadline=None)
def test_nothing_but_a_refusal_comes_of_a_damaged_file(data: st.DataObject) -> None:
    text = write_fis(THESIS_TABLE)
    at = data.draw(st.integers(0, len(text)))
    cut = data.draw(st.integers(0, 40))
    text = text[:at] + data.draw(st.text("[]'=:,.-0159 MFe%\n", max_size=12)) + text[at + cut :]

    with contextlib.suppress(InvalidRequest):
        system = read_fis(text)
        deviation(system, table_of(system))
