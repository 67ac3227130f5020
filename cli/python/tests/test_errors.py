"""What is wrong is an exception with fields, and names no flag of a command line."""

import pickle

import numpy as np
import pytest
import stillpoint
from stillpoint import InputError, NotEnoughInformation, Recording, UsageError


def refused(kind, *args, **more):
    with pytest.raises(kind) as caught:
        Recording.from_arrays(*args, **more)
    error = caught.value
    assert "--" not in error.message and error.file is None
    return error


def test_arrays_that_are_no_recording_are_refused_with_row_and_column(arrays):
    t, accel, gyro = arrays
    assert "7 rows" in refused(InputError, t, accel[:7], gyro).message
    broken = accel.copy()
    broken[16, 1] = np.nan
    error = refused(InputError, t, broken, gyro)
    assert (error.kind, error.line, error.column) == ("input", 17, 3)
    assert error.next and "NaN" in error.message
    back = t.copy()
    back[30] = t[28] - 1e-3
    assert refused(InputError, back, accel, gyro).line == 31
    assert refused(NotEnoughInformation, t[:1], accel[:1], gyro[:1]).kind == "not_enough_information"
    assert refused(InputError, t).kind == "input"
    assert "(N, 3)" in refused(UsageError, t, accel[:, :2]).message
    stuck = gyro.copy()
    stuck[:, 2] = 0.0
    refused(InputError, t, accel, stuck)
    with pytest.raises(ValueError):
        Recording.from_arrays(t, broken, gyro)


def test_other_layouts_and_numbers_are_taken(arrays):
    t, accel, gyro = arrays
    plain = Recording.from_arrays(t, accel, gyro)
    other = Recording.from_arrays(list(t), np.asfortranarray(accel), gyro[::1].tolist())
    assert np.array_equal(plain.accel[1], other.accel[1])
    single = Recording.from_arrays(t, accel.astype(np.float32), gyro)
    assert np.array_equal(single.accel[1], accel.astype(np.float32).astype(np.float64))


def test_files_are_refused_with_their_place(folder):
    with open("broken.csv", "w") as out:
        out.write("t,ax,ay,az,gx,gy,gz\n0,0,0,9.8,0,0,0\n0.01,0,x,9.8,0,0,0\n0.02,0,0,9.8,0,0,0\n")
    with pytest.raises(InputError) as caught:
        Recording.from_file("broken.csv")
    error = caught.value
    assert (error.file, error.line) == ("broken.csv", 3)
    copy = pickle.loads(pickle.dumps(error))
    assert (copy.message, copy.line, copy.kind) == (error.message, 3, "input")


def test_damaged_files_of_tables_are_refused_by_name(folder):
    for name, begin, program in (("a.parquet", b"PAR1", "Parquet"), ("a.h5", b"\x89HDF\r\n\x1a\n", "HDF5")):
        with open(name, "wb") as out:
            out.write(begin + bytes(200))
        with pytest.raises(InputError) as caught:
            Recording.from_file(name)
        assert caught.value.file == name and program in caught.value.message


def test_requests_that_make_no_sense_are_refused(arrays):
    t, accel, gyro = arrays
    recording = Recording.from_arrays(t, accel, gyro)
    for option in (
        {"gravity": 981.0},
        {"latitude": 100.0},
        {"method": "magic"},
        {"effects": ["gyro_magic"]},
        {"window": -1.0},
        {"nominal_rate": 0.0},
        {"sections": [[(3.0, 1.0)]]},
        {"method": "six-position", "effects": ["gyro_drift"]},
    ):
        with pytest.raises(UsageError) as caught:
            stillpoint.calibrate(recording, **option)
        assert "--" not in caught.value.message
    with pytest.raises(TypeError, match="no option 'gravty'"):
        stillpoint.calibrate(recording, gravty=9.8)
    with pytest.raises(UsageError):
        stillpoint.calibrate([])
    with pytest.raises(UsageError, match="seen"):
        stillpoint.discover(recording, validation=recording)


def test_a_recording_that_does_not_move_is_not_enough():
    still, _ = stillpoint.simulate("seed = 1\nrate = 50.0\n[motion.still]\nduration = 90.0\n")
    with pytest.raises(NotEnoughInformation) as caught:
        stillpoint.calibrate(still)
    assert "--" not in caught.value.message
    noise = stillpoint.allan(still)
    assert noise.to_dict()["gyroscope"]["axes"][0]["curve"][0]["tau"] == pytest.approx(0.02)
