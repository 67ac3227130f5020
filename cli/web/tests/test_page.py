"""The page in a browser against the command line. `.ci/page` builds both and says where they are:

STILLPOINT_PAGE  the page
STILLPOINT_BIN   the program
"""

import json
import os
import subprocess
import zipfile
from pathlib import Path

import pytest

from browser import Browser, chromium
from differences import furthest

PAGE = os.environ.get("STILLPOINT_PAGE", "")
PROGRAM = os.environ.get("STILLPOINT_BIN", "")
# Rounding differs: the processor of the command line multiplies and adds in one step, WebAssembly in two.
CLOSE = 1e-8

pytestmark = pytest.mark.skipif(not (PAGE and PROGRAM and chromium()), reason="no page, no program or no Chromium")


def command_line(folder, *words):
    """Runs the program in a folder."""
    return subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True, check=False)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A simulated session, and what the command line makes of it."""
    made = tmp_path_factory.mktemp("page")
    assert command_line(made, "demo", "--out", "demo").returncode == 0
    (made / "demo/recording.csv").rename(made / "session.csv")
    lines = (made / "session.csv").read_text().splitlines()
    # The same session on two clocks, as an app's folder has it.
    (made / "phone").mkdir()
    for name, begin in (("acc", 1), ("gyro", 4)):
        rows = [",".join([row.split(",")[0], *row.split(",")[begin : begin + 3]]) for row in lines]
        (made / "phone" / f"{name}.csv").write_text("\n".join(rows) + "\n")
    # Rows of two devices.
    header, *rows = lines
    both = []
    for row in rows:
        t, *values = row.split(",")
        off = [f"{float(value) + bias:.6f}" for value, bias in zip(values, (0.3, -0.2, 0.4, 0.02, -0.03, 0.01))]
        both += [",".join([t, "0", *values]), ",".join([t, "1", *off])]
    (made / "two.csv").write_text("\n".join([header.replace("t,", "t,I,"), *both]) + "\n")
    return made


@pytest.fixture
def browser():
    """A browser with the page open."""
    opened = Browser(chromium())
    opened.open(PAGE)
    yield opened
    opened.close()


def idle(browser):
    browser.until("document.getElementById('busy').hidden && !document.body.hasAttribute('aria-busy')")


def given(browser, *files, field="#files"):
    """Gives files to the page and waits until it says what is in them."""
    browser.run("document.getElementById('what').replaceChildren()")
    browser.choose(field, *files)
    browser.until("document.getElementById('what').children.length > 0")
    idle(browser)


def calibrated(browser):
    browser.click("#calibrate")
    browser.until("!document.getElementById('result').hidden")
    idle(browser)
    return browser.saved("cal.json")


def test_a_recording_gives_the_calibration_of_the_command_line(browser, folder):
    given(browser, folder / "session.csv")
    assert "accelerometer" in browser.text("#what")
    mine = calibrated(browser)
    words = ["calibrate", "session.csv", "-o", "cal.json", "--report", "report.html"]
    assert "stillpoint " + " ".join(words) in browser.run("document.getElementById('command').textContent")
    assert command_line(folder, *words, "--force").returncode == 0
    distance, place = furthest(json.loads(mine), json.loads((folder / "cal.json").read_text()))
    assert distance < CLOSE, place
    shown = browser.run("document.querySelector('.shown').shadowRoot.textContent")
    assert "Directions covered" in shown
    assert browser.run("document.querySelector('#pictures .shown').shadowRoot.querySelectorAll('svg').length") > 5
    steps = browser.run("[...document.querySelectorAll('.steps li')].map((step) => step.innerText)")
    assert any("Correct a recording" in step and "Choose a recording" in step for step in steps), steps


def test_a_folder_is_one_recording_and_two_files_of_one_sensor_each_are_too(browser, folder):
    given(browser, folder / "phone", field="#folder")
    whole = json.loads(calibrated(browser))
    given(browser, folder / "phone/acc.csv", folder / "phone/gyro.csv")
    assert "calibrate recording -o" in browser.run("document.getElementById('command').textContent")
    apart = json.loads(calibrated(browser))
    assert apart["gyroscope"] == whole["gyroscope"]


def test_a_file_that_is_dropped_is_taken_as_one_that_is_chosen(browser, folder):
    text = json.dumps((folder / "session.csv").read_text())
    browser.run(
        f"(() => {{ const data = new DataTransfer(); data.items.add(new File([{text}], 'dropped.csv'));"
        "document.getElementById('drop').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true })); })()"
    )
    browser.until("document.querySelectorAll('#what table').length > 0")
    assert "dropped.csv" in browser.text("#what")


def test_a_choice_that_a_message_offers_is_a_button(browser, folder):
    given(browser, folder / "two.csv")
    assert "2 devices" in browser.text("#what")
    buttons = "[...document.querySelectorAll('#what .failure button')]"
    assert browser.run(f"{buttons}.map((b) => b.textContent)") == ["Use --instance 0", "Use --instance 1"]
    browser.run(f"{buttons}[1].click()")
    browser.until("document.querySelectorAll('#what table').length > 0")
    idle(browser)
    assert "--instance 1" in browser.run("document.getElementById('command').textContent")


def offers(browser, where="#what"):
    return browser.run(f"[...document.querySelectorAll('{where} .failure button')].map((b) => b.textContent)")


def test_what_a_message_offers_is_whole_and_only_what_a_person_can_take(browser, folder):
    (folder / "unnamed.csv").write_text("p,q,r,s\n" + "1,2,3,4\n" * 30)
    given(browser, folder / "unnamed.csv")
    assert any("--columns t=1,ax=2,ay=3,az=4" in offer for offer in offers(browser)), offers(browser)
    with zipfile.ZipFile(folder / "days.zip", "w") as days:
        for name in ("it's early.csv", "late.csv"):
            days.write(folder / "session.csv", name)
    given(browser, folder / "days.zip")
    assert offers(browser) == ["Use --entry 'it'\\''s early.csv'", "Use --entry late.csv"]
    browser.click("#what .failure button")
    browser.until("document.querySelectorAll('#what table').length > 0")
    idle(browser)
    browser.run("document.getElementById('option--latitude').value = '95'")
    browser.click("#calibrate")
    browser.until("document.querySelector('#verdict .failure')")
    assert "95" in browser.text("#verdict") and offers(browser, "#verdict") == []


def test_a_log_of_several_sensors_asks_for_an_accelerometer_with_its_gyroscope(browser):
    log = Path(os.environ.get("STILLPOINT_DATA", Path(__file__).resolve().parents[4] / "shared/data")) / "formats/px4_sample_log_small.ulg"
    if not log.exists():
        pytest.skip(f"{log} is not there")
    given(browser, log)
    offers = browser.run("[...document.querySelectorAll('#what .choices button')].map((b) => b.textContent)")
    assert "Use --topic sensor_accel,sensor_gyro --instance 1" in offers and len(offers) == 4
    browser.run("document.querySelectorAll('#what .choices button')[1].click()")
    browser.until("document.querySelectorAll('#what tbody tr').length === 2")
    assert "gyroscope" in browser.text("#what table")


def test_discovery_export_and_another_recording_follow_a_calibration(browser, folder):
    given(browser, folder / "session.csv")
    calibrated(browser)
    browser.click("#discover")
    browser.until("document.querySelector('#discovered .shown')")
    idle(browser)
    findings = json.loads(browser.saved("findings.json"))
    assert findings["effects"][0]["name"] == "gyro_g_sensitivity"
    browser.click("#export")
    browser.until("document.querySelector('#done a')")
    assert b"CAL_ACC0_XOFF" in browser.saved("imu.params")
    browser.choose("#other", folder / "session.csv")
    browser.until("!document.getElementById('correct').disabled")
    browser.click("#correct")
    browser.until("document.querySelector('#done a[download=\"corrected.csv\"]')")
    assert browser.saved("corrected.csv").startswith(b"t,ax,ay,az,gx,gy,gz")
    browser.click("#evaluate")
    browser.until("document.querySelector('#done .shown')")
    assert "Evaluation" in browser.text("#done h2")


def evaluated(browser, recording):
    browser.choose("#other", recording)
    browser.until("!document.getElementById('evaluate').disabled")
    browser.click("#evaluate")
    browser.until("document.getElementById('done').children.length > 0")
    idle(browser)


def test_another_recording_is_read_with_the_options_or_with_those_that_its_failure_offers(browser, folder):
    given(browser, folder / "session.csv")
    calibrated(browser)
    evaluated(browser, folder / "two.csv")
    assert offers(browser, "#done") == ["Use --instance 0", "Use --instance 1"]
    browser.click("#done .failure button")
    browser.until("document.querySelector('#done .shown')")
    assert "--instance 0" in browser.text("#done .command")


def test_a_result_stays_until_there_is_a_new_one(browser, folder):
    given(browser, folder / "session.csv")
    calibrated(browser)
    browser.click("#calibrate")
    browser.key("Escape", 27)
    browser.until("!document.getElementById('problem').hidden")
    assert not browser.run("document.getElementById('further').hidden")
    # Nobody cancels by pressing twice.
    browser.run("document.getElementById('verdict').replaceChildren()")
    browser.run("(() => { const all = document.getElementById('calibrate'); all.click(); all.click(); })()")
    browser.until("document.getElementById('verdict').children.length > 0")
    idle(browser)
    assert browser.run("document.getElementById('problem').hidden")
    browser.run("document.getElementById('more-options').value = '--rate 50'")
    browser.click("#look")
    browser.until("document.getElementById('result').hidden")
    idle(browser)
    browser.click("#calibrate")
    given(browser, folder / "two.csv")
    assert browser.run("document.getElementById('problem').hidden && document.getElementById('result').hidden")


def test_files_may_have_the_names_of_options_of_results_and_of_each_other(browser, folder):
    for name in ("cal.json", "--help.csv"):
        (folder / "odd").mkdir(exist_ok=True)
        (folder / "odd" / name).write_bytes((folder / "session.csv").read_bytes())
        given(browser, folder / "odd" / name)
        assert f"{name} is called 2-{name} here" in browser.text("#what")
        calibrated(browser)
    (folder / "odd/session.csv").write_bytes((folder / "session.csv").read_bytes())
    given(browser, folder / "session.csv", folder / "odd/session.csv")
    assert "calibrate session.csv 2-session.csv" in browser.run("document.getElementById('command').textContent")


def test_a_file_that_is_changed_after_it_was_chosen_is_named(browser, folder):
    fleeting = folder / "fleeting.csv"
    fleeting.write_bytes((folder / "session.csv").read_bytes())
    given(browser, fleeting)
    fleeting.unlink()
    browser.click("#calibrate")
    browser.until("document.querySelector('#verdict .failure')")
    assert "fleeting.csv was changed or removed after it was chosen; choose it again" in browser.text("#verdict")
    assert not browser.run("document.querySelector('#verdict a')")


def test_what_is_no_calibration_is_not_used_as_one(browser, folder):
    assert command_line(folder, "calibrate", "session.csv", "-o", "whole.json", "--force").returncode == 0
    broken = json.loads((folder / "whole.json").read_text())
    broken["accelerometer"]["T"][0][0] = "broken"
    (folder / "broken.json").write_text(json.dumps(broken))
    given(browser, folder / "broken.json")
    assert "broken.json" in browser.text("#what .failure")
    assert browser.run("document.getElementById('further').hidden")
    given(browser, folder / "whole.json")
    assert not browser.run("document.getElementById('further').hidden")
    browser.run("localStorage.setItem('stillpoint/2026-01-01T00:00:00 cal.json', 'no calibration')")
    browser.open(PAGE)
    assert browser.run("document.getElementById('kept').hidden")


def test_the_keyboard_alone_is_enough_and_escape_cancels(browser, folder):
    given(browser, folder / "session.csv")
    browser.run("document.getElementById('calibrate').focus()")
    browser.key("Enter", 13)
    browser.until("!document.getElementById('busy').hidden")
    browser.key("Escape", 27)
    browser.until("!document.getElementById('problem').hidden")
    assert "Cancelled" in browser.text("#problem")
    browser.key("Enter", 13)
    browser.until("!document.getElementById('result').hidden")
    # What a key reaches is a control, and no control is out of its reach.
    reached = set()
    for _ in range(60):
        browser.key("Tab", 9)
        reached.add(browser.run("document.activeElement.id"))
    assert {"choose-files", "discover", "target", "export", "choose-other", "keep"} <= reached


def test_a_simulated_recording_is_at_hand_for_those_who_have_none(browser):
    browser.click("#try")
    browser.until("document.querySelectorAll('#what table').length > 0")
    assert "recording.csv" in browser.text("#what")


def test_nothing_is_asked_of_a_network_and_no_script_of_a_file_runs(browser, folder):
    nasty = folder / "<img src=x onerror=document.title='run'>.csv"
    nasty.write_bytes((folder / "session.csv").read_bytes())
    given(browser, nasty)
    calibrated(browser)
    assert browser.run("document.title") == "Stillpoint"
    kinds = {url.split(":")[0] for url in browser.requests}
    assert kinds <= {"file", "blob", "data", "about"}, browser.requests
    assert [url for url in browser.requests if url.startswith("file")] == [Path(PAGE).resolve().as_uri()]
    with pytest.raises(RuntimeError):
        browser.run("fetch('https://example.invalid/')")
    assert not [text for text in browser.logs if "example.invalid" not in text]


def test_broken_files_are_refused_with_a_reason_and_the_page_goes_on(browser, folder):
    for name, content in {"empty.csv": b"", "noise.ulg": bytes(range(256)) * 40, "zip.zip": b"PK\3\4" + b"\0" * 99}.items():
        (folder / name).write_bytes(content)
        given(browser, folder / name)
        assert name in browser.text("#what .failure"), browser.text("#what")
    given(browser, folder / "session.csv")
    assert "accelerometer" in browser.text("#what")


def test_a_file_that_is_too_large_is_refused_by_its_size_with_the_way_out(browser, folder):
    large = folder / "large.csv"
    with large.open("wb") as file:
        file.truncate(301_000_000)
    given(browser, large)
    said = browser.text("#what")
    assert "301 MB" in said and "stillpoint calibrate large.csv" in said


def test_no_part_is_wider_than_a_phone(browser, folder):
    browser.look(390, "dark")
    given(browser, folder / "session.csv")
    calibrated(browser)
    assert browser.run("document.documentElement.scrollWidth") <= 390


def test_a_calibration_is_kept_only_on_request(browser, folder):
    given(browser, folder / "session.csv")
    calibrated(browser)
    assert browser.run("localStorage.length") == 0
    browser.click("#keep")
    assert browser.run("localStorage.length") == 1
    browser.open(PAGE)
    assert "cal.json" in browser.text("#kept")
    browser.click("#kept button")
    browser.until("!document.getElementById('further').hidden")
    browser.click("#export")
    browser.until("document.querySelector('#done a')")
