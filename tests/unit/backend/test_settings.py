"""Goal: one order of precedence, every wrong setting named at once, no open door by accident."""

from __future__ import annotations

from pathlib import Path

import pytest

from backend.errors import InvalidRequest
from backend.settings import combine, load, read_file


def test_flags_win_over_the_environment_over_the_file_over_the_default(tmp_path: Path) -> None:
    environment = {"SPINDLE_PORT": "2", "SPINDLE_HOST": "::1", "SPINDLE_DATA": str(tmp_path)}
    file = {"port": 3, "host": "localhost", "device": ["sim", "/dev/ttyUSB0"]}

    settings = combine({"port": "1"}, environment, file)

    assert settings.port == 1
    assert settings.host == "::1"
    assert settings.device == ("sim", "/dev/ttyUSB0")
    assert settings.data == tmp_path


def test_the_contracts_defaults(tmp_path: Path) -> None:
    settings = combine({"data": tmp_path}, {}, {})

    assert (settings.host, settings.port, settings.device) == ("127.0.0.1", 8750, ("sim",))
    assert settings.db == f"sqlite:///{tmp_path.as_posix()}/spindle.db"
    assert settings.objects == (tmp_path / "objects").as_uri()
    assert (settings.bus, settings.jobs, settings.auth) == ("memory", "inline", "auto")


def test_devices_in_the_environment_are_separated_by_commas() -> None:
    assert combine({}, {"SPINDLE_DEVICE": "sim, sim:two"}, {}).device == ("sim", "sim:two")


def test_an_empty_list_of_devices_opens_none() -> None:
    assert combine({"device": []}, {}, {}).device == ()


def test_limits_of_calibrations_are_tables_of_the_file() -> None:
    tables = [{"source": "maker", "model": "City 7", "total_pct": 0.8}]

    assert combine({}, {}, {"calibration_limits": tables}).calibration_limits == tuple(tables)
    assert combine({}, {}, {}).calibration_limits == ()
    with pytest.raises(InvalidRequest, match=r"\[\[calibration_limits\]\]"):
        combine({}, {"SPINDLE_CALIBRATION_LIMITS": "0.8"}, {})


def test_the_root_path_is_one_that_spindle_does_not_have_itself() -> None:
    assert combine({}, {}, {}).root_path == ""
    assert combine({}, {"SPINDLE_ROOT_PATH": "/"}, {}).root_path == ""
    assert combine({}, {"SPINDLE_ROOT_PATH": "/bikes/spindle/"}, {}).root_path == "/bikes/spindle"
    for wrong in ("spindle", "/a b", "/../x", "//evil.example", "/<b>", "/rides", "/api/x"):
        with pytest.raises(InvalidRequest, match="root_path"):
            combine({}, {"SPINDLE_ROOT_PATH": wrong}, {})


def test_proxies_are_addresses_and_networks() -> None:
    assert combine({}, {}, {}).proxies == ()
    named = combine({}, {"SPINDLE_PROXIES": "127.0.0.1, 10.0.3.0/24, fd00::/8"}, {}).proxies
    assert named == ("127.0.0.1", "10.0.3.0/24", "fd00::/8")
    for wrong in ("*", "proxy.example", "10.0.3.7/24"):
        with pytest.raises(InvalidRequest, match="no network"):
            combine({}, {"SPINDLE_PROXIES": wrong}, {})


def test_tls_is_off_own_or_of_two_files(tmp_path: Path) -> None:
    files = {"tls_certificate": str(tmp_path / "c.pem"), "tls_key": str(tmp_path / "k.pem")}

    assert combine({}, {}, {}).tls == "off"
    assert combine({"tls": "own"}, {"SPINDLE_TLS": "off"}, {}).tls == "own"
    given = combine({}, {}, {"tls": "files", **files})
    assert (given.tls_certificate, given.tls_key) == (tmp_path / "c.pem", tmp_path / "k.pem")
    for settings, at_fault in (
        ({"tls": "yes"}, {"tls"}),
        ({"tls": "files"}, {"tls_certificate", "tls_key"}),
        ({"tls": "files", "tls_key": "k.pem"}, {"tls_certificate"}),
        (files, {"tls_certificate", "tls_key"}),
        ({"tls": "own", "tls_key": "k.pem"}, {"tls_key"}),
    ):
        with pytest.raises(InvalidRequest) as refusal:
            combine({}, {}, settings)
        assert {field.field for field in refusal.value.fields} == at_fault


def test_every_wrong_setting_is_named() -> None:
    with pytest.raises(InvalidRequest) as refusal:
        combine({"port": "99999"}, {"SPINDLE_BUS": "pigeon"}, {"colour": "red"})

    assert {field.field for field in refusal.value.fields} == {"port", "bus", "colour"}


@pytest.mark.parametrize(
    ("host", "auth", "needed"),
    [
        ("127.0.0.1", "auto", False),
        ("localhost", "auto", False),
        ("::1", "auto", False),
        ("0.0.0.0", "auto", True),
        ("192.168.1.7", "auto", True),
        ("workshop", "auto", True),
        ("127.0.0.1", "required", True),
        ("0.0.0.0", "off", False),
    ],
)
def test_whoever_comes_over_the_network_signs_in_unless_somebody_says_otherwise(
    host: str, auth: str, needed: bool
) -> None:
    assert combine({"host": host}, {"SPINDLE_AUTH": auth}, {}).needs_sign_in is needed


def test_the_file_of_the_data_folder_is_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    folder = tmp_path / "kept"
    folder.mkdir()
    (folder / "spindle.toml").write_text("\ufeffport = 9000\n", encoding="utf-8")

    assert load({"data": folder}, {}).port == 9000


def test_a_file_that_is_no_toml_says_which_and_where(tmp_path: Path) -> None:
    wrong = tmp_path / "spindle.toml"
    wrong.write_text("port 9000")

    with pytest.raises(InvalidRequest, match=r"spindle\.toml.*line 1"):
        read_file(wrong)


def test_one_unit_named_twice_is_refused_with_the_way_to_two() -> None:
    with pytest.raises(InvalidRequest, match=r"sim:one and sim:two"):
        combine({"device": ["sim", "sim"]}, {}, {})


def test_the_author_is_who_was_named_and_else_who_runs_this(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("LOGNAME", "wang")

    assert combine({}, {}, {}).author == "wang"
    assert combine({}, {"SPINDLE_AUTHOR": "王工"}, {"author": "of the file"}).author == "王工"
    assert combine({"author": " a\n b\u202e "}, {}, {}).author == "a b"
    assert len(combine({"author": "x" * 999}, {}, {}).author) == 128
