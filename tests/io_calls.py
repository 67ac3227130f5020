"""Commands of the program that read or write, with small inputs, for `io_failures.py`."""

import gzip
import json
import subprocess
import zipfile
from dataclasses import dataclass
from pathlib import Path

SESSION = """seed = 11
rate = 50.0
[motion.hand_held]
placements = 12
initial_rest = 22.0
"""
DEVICE = """seed = {seed}
rate = 50.0
[motion.hand_held]
placements = 12
initial_rest = 5.0
"""
LEAST = "seed = 1\n[motion.still]\nduration = 2.0\n"
EFFECT = """[[definitions]]
name = "gyro_cross"
sensor = "gyroscope"
x = "k * wy * wz"
parameters = [{ name = "k", unit = "1/(rad/s)", typical = 1e-2 }]
"""
# Logs in binary formats, from the corpus of the fuzz targets.
LOGS = ["ulog", "ardupilot", "bag", "mcap", "db3", "mat", "sensor_logger_json"]
CORPUS = Path(__file__).parent / "corpus"
PRIOR = """{"schema": "stillpoint.prior/1", "created_by": "stillpoint", "devices": 3, "outsiders": [], "without": 0,
    "effects": [], "parameters": [], "mean": [], "covariance": [], "mean_covariance": []}"""
OLD = b"what was there before\n"


@dataclass
class Call:
    """A command: what it reads is copied into an empty folder, where it runs; `old` are outputs that are there already."""

    words: str
    reads: str = ""
    old: str = ""
    stdin: str = ""
    quick: bool = False

    @property
    def name(self):
        return self.words + (f" < {self.stdin}" if self.stdin else "")


CALLS = [
    # Looking at files.
    Call("info good.csv", "good.csv", quick=True),
    Call("info --json good.csv cal.json", "good.csv cal.json"),
    Call("good.csv", "good.csv"),
    Call("info session", "session"),
    Call("info good.csv.gz", "good.csv.gz"),
    Call("info session.zip", "session.zip"),
    Call("info -", stdin="good.csv"),
    *[Call(f"info {log}", log) for log in LOGS],
    Call("segment good.csv", "good.csv"),
    Call("segment good.csv -o new.json --report new.html --plots plots", "good.csv"),
    Call("evaluate good.csv --calibration mine=cal.json --report new.html", "good.csv cal.json"),
    Call("allan good.csv --rest 0,19 -o new.json --report new.html", "good.csv"),
    Call("allan good.csv --rest 0,19 --json", "good.csv"),
    # Recordings to recordings.
    Call("convert good.csv -o new.csv", "good.csv"),
    Call("convert good.csv -o made", "good.csv"),
    Call("convert session.zip -o made/deep/folder", "session.zip"),
    Call("convert - -o new.csv", stdin="good.csv"),
    Call("apply cal.json good.csv", "cal.json good.csv"),
    Call("apply cal.json good.csv -o new.csv --force", "cal.json good.csv", old="new.csv", quick=True),
    Call("apply cal.json session -o made", "cal.json session"),
    # Calibrating.
    Call("calibrate good.csv", "good.csv"),
    Call("calibrate good.csv -o new.json --report new.html", "good.csv"),
    Call("calibrate good.csv -o new.json --report new.html --force --json", "good.csv", old="new.json new.html"),
    Call("calibrate session -o new.json", "session"),
    Call("calibrate beside -o new.json", "beside"),
    Call("calibrate - -o new.json", stdin="good.csv"),
    Call("calibrate --accel-file session/acc.csv --gyro-file session/gyro.csv --method stepwise -o new.json", "session"),
    Call("calibrate good.csv --gyro-recording other.csv --effect-file fx.toml --effects gyro_cross --limits limits.toml",
         "good.csv other.csv fx.toml limits.toml"),
    Call("calibrate good.csv --sections rests.csv", "good.csv rests.csv"),
    Call("calibrate --static-means means.csv -o new.json", "means.csv"),
    Call("calibrate good.csv --prior prior.json -o new.json", "good.csv prior.json"),
    Call("bias cal.json good.csv -o new.json --report new.html", "cal.json good.csv"),
    Call("reckon good.csv --motion 21,24 --calibration mine=cal.json -o new.json --report new.html", "good.csv cal.json"),
    Call("discover good.csv -o new.json --report new.html --emit-effect gyro_new.rs", "good.csv"),
    Call("discover good.csv --validation other.csv --effect-file fx.toml", "good.csv other.csv fx.toml"),
    Call("discover good.csv --noise noise.json", "good.csv noise.json"),
    Call("import imu.yaml -o new.json", "imu.yaml"),
    Call("export cal.json --to px4 -o new.params", "cal.json"),
    Call("export cal.json --to imu_tk -o made", "cal.json"),
    Call("export cal.json --to kalibr --noise noise.json -o new.yaml --json", "cal.json noise.json"),
    Call("export cal.json --to ardupilot --logged-with log.param -o new.param", "cal.json log.param"),
    # Sessions.
    Call("plan", ""),
    Call("plan cal.json -o new.json --report new.html", "cal.json"),
    Call("plan good.csv", "good.csv"),
    Call("simulate spec.toml -o made", "spec.toml"),
    Call("simulate spec.toml -o made --force", "spec.toml", old="made/acc.csv made/gyro.csv made/truth.json"),
    Call("demo", ""),
    Call("demo --out made", ""),
    Call("live - --out made -o new.json --events events.jsonl", stdin="short.csv"),
    # Many devices.
    Call("batch devices -o out --jobs 1", "devices"),
    Call("batch manifest.csv -o out --jobs 1 --limits limits.toml", "devices manifest.csv limits.toml"),
    Call("batch devices -o out --jobs 1 --resume", "devices out"),
    Call("batch merge out -o new --jsonl --csv --report", "out"),
    Call("batch prior out -o new.json", "out"),
    # What the program says of itself.
    Call("effects", ""),
    Call("effects --json --effect-file fx.toml", "fx.toml"),
    Call("page -o new.html", ""),
    Call("generate --completions bash", ""),
    Call("generate --man made", ""),
    Call("generate --options", ""),
    Call("--help", ""),
    Call("--version", "", quick=True),
    Call("calibrate --help", ""),
    # Calls that fail of themselves: the message is one line, or a document on standard output.
    Call("calibrate missing.csv --json", ""),
    Call("calibrate good.csv --no-such-option", "good.csv"),
    Call("convert good.csv -o new.csv", "good.csv", old="new.csv"),
    Call("convert good.csv -o new.csv --skip-existing", "good.csv", old="new.csv"),
]


