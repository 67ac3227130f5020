"""A magnetometer in arrays."""

import numpy as np
import stillpoint
from stillpoint import Recording

SPEC = """
seed = 11
grade = "consumer"
rate = 50.0
[motion.hand_held]
placements = 20
[magnetic_field]
"""


def test_a_magnetometer_in_arrays_is_calibrated_as_that_of_the_recording():
    simulated, _ = stillpoint.simulate(SPEC)
    (t, accel), (_, gyro), (own, mag) = simulated.accel, simulated.gyro, simulated.mag
    assert np.array_equal(t, own)
    recording = Recording.from_arrays(t, accel, gyro, mag=mag)
    assert "of the magnetometer" in repr(recording)
    found = stillpoint.calibrate(recording, gravity=9.80665)
    named = {parameter.name: parameter for parameter in found.parameters}
    direct = stillpoint.calibrate(simulated, gravity=9.80665)
    for parameter in direct.parameters:
        assert np.isclose(named[parameter.name].value, parameter.value, rtol=1e-9, atol=1e-12)
    assert any(name.startswith("mag") for name in named)
    norms = np.linalg.norm(found.apply(mag=mag), axis=1)
    assert norms.std() < 0.2 * np.linalg.norm(mag, axis=1).std()
