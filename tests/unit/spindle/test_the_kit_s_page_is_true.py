"""Goal: what the page for firmware teams shows can be copied and runs.

Every example of docs/testing-your-firmware.md is written into an empty folder and run by a pytest
of its own, as a newcomer would.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs" / "testing-your-firmware.md"
EXAMPLE = re.compile(r"^```python (\S+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)

pytest_plugins = ["pytester"]


@pytest.mark.slow
@pytest.mark.long
def test_every_example_of_the_page_runs(
    pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    examples = EXAMPLE.findall(PAGE.read_text(encoding="utf-8"))
    for name, text in examples:
        (pytester.path / name).write_text(text, encoding="utf-8")
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    tests = sum(text.count("\ndef test_") + text.startswith("def test_") for _, text in examples)

    result = pytester.runpytest_subprocess("-p", "no:cacheprovider", "--strict-markers")

    assert tests >= 5
    result.assert_outcomes(passed=tests)
