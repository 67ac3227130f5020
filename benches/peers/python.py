"""Stillpoint's module beside imucal (PyPI) and a script with scipy, in one run, on simulations of this file's own.

    pip install target/wheels/stillpoint_imu-*.whl imucal scipy pandas && python benches/peers/python.py

imucal (Ferraris) needs six aligned placements and three full turns about the axes; the other two take any placements by
hand. All sessions are of one device, 100 Hz, about two minutes. Error: root mean square over 10,000 random readings of the
corrected norm less the true one, which no choice of frame changes.
"""

import time

import numpy as np
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

G, RATE = 9.80665, 100.0
T_ACCEL = np.array([[1.004, 0.003, -0.002], [0, 0.995, 0.004], [0, 0, 1.007]])
T_GYRO = np.array([[0.98, 0.005, -0.004], [0.006, 1.015, 0.003], [-0.002, 0.004, 1.01]])
B_ACCEL, B_GYRO = np.array([0.15, -0.2, 0.1]), np.array([0.01, -0.02, 0.005])


class Session:
    """Samples along holds and turns; `marks` are the ranges of samples of each part."""

    def __init__(self, attitude, seed):
        self.attitude, self.rng = attitude, np.random.default_rng(seed)
        self.force, self.rate, self.marks = [], [], []

    def turn(self, axis, angle, seconds):
        """Turns about an axis of the body, smoothly; an angle of 0 holds still."""
        n = int(seconds * RATE)
        s = (np.arange(n) + 0.5) / n
        theta = angle * (s - np.sin(2 * np.pi * s) / (2 * np.pi))
        speed = angle * (1 - np.cos(2 * np.pi * s)) / seconds
        axis = np.asarray(axis, float) / np.linalg.norm(axis)
        attitudes = self.attitude * Rotation.from_rotvec(theta[:, None] * axis)
        begin = sum(map(len, self.force))
        self.force.append(attitudes.inv().apply([0, 0, G]))
        self.rate.append(speed[:, None] * axis)
        self.attitude = self.attitude * Rotation.from_rotvec(angle * axis)
        self.marks.append((begin, begin + n, angle != 0))

    def raw(self):
        force, rate = np.concatenate(self.force), np.concatenate(self.rate)
        noise = self.rng.standard_normal
        accel = force @ np.linalg.inv(T_ACCEL).T + B_ACCEL + 0.02 * noise(force.shape)
        gyro = rate @ np.linalg.inv(T_GYRO).T + B_GYRO + 0.002 * noise(rate.shape)
        return np.arange(len(force)) / RATE, accel, gyro


def by_hand(seed):
    session = Session(Rotation.random(random_state=seed), seed)
    session.turn([1, 0, 0], 0.0, 5.0)
    for _ in range(24):
        session.turn(session.rng.standard_normal(3), session.rng.uniform(1.2, 2.4), 1.5)
        session.turn([1, 0, 0], 0.0, 4.0)
    return session


FACES = {"x": [0, 1, 0], "y": [1, 0, 0], "z": [1, 0, 0]}
UP = {"x": Rotation.from_euler("y", -90, degrees=True), "y": Rotation.from_euler("x", 90, degrees=True), "z": Rotation.identity()}


def ferraris(seed, tilt):
    """The regions of a Ferraris session: every face up and down, a full turn about every axis, tilted by hand (rad)."""
    rng, regions = np.random.default_rng(seed), {}
    for k, axis in enumerate("xyz"):
        for half, name in ((0, "p"), (np.pi, "a")):
            wrong = Rotation.from_rotvec(tilt * rng.standard_normal(3))
            session = Session(wrong * UP[axis] * Rotation.from_rotvec(half * np.array(FACES[axis])), 100 * seed + k)
            session.turn([1, 0, 0], 0.0, 10.0)
            _, accel, gyro = session.raw()
            regions[f"acc_{axis}_{name}"], regions[f"gyr_{axis}_{name}"] = accel, np.degrees(gyro)
        wrong = Rotation.from_rotvec(tilt * rng.standard_normal(3))
        session = Session(wrong * UP[axis], 100 * seed + 10 + k)
        session.turn(wrong.apply(np.eye(3)[k]), -2 * np.pi, 8.0)
        _, accel, gyro = session.raw()
        regions[f"acc_{axis}_rot"], regions[f"gyr_{axis}_rot"] = accel, np.degrees(gyro)
    return regions


