"""The module and the command give the same results to the last bit."""

import re
from pathlib import Path

import numpy as np
import pytest
import stillpoint
from stillpoint import Calibration, Recording

README = Path(__file__).parents[1] / "README.md"


def but_for_its_source(document):
    """A document without what tells arrays from a file: the name of the format, and the hash over the inputs that it is part of."""
    return re.sub(r'"(format": "(arrays|csv)|basis_sha256": "[0-9a-f]{64})"', "", document)


def test_the_ten_lines_of_the_readme_run(folder):
    code = re.search(r"```python\n(.*?)```", README.read_text(), re.S).group(1)
    assert len(code.strip().splitlines()) <= 12
    names = {}
    exec(compile(code, "README.md", "exec"), names)
    assert names["corrected"].shape == names["gyro"].shape


@pytest.mark.parametrize("method", ["stepwise", "joint"])
def test_a_calibration_of_arrays_equals_the_command_s_to_the_byte(arrays, command, method):
    command("calibrate", "phone.csv", "--method", method, "--gravity", "9.80665", "-o", "cal.json")
    t, accel, gyro = arrays
    recording = Recording.from_arrays(t, accel, gyro, name="phone.csv")
    calibration = stillpoint.calibrate(recording, method=method, gravity=9.80665)
    written = Path("cal.json").read_text()
    assert but_for_its_source(calibration.to_json()) == but_for_its_source(written)
    read = stillpoint.calibrate(Recording.from_file("phone.csv"), method=method, gravity=9.80665)
    assert read.to_json() == written


def test_without_gravity_given_both_assume_the_same(arrays, command):
    command("calibrate", "phone.csv", "-o", "cal.json")
    t, accel, gyro = arrays
    recording = Recording.from_arrays(t, accel, gyro, name="phone.csv")
    made = stillpoint.calibrate(recording).to_json()
    assert but_for_its_source(made) == but_for_its_source(Path("cal.json").read_text())


def test_findings_equal_the_command_s_to_the_byte(arrays, command):
    command("discover", "phone.csv", "--gravity", "9.80665", "-o", "findings.json")
    t, accel, gyro = arrays
    recording = Recording.from_arrays(t, accel, gyro, name="phone.csv")
    findings = stillpoint.discover(recording, gravity=9.80665)
    assert but_for_its_source(findings.to_json()) == but_for_its_source(Path("findings.json").read_text())
    assert findings.effects[0]["name"] == "gyro_g_sensitivity"


def test_corrected_readings_equal_the_command_s(arrays, command):
    t, accel, gyro = arrays
    recording = Recording.from_arrays(t, accel, gyro, name="phone.csv")
    calibration = stillpoint.calibrate(recording)
    calibration.save("cal.json")
    command("apply", "cal.json", "phone.csv", "-o", "corrected.csv")
    corrected = np.loadtxt("corrected.csv", delimiter=",", skiprows=1)
    assert np.array_equal(calibration.apply(accel=accel), corrected[:, 1:4])
    assert np.array_equal(calibration.apply(gyro=gyro), corrected[:, 4:7])
    applied = stillpoint.apply(Calibration.load("cal.json"), recording)
    assert np.array_equal(applied.gyro[1], corrected[:, 4:7])
    t0, force, b = calibration.to_dict()["accelerometer"], accel[0], calibration
    by_hand = np.array(t0["T"]) @ (force - np.array(t0["bias"]))
    assert np.allclose(by_hand, b.apply(accel=accel)[0], rtol=1e-14)


def test_effects_of_a_file_are_fitted_applied_and_read_again(arrays, folder):
    Path("mine.toml").write_text(
        '[[definitions]]\nname = "gyro_tug"\nsensor = "gyroscope"\nx = "k * fx"\n'
        'parameters = [{ name = "k", unit = "(rad/s)/(m/s^2)", typical = 1e-4 }]\n'
    )
    t, accel, gyro = arrays
    recording = Recording.from_arrays(t, accel, gyro)
    calibration = stillpoint.calibrate(
        recording, method="joint", effects=["gyro_tug"], effect_files=["mine.toml"]
    )
    assert calibration["gyro_tug.k"].std > 0
    again = Calibration.from_dict(calibration.to_dict())
    one, other = (stillpoint.apply(c, recording).gyro[1] for c in (calibration, again))
    assert np.array_equal(one, other)
    with pytest.raises(stillpoint.UsageError, match="recording"):
        calibration.apply()
    with pytest.raises(stillpoint.UsageError, match="sources of error"):
        calibration.apply(gyro=gyro)


def test_the_command_of_the_wheel_is_the_command(command):
    assert command("--version").stdout.split()[0] == "stillpoint"
    assert "no_such.csv" in command("calibrate", "no_such.csv", status=3).stderr
    command("calibrate", status=2)


def test_the_verdict_is_that_of_the_document(arrays):
    t, accel, gyro = arrays
    calibration = stillpoint.calibrate(Recording.from_arrays(t, accel, gyro, name="phone.csv"))
    verdict = calibration.verdict
    assert verdict["level"] in ("good", "care", "bad")
    assert verdict == calibration.to_dict()["verdict"]
    kinds = [found["kind"] for found in calibration.findings]
    assert all(reason in kinds for reason in verdict["reasons"])
