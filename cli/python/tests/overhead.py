"""What a calibration of arrays costs through the module beside the library: both in turns, the least of all runs, ms.

    cargo build --release -p stillpoint-imu --example timing
    python cli/python/tests/overhead.py target/release/examples/timing [ROUNDS]

The wheel must be of the same profile. From arrays to the text of the calibration on both sides.
"""

import subprocess
import sys
import time

import stillpoint

SPEC = "seed = 7\nrate = 200.0\n[motion.hand_held]\nplacements = 30\n"


def least(t, accel, gyro):
    found = float("inf")
    for _ in range(20):
        begin = time.perf_counter()
        recording = stillpoint.Recording.from_arrays(t, accel, gyro)
        stillpoint.calibrate(recording).to_json()
        found = min(found, 1e3 * (time.perf_counter() - begin))
    return found


def main():
    simulated, _ = stillpoint.simulate(SPEC)
    (t, accel), (_, gyro) = simulated.accel, simulated.gyro
    module = library = float("inf")
    for _ in range(int(sys.argv[2]) if len(sys.argv) > 2 else 5):
        module = min(module, least(t, accel, gyro))
        library = min(library, float(subprocess.run([sys.argv[1]], capture_output=True, check=True, text=True).stdout))
    print(f"module {module:.2f} ms, library {library:.2f} ms, overhead {100 * (module / library - 1):+.1f} %")


if __name__ == "__main__":
    main()
