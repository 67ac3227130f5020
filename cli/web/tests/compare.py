"""Calibrations of the page beside those of the command line: differences and times.

    python3 compare.py PAGE PROGRAM RECORDING...

A recording is a file or a folder, perhaps with options behind it: `log.ulg::--instance 0`.
"""

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from browser import Browser, chromium
from differences import furthest, in_errors


def native(program, recording, options, folder):
    """The calibration of the command line, and how long it took, s: the quicker of two runs."""
    times = []
    for _ in range(2):
        begin = time.perf_counter()
        words = [program, "calibrate", recording.name, *options, "-o", f"{folder}/cal.json", "--report", f"{folder}/report.html"]
        run = subprocess.run([*words, "--json", "--force"], cwd=recording.parent, capture_output=True, text=True, check=False)
        times.append(time.perf_counter() - begin)
    made = Path(folder) / "cal.json"
    return run.returncode, made.read_bytes() if made.exists() else None, min(times)


def in_page(browser, recording, options):
    """The same of the page. The second of two calibrations counts: the first compiles the program."""
    field = "#folder" if recording.is_dir() else "#files"
    browser.run("document.getElementById('what').replaceChildren()")
    browser.choose(field, recording)
    browser.until("document.getElementById('what').children.length > 0 && document.getElementById('busy').hidden")
    times = []
    for _ in range(2):
        browser.run(f"document.getElementById('more-options').value = {json.dumps(' '.join(options))}")
        browser.run("document.getElementById('calibrate').disabled = false")
        browser.run("document.getElementById('result').hidden = true")
        begin = time.perf_counter()
        browser.click("#calibrate")
        browser.until("!document.getElementById('result').hidden && document.getElementById('busy').hidden")
        times.append(time.perf_counter() - begin)
    has = browser.run("Boolean(document.querySelector('a[download=\"cal.json\"]'))")
    return browser.saved("cal.json") if has else None, times


def main():
    page, program, *recordings = sys.argv[1:]
    browser = Browser(chromium())
    browser.open(page)
    print(f"{'recording':34} {'exit':>4} {'same':>5} {'difference':>10} {'of sigma':>8} {'native s':>8} {'first s':>8} {'page s':>7}  furthest")
    for words in recordings:
        name, _, options = words.partition("::")
        recording, options = Path(name).resolve(), options.split()
        with tempfile.TemporaryDirectory() as folder:
            code, mine, seconds = native(program, recording, options, folder)
        theirs, (first, second) = in_page(browser, recording, options)
        same, difference, errors, place = mine == theirs, 0.0, 0.0, ""
        if not same and mine and theirs:
            difference, place = furthest(json.loads(mine), json.loads(theirs))
            errors = in_errors(json.loads(mine), json.loads(theirs))
        elif not same:
            difference, place = 1.0, "only one has a calibration"
        label = "/".join(recording.parts[-2:])[-34:]
        said = "yes" if same and mine else "none" if same else "no"
        print(f"{label:34} {code:4} {said:>5} {difference:10.1e} {errors:8.0e} {seconds:8.2f} {first:8.2f} {second:7.2f}  {place}", flush=True)
    outside = [url for url in browser.requests if url.split(":")[0] not in ("file", "blob", "data", "about")]
    print(f"requests that left the page: {len(outside)}")
    browser.close()


if __name__ == "__main__":
    main()
