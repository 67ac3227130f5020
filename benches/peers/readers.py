#!/usr/bin/env python3
"""Times our readers of binary files beside those of Python, in one run, single thread.

    python3 -m venv v && v/bin/pip install numpy scipy rosbags pyulog mat-io
    cargo build --release -p stillpoint-formats --example read
    v/bin/python benches/peers/readers.py target/release/examples/read ../shared/data [--times 5]

Every reader gives arrays of stamps and three values of every sensor. Times are of the processor, so that a busy machine
does not matter. Ours is a process of its own that reports by how much its peak memory grew while it read; the bags hold
the phone's recording.
"""
import argparse, pathlib, re, resource, subprocess, tempfile, time, warnings
import numpy as np

ap = argparse.ArgumentParser()
ap.add_argument("read"); ap.add_argument("data"); ap.add_argument("--times", type=int, default=5)
args = ap.parse_args()
data = pathlib.Path(args.data)
warnings.simplefilter("ignore")


def best(run):
    """The best time of several runs, ms."""
    times = []
    for _ in range(args.times):
        began = time.process_time(); run(); times.append(time.process_time() - began)
    return 1e3 * min(times)


def ours(path):
    """Time of a reading, ms; columns and memory, MB."""
    def run(times):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        out = subprocess.run([args.read, str(path), str(times)], capture_output=True, text=True, check=True).stdout
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, out
    one, out = run(1)
    time_ms = 1e3 * (run(21)[0] - one) / 20
    columns = float(re.search(r"([\d.]+) MB of columns", out).group(1))
    peak = float(re.search(r"([\d.]+) MB of memory", out).group(1))
    return time_ms, columns, peak


def bags(folder):
    """The recording as a bag of ROS 1 and ROS 2."""
    from rosbags.rosbag1 import Writer as W1
    from rosbags.rosbag2 import StoragePlugin, Writer as W2
    from rosbags.typesys import Stores, get_typestore
    rec = data / "phone/multi_position/rec_1"
    a = np.loadtxt(rec / "acc.csv", delimiter=",", skiprows=1)
    g = np.loadtxt(rec / "gyro.csv", delimiter=",", skiprows=1)
    w = np.stack([np.interp(a[:, 0], g[:, 0], g[:, k]) for k in (1, 2, 3)], 1)

    def messages(ts, **extra):
        T = {n: ts.types[f"{p}/msg/{n}"] for p, n in (("sensor_msgs", "Imu"), ("std_msgs", "Header"),
             ("builtin_interfaces", "Time"), ("geometry_msgs", "Quaternion"), ("geometry_msgs", "Vector3"))}
        zero = np.zeros(9)
        for row, rate in zip(a, w):
            ns = 1_700_000_000_000_000_000 + int(round(row[0] * 1e9))
            stamp = T["Time"](sec=ns // 10**9, nanosec=ns % 10**9)
            yield ns, T["Imu"](header=T["Header"](stamp=stamp, frame_id="imu", **extra),
                orientation=T["Quaternion"](x=0., y=0., z=0., w=1.), orientation_covariance=zero,
                angular_velocity=T["Vector3"](*map(float, rate)), angular_velocity_covariance=zero,
                linear_acceleration=T["Vector3"](*map(float, row[1:])), linear_acceleration_covariance=zero)

    ts = get_typestore(Stores.ROS1_NOETIC)
    with W1(folder / "imu.bag") as bag:
        c = bag.add_connection("/imu", "sensor_msgs/msg/Imu", typestore=ts)
        for ns, m in messages(ts, seq=0):
            bag.write(c, ns, ts.serialize_ros1(m, "sensor_msgs/msg/Imu"))
    ts = get_typestore(Stores.ROS2_HUMBLE)
    for name, plugin in (("db3", StoragePlugin.SQLITE3), ("mcap", StoragePlugin.MCAP)):
        with W2(folder / name, version=9, storage_plugin=plugin) as bag:
            c = bag.add_connection("/imu", "sensor_msgs/msg/Imu", typestore=ts)
            for ns, m in messages(ts):
                bag.write(c, ns, ts.serialize_cdr(m, "sensor_msgs/msg/Imu"))
    return {k: next(iter((folder / k).glob(f"*.{k}"))) for k in ("db3", "mcap")} | {"bag": folder / "imu.bag"}


def rosbags(path, ros1):
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore
    store = get_typestore(Stores.ROS1_NOETIC if ros1 else Stores.ROS2_HUMBLE)
    rows = []
    with AnyReader([path if ros1 else path.parent], default_typestore=store) as reader:
        for connection, _, raw in reader.messages():
            m = reader.deserialize(raw, connection.msgtype)
            s, f, r = m.header.stamp, m.linear_acceleration, m.angular_velocity
            rows.append((s.sec + 1e-9 * s.nanosec, f.x, f.y, f.z, r.x, r.y, r.z))
    return np.array(rows)


def mat_io(path):
    from matio import load_from_mat
    tables = load_from_mat(str(path))
    return [np.asarray(tables[k]) for k in ("Acceleration", "AngularVelocity")]


def pyulog(path):
    from pyulog import ULog
    return [d.data for d in ULog(str(path), ["sensor_accel", "sensor_gyro", "sensor_combined"]).data_list]


with tempfile.TemporaryDirectory() as folder:
    files = bags(pathlib.Path(folder))
    formats = data / "formats"
    cases = [("bag", files["bag"], "rosbags", lambda p: rosbags(p, True)),
             ("mcap", files["mcap"], "rosbags", lambda p: rosbags(p, False)),
             ("db3", files["db3"], "rosbags", lambda p: rosbags(p, False)),
             ("ulog", formats / "px4_sample.ulg", "pyulog", pyulog),
             ("mat", formats / "matlab_mobile_rec_2.mat", "mat-io", mat_io)]
    print("| format | ours, ms | peer | its, ms | times faster | columns, MB | memory, MB | memory / columns |\n|---|---|---|---|---|---|---|---|")
    for name, path, peer, run in cases:
        time_ms, columns, peak = ours(path)
        theirs = best(lambda: run(path))
        print(f"| {name} | {time_ms:.2f} | {peer} | {theirs:.1f} | {theirs / time_ms:.1f} | {columns:.1f} | {peak:.1f} | "
              f"{peak / max(columns, 1e-9):.1f} |", flush=True)
