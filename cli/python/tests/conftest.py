"""Sessions with known truth that the tests share."""

import subprocess
import sysconfig
from pathlib import Path

import numpy as np
import pytest
import stillpoint

SPEC = """
seed = 7
grade = "consumer"
rate = 50.0
[motion.hand_held]
placements = 16
[effects.gyro_g_sensitivity]
size = 1.0
"""

COMMAND = Path(sysconfig.get_path("scripts")) / "stillpoint"


@pytest.fixture(scope="session")
def arrays():
    """Stamps, specific force and rate of a simulated session."""
    recording, _ = stillpoint.simulate(SPEC)
    (t, accel), (other, gyro) = recording.accel, recording.gyro
    assert np.array_equal(t, other)
    return t, accel, gyro


@pytest.fixture
def folder(arrays, tmp_path, monkeypatch):
    """A folder to work in with the session as phone.csv."""
    monkeypatch.chdir(tmp_path)
    t, accel, gyro = arrays
    rows = np.column_stack([t, accel, gyro])
    lines = (",".join(repr(float(v)) for v in row) for row in rows)
    Path("phone.csv").write_text("t,ax,ay,az,gx,gy,gz\n" + "\n".join(lines) + "\n")
    return tmp_path


@pytest.fixture
def command(folder):
    """Runs the command that the wheel brought."""

    def run(*args, status=0):
        done = subprocess.run([COMMAND, *args], capture_output=True, text=True)
        assert done.returncode == status, done.stderr
        return done

    return run
