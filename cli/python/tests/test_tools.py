"""Samples one by one, matrices as arrays, and the commands that work on files."""

import json

import numpy as np
import pytest

import stillpoint

SPEC = """
seed = 31
rate = 50.0
grade = "consumer"
[motion.hand_held]
placements = 14
"""


@pytest.fixture(scope="module")
def session():
    recording, _ = stillpoint.simulate(SPEC)
    return recording, stillpoint.calibrate(recording)


def test_samples_one_by_one_are_those_of_the_whole_recording(session):
    recording, calibration = session
    whole = calibration.apply(recording)
    (t, accel), (_, gyro) = recording.accel, recording.gyro
    corrector = calibration.corrector()
    for k in (0, 1, 700):
        force, rate = corrector.correct(t[k], accel[k], gyro[k])
        assert np.allclose(force, whole.accel[1][k], atol=1e-12)
        assert np.allclose(rate, whole.gyro[1][k], atol=1e-12)


def test_matrix_and_bias_are_arrays(session):
    _, calibration = session
    assert calibration.matrix("accelerometer").shape == (3, 3)
    assert calibration.bias("gyroscope").shape == (3,)
    scale = calibration["accel.s_x"].value
    assert calibration.matrix("accelerometer")[0, 0] == pytest.approx(scale)
    with pytest.raises(KeyError, match="magnetometer"):
        calibration.matrix("magnetometer")


def test_a_plan_is_a_dictionary_and_a_wrong_option_an_error():
    planned = stillpoint.plan(placements=9)
    assert json.dumps(planned)
    with pytest.raises(stillpoint.StillpointError):
        stillpoint.plan(placements="many")


def test_files_are_written_by_export_report_and_batch(session, tmp_path):
    recording, calibration = session
    lost = stillpoint.export(calibration, "kalibr", tmp_path / "imu.yaml")
    assert (tmp_path / "imu.yaml").exists() and isinstance(lost, (dict, list))
    devices = tmp_path / "devices"
    devices.mkdir()
    (devices / "a.csv").write_text(recording.to_csv())
    document = stillpoint.report(devices / "a.csv", tmp_path / "report.html", gravity=9.81)
    assert document["verdict"]["level"] in ("good", "care", "bad")
    assert (tmp_path / "report.html").read_text().lower().startswith("<!doctype html>")
    stillpoint.batch(devices, tmp_path / "out")
    assert (tmp_path / "out" / "devices" / "a" / "cal.json").exists()
