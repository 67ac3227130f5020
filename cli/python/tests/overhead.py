"""The least time of a calibration of arrays from Python, ms, as `cargo run -p stillpoint-imu --example timing` has it."""

import time

import stillpoint

simulated, _ = stillpoint.simulate("seed = 7\nrate = 200.0\n[motion.hand_held]\nplacements = 30\n")
(t, accel), (_, gyro) = simulated.accel, simulated.gyro
least = float("inf")
for _ in range(20):
    begin = time.perf_counter()
    recording = stillpoint.Recording.from_arrays(t, accel, gyro)
    stillpoint.calibrate(recording).to_json()
    least = min(least, 1e3 * (time.perf_counter() - begin))
print(f"{least:.2f}")
