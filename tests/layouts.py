#!/usr/bin/env python3
"""`calibrate` on every layout that `make_formats.py` writes and on the files of programs, beside the CSV of the same recording.

    python3 -m venv v && v/bin/pip install numpy pandas rosbags
    v/bin/python tests/layouts.py target/release/stillpoint ../shared

A row per layout: exit status and, for both sensors, the largest difference of an element of T or of the bias from what the CSV gives,
in standard errors (the larger of both, since digits that are left out make it larger). The CSV holds what the layout can: the gyroscope at the accelerometer's stamps, turned axes, counts, an even rate
(of rec_2: where samples are missing, as in rec_1, their number says nothing of the time). What holds no raw or no still recording has to
be refused with what to do. Exit status 1 where a row is not as asked.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

parser = argparse.ArgumentParser()
parser.add_argument("program")
parser.add_argument("shared", type=Path)
args = parser.parse_args()
DATA = args.shared / "data"

# Largest differences, standard errors: of layouts that keep eight digits and more, of three to six decimals, of two (rates of some 1 rad/s
# in steps of .01: wider than the noise, which the calibration says and has in its standard errors).
EXACT, ROUNDED, COARSE = 1e-3, 0.05, 3.0
# Counts of the serial logs per m/s² and per rad/s.
COUNTS = np.array([16384 / 9.80665, 65.5 * 180 / np.pi])

# Shape of the CSV: layouts, all below one folder, and the largest difference.
CASES = [
    ("two clocks", "phone", "phyphox_rec_1 phyphox_rec_1.zip phyphox_de sensorlogger_android sensorlogger_android.zip sensorlogger.json "
     "sensorlogger_android_uncal sensorlogger_android_uncal.zip sensorlogger_ios sensorlogger_ios.zip sensorlogger_ios_std "
     "sensorlogger_ios_std.zip", EXACT),
    ("two clocks", "phone", "matlab_acc.csv+matlab_gyro.csv", ROUNDED),
    ("accelerometer", "phone", "phyphox_single", EXACT),
    ("accelerometer", "phone", "ptb_gforce.csv", ROUNDED),
    ("one clock", "ros", "imu.bag bag_mcap bag_db3", EXACT),
    ("one clock", "phone", "ptb_multi.csv ptb_multi_clock.csv androsensor.csv sensorlog_ios.csv", ROUNDED),
    ("turned", "ros", "rostopic.csv ros2topic.csv", EXACT),
    ("turned", ".", "apm/imu_csv.csv px4/log_0_sensor_combined_0.csv", EXACT),
    ("turned, two clocks", ".", "px4/log_0_sensor_accel_0.csv+px4/log_0_sensor_gyro_0.csv", EXACT),
    ("counts", "firmware", "plain.csv nohdr7.csv arduino_ts.txt micros_wrap.csv", EXACT),
    ("counts, torn", "firmware", "torn.csv", EXACT),
    ("counts, even rate", "firmware", "jeff.txt plotter.txt nohdr6.csv", EXACT),
    ("even rate", "firmware", "adafruit.txt", COARSE),
]


def calibrate(folder, recording, *options):
    """Exit status, calibration, and what was said."""
    out = folder / "cal.json"
    out.unlink(missing_ok=True)
    files = ["--accel-file", recording[0], "--gyro-file", recording[1]] if len(recording) == 2 else recording
    run = subprocess.run([args.program, "calibrate", *files, *options, "-o", out], capture_output=True, text=True)
    return run.returncode, json.loads(out.read_text()) if run.returncode == 0 else None, run.stderr


def differences(found, expected, counts):
    """The largest difference of each sensor that the CSV has, standard errors; infinite where it is missing."""
    largest = []
    for sensor, count in zip(("accelerometer", "gyroscope"), counts):
        a, b = found.get(sensor), expected.get(sensor)
        if (a is None) != (b is None):
            largest.append(np.inf)
        elif b is not None:
            of = lambda cal, name: np.array(cal[name], dtype=float)
            off = lambda name, k: abs(of(a, name) * k - of(b, name)) / np.fmax(of(a, f"{name}_std") * k, of(b, f"{name}_std"))
            largest.append(max(np.nanmax(off("T", count)), np.nanmax(off("bias", 1 / count))))
    return largest


def samples(rec):
    """Stamps, specific force, both of the gyroscope's own, and its rate at the accelerometer's stamps."""
    read = lambda name: np.loadtxt(DATA / "phone/multi_position" / rec / name, delimiter=",", skiprows=1)
    accel, gyro = read("acc.csv"), read("gyro.csv")
    rate = np.stack([np.interp(accel[:, 0], gyro[:, 0], gyro[:, k]) for k in (1, 2, 3)], 1)
    return accel[:, 0], accel[:, 1:], gyro, rate


def references(folder):
    """The recordings as CSV in the shapes that layouts have; the rate of the layouts without stamps, Hz."""
    def written(name, columns, header="t,ax,ay,az,gx,gy,gz"):
        path = folder / f"{name}.csv"
        np.savetxt(path, np.column_stack(columns), "%.12g", ",", header=header, comments="")
        return path

    turned = lambda v: v[:, [1, 0, 2]] * [1, 1, -1]
    counted = lambda v, k: np.clip(np.round(v * COUNTS[k]), -32768, 32767) / COUNTS[k]
    t, force, gyro, rate = samples("rec_1")
    counts = [t, counted(force, 0), counted(rate, 1)]
    even_t, even_force, _, even_rate = samples("rec_2")
    step = np.median(np.diff(even_t))
    even_t = step * np.arange(len(even_t))
    pair = ("turned force", [t, turned(force)], "t,ax,ay,az"), ("turned rate", [gyro[:, 0], turned(gyro[:, 1:])], "t,gx,gy,gz")
    return {
        "two clocks": [DATA / "phone/multi_position/rec_1"],
        "accelerometer": [written("accelerometer", [t, force], "t,ax,ay,az")],
        "one clock": [written("one", [t, force, rate])],
        "turned": [written("turned", [t, turned(force), turned(rate)])],
        "turned, two clocks": [written(*sensor) for sensor in pair],
        "counts": [written("counts", counts)],
        "counts, torn": [written("torn", [column[500:-19] for column in counts])],
        "counts, even rate": [written("counts even", [even_t, counted(even_force, 0), counted(even_rate, 1)])],
        "even rate": [written("even", [even_t, even_force, even_rate])],
    }, 1 / step


def refusals(made, folder):
    """What is refused: recording, options, words of the message."""
    processed = folder / "without_gravity"
    processed.mkdir()
    for name in ("Accelerometer.csv", "Gyroscope.csv", "Metadata.csv"):
        shutil.copy(made / "phone/sensorlogger_android" / name, processed)
    formats = DATA / "formats"
    return [
        (made / "phone/phyphox_linear", [], "Acceleration with g"),
        (processed, [], "gravity"),
        (formats / "px4_sample_log_small.ulg", [], "--instance 0"),
        (formats / "px4_sample_log_small.ulg", ["--instance", "0"], "SDLOG_PROFILE"),
        (formats / "px4_sample.ulg", [], "all static"),
        (formats / "ardupilot_test.BIN", [], "--instance 0"),
        (formats / "ardupilot_test.BIN", ["--instance", "0"], "record longer"),
        (formats / "matlab_mobile_walking.mat", [], "placements"),
    ]


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        made = {rec: folder / rec for rec in ("rec_1", "rec_2")}
        for rec, target in made.items():
            subprocess.run([sys.executable, args.shared / "tools/make_formats.py", target, rec], check=True, stdout=subprocess.DEVNULL)
        shapes, rate = references(folder)
        cases = [(name, made["rec_2" if "even" in shape else "rec_1"] / below, shape, shapes[shape], most)
                 for shape, below, names, most in CASES for name in names.split()]
        # The CSV of it keeps six decimals.
        cases.append(("matlab_mobile_rec_2.mat", DATA / "formats", "rec_2", [DATA / "phone/multi_position/rec_2"], ROUNDED))
        expected = {}
        print("| layout | beside the CSV | exit | accelerometer | gyroscope | at most |\n|---|---|---|---|---|---|")
        for name, below, shape, csv, most in cases:
            if shape not in expected:
                expected[shape] = calibrate(folder, csv)[1]
            options = ["--rate", repr(float(rate))] if "even" in shape else []
            status, found, said = calibrate(folder, [below / part for part in name.split("+")], *options)
            off = differences(found, expected[shape], COUNTS if "counts" in shape else (1, 1)) if found else [np.inf]
            failures += max(off) > most
            print(f"| {name} | {shape} | {status} | {' | '.join(f'{x:.1e}' for x in (off + [np.nan])[:2])} | {most} |", flush=True)
            if status:
                print(said[-600:])
        print("\n| refused | exit | with |\n|---|---|---|")
        for path, options, words in refusals(made["rec_1"], folder):
            status, _, said = calibrate(folder, [path], *options)
            failures += status == 0 or words not in said
            print(f"| {' '.join([path.name, *options])} | {status} | {words if words in said else 'NOT: ' + said[-400:]} |", flush=True)
    sys.exit(int(failures > 0))


main()