def errors(correct_accel, correct_gyro):
    rng = np.random.default_rng(99)
    unit = rng.standard_normal((10_000, 3))
    unit /= np.linalg.norm(unit, axis=1)[:, None]
    accel = correct_accel(G * unit @ np.linalg.inv(T_ACCEL).T + B_ACCEL)
    gyro = correct_gyro(2.0 * unit @ np.linalg.inv(T_GYRO).T + B_GYRO)
    rms = lambda v: np.sqrt(np.mean(v**2))
    return 1e3 * rms(np.linalg.norm(accel, axis=1) - G), 1e3 * rms(np.linalg.norm(gyro, axis=1) / 2.0 - 1.0)


def with_stillpoint(session, method):
    import stillpoint

    t, accel, gyro = session.raw()
    recording = stillpoint.Recording.from_arrays(t, accel, gyro)
    found = stillpoint.calibrate(recording, method=method, gravity=G)
    return (lambda a: found.apply(accel=a)), (lambda w: found.apply(gyro=w))


def with_imucal(regions):
    from imucal import FerrarisCalibration
    from imucal.ferraris_calibration import FerrarisSignalRegions

    info = FerrarisCalibration(grav=G).compute(FerrarisSignalRegions(**regions), RATE, from_acc_unit="m/s^2", from_gyr_unit="deg/s")
    accel = lambda a: (a - info.b_a) @ np.linalg.inv(info.R_a @ info.K_a).T
    gyro = lambda w: np.radians((np.degrees(w) - info.b_g) @ np.linalg.inv(info.R_g @ info.K_g).T)
    return accel, gyro


def with_scipy(session):
    """What one writes in an afternoon: the norm over known holds, then gravity through known turns."""
    _, accel, gyro = session.raw()
    holds = [(a, b) for a, b, turns in session.marks if not turns]
    turns = [(a, b) for a, b, turns in session.marks if turns]
    means = np.array([accel[a:b].mean(axis=0) for a, b in holds])
    bias = np.mean([gyro[a:b].mean(axis=0) for a, b in holds], axis=0)

    def upper(p):
        return np.array([[p[0], p[1], p[2]], [0, p[3], p[4]], [0, 0, p[5]]])

    norm = lambda p: np.linalg.norm((means - p[6:]) @ upper(p).T, axis=1) - G
    a = least_squares(norm, [1, 0, 0, 1, 0, 1, 0, 0, 0], x_scale="jac").x
    up = (means - a[6:]) @ upper(a).T
    up /= np.linalg.norm(up, axis=1)[:, None]

    def through(p):
        left = []
        for k, (begin, end) in enumerate(turns):
            whole = Rotation.identity()
            for step in Rotation.from_rotvec((gyro[begin:end] - bias) @ p.reshape(3, 3).T / RATE):
                whole = whole * step
            left.append(whole.inv().apply(up[k]) - up[k + 1])
        return np.concatenate(left)

    t = least_squares(through, np.eye(3).ravel(), x_scale="jac").x.reshape(3, 3)
    return (lambda v: (v - a[6:]) @ upper(a).T), (lambda w: (w - bias) @ t.T)


def main():
    """Times are of the calibration alone, sessions made before; the first of each is not counted, for it loads the libraries."""
    rows = [
        ("stillpoint, stepwise, by hand", by_hand, lambda made: with_stillpoint(made, "stepwise")),
        ("stillpoint, joint, by hand", by_hand, lambda made: with_stillpoint(made, "joint")),
        ("scipy, holds and turns given", by_hand, with_scipy),
        ("imucal, aligned to 0.0°", lambda k: ferraris(k, 0.0), with_imucal),
        ("imucal, aligned to 2.0° by hand", lambda k: ferraris(k, np.radians(2.0)), with_imucal),
    ]
    print(f"{'':34}{'norm, mm/s²':>12}{'rate, ‰':>10}{'time, s':>10}{'ratio':>8}")
    first = None
    for name, make, run in rows:
        found, spent = [], []
        for seed in range(1, 4):
            made = make(seed)
            begin = time.perf_counter()
            correct = run(made)
            spent.append(time.perf_counter() - begin)
            found.append(errors(*correct))
        accel, gyro = np.mean(found, axis=0)
        seconds = np.mean(spent[1:])
        first = first or seconds
        print(f"{name:34}{accel:>12.2f}{gyro:>10.3f}{seconds:>10.3f}{seconds / first:>8.3g}")


if __name__ == "__main__":
    main()
