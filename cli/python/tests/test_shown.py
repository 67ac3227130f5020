"""Dictionaries, frames, pages, notebooks."""

from pathlib import Path

import numpy as np
import pytest
import stillpoint
from stillpoint import Calibration, Recording

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("*.ipynb"))


@pytest.fixture(scope="module")
def calibration(arrays):
    t, accel, gyro = arrays
    return stillpoint.calibrate(Recording.from_arrays(t, accel, gyro), gravity=9.80665)


def test_a_calibration_is_a_dictionary_a_frame_and_a_page(calibration):
    document = calibration.to_dict()
    assert document["schema"] == "stillpoint.calibration/1"
    assert Calibration.from_dict(document).to_json() == calibration.to_json()
    assert calibration["accel.b_x"].value == document["accelerometer"]["bias"][0]
    with pytest.raises(KeyError):
        calibration["accel.q"]
    page = calibration._repr_html_()
    assert page.count("<svg") >= 3 and "accel.s_x" in page and "<script" not in page
    assert "accel.s_x" in repr(calibration)
    frame = calibration.to_frame()
    assert list(frame.columns) == ["name", "value", "std", "unit"] and len(frame) == 24


def test_findings_and_noise_are_shown(arrays):
    t, accel, gyro = arrays
    findings = stillpoint.discover(Recording.from_arrays(t, accel, gyro), gravity=9.80665)
    assert "<svg" in findings._repr_html_() and "gyro_g_sensitivity" in repr(findings)
    assert findings.to_frame()["name"][0] == "gyro_g_sensitivity"
    named = findings.calibration
    assert named["gyro_g_sensitivity.xx"].std > 0
    still, _ = stillpoint.simulate("seed = 1\nrate = 50.0\n[motion.still]\nduration = 120.0\n")
    noise = stillpoint.allan(still)
    assert len(noise.to_frame()) > 20 and "gyroscope" in noise._repr_html_()


def test_a_calibration_takes_the_misfit_away(arrays, calibration):
    t, accel, gyro = arrays
    recording = Recording.from_arrays(t, accel, gyro)
    raw, corrected = stillpoint.evaluate(recording), stillpoint.evaluate(recording, calibration)
    assert corrected["modulus_rms"] < 0.1 * raw["modulus_rms"]
    assert np.isfinite(corrected["direction_rms"])


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path, tmp_path):
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    notebook = nbformat.read(path, as_version=4)
    nbclient.NotebookClient(
        notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(tmp_path)}}
    ).execute()


def test_there_are_two_notebooks():
    assert len(NOTEBOOKS) == 2