def furnish(program, store, quick):
    """Every input of the calls, made by the program itself in `store`."""

    def run(words, expected=(0,)):
        done = subprocess.run([program, *words.split()], cwd=store, capture_output=True, stdin=subprocess.DEVNULL)
        if done.returncode not in expected:
            raise SystemExit(f"stillpoint {words}: status {done.returncode}\n{done.stderr.decode()}")

    def write(name, text):
        (store / name).write_text(text)

    write("spec.toml", SESSION)
    write("limits.toml", 'required = ["accelerometer"]\n')
    write("fx.toml", EFFECT)
    write("means.csv", "ax,ay,az\n" + "".join(f"{a},{b},{c}\n" for a, b, c in means()))
    write("log.param", "INS_ACCSCAL_X,1.0\n")
    run("simulate spec.toml -o session")
    (store / "session/truth.json").unlink()
    write("spec.toml", LEAST)
    run("convert session -o good.csv")
    run("calibrate good.csv -o cal.json", expected=(0, 1))
    if quick:
        return
    (store / "other.csv").write_bytes((store / "good.csv").read_bytes())
    run("segment good.csv -o rests.json")
    rests = json.loads((store / "rests.json").read_text())["static"]
    write("rests.csv", "t0,t1\n" + "".join(f"{rest['t0']},{rest['t1']}\n" for rest in rests))
    run("allan good.csv --rest 0,19 -o noise.json")
    run("export cal.json --to kalibr --noise noise.json -o imu.yaml")
    (store / "good.csv.gz").write_bytes(gzip.compress((store / "good.csv").read_bytes(), mtime=0))
    with zipfile.ZipFile(store / "session.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for name in ("acc.csv", "gyro.csv"):
            archive.write(store / "session" / name, name)
    # A file that is told by its columns, beside one that is told by its name.
    (store / "beside").mkdir()
    for name, other in [("acc.csv", "acc.csv"), ("gyro.csv", "turns.csv")]:
        (store / "beside" / other).write_bytes((store / "session" / name).read_bytes())
    # The first rest and some turns: enough for a session that is guided, and too little for a calibration.
    write("short.csv", "".join((store / "good.csv").read_text().splitlines(True)[:2500]))
    for log in LOGS:
        (store / log).write_bytes((CORPUS / log / "seed-0").read_bytes())
    (store / "devices").mkdir()
    for seed in range(2):
        write("device.toml", DEVICE.format(seed=seed))
        run(f"simulate device.toml -o devices/d{seed}")
        (store / f"devices/d{seed}/truth.json").unlink()
    write("manifest.csv", "id,inputs\nA,devices/d0\nB,devices/d1\n")
    run("batch devices -o out --jobs 1", expected=(0, 1))
    write("prior.json", PRIOR)


def means():
    """Mean readings of a perfect sensor in twelve placements."""
    g, s, h = 9.80665, 9.80665 / 2**0.5, 9.80665 / 3**0.5
    axes = [(g, 0, 0), (-g, 0, 0), (0, g, 0), (0, -g, 0), (0, 0, g), (0, 0, -g)]
    return axes + [(s, s, 0), (0, s, s), (s, 0, s), (h, h, h), (-h, h, -h), (h, -h, -h)]
