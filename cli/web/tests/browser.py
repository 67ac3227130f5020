"""A headless Chromium, driven over a pipe: a page, its files, its downloads, its pictures. Needs nothing but Python."""

import base64
import fcntl
import json
import os
import queue
import shutil
import subprocess
import tempfile
import threading
import time
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome")
# Longest wait for anything, s.
PATIENCE = 240.0


def chromium():
    """The browser's path, or None."""
    return next(filter(None, map(shutil.which, NAMES)), None)


class Browser:
    """One browser with one page."""

    def __init__(self, path):
        # Processes of the browser that end a moment later still write there.
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.downloads = Path(self.profile.name) / "downloads"
        self.downloads.mkdir()
        (to_read, self._to), (self._from, to_write) = os.pipe(), os.pipe()
        # Out of the way of the numbers that the browser reads from and writes to.
        to_read, to_write = (fcntl.fcntl(fd, fcntl.F_DUPFD, 30) for fd in (to_read, to_write))

        def numbers():
            os.dup2(to_read, 3)
            os.dup2(to_write, 4)

        self.process = subprocess.Popen(
            [
                path,
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--no-first-run",
                "--disable-background-networking",
                "--disable-component-update",
                "--disable-sync",
                "--remote-debugging-pipe",
                f"--user-data-dir={self.profile.name}/profile",
                "about:blank",
            ],
            preexec_fn=numbers,
            pass_fds=(3, 4),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(to_read)
        os.close(to_write)
        self.requests, self.logs = [], []
        self._answers, self._count, self._session = queue.Queue(), 0, None
        threading.Thread(target=self._listen, daemon=True).start()
        folder = {"behavior": "allow", "downloadPath": str(self.downloads)}
        self.send("Browser.setDownloadBehavior", **folder)
        target = self.send("Target.createTarget", url="about:blank")["targetId"]
        attached = self.send("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        for domain in ("Page", "Runtime", "Network", "DOM", "Log"):
            self.send(f"{domain}.enable")

    def _listen(self):
        held = b""
        while part := os.read(self._from, 1 << 20):
            *messages, held = (held + part).split(b"\0")
            for message in map(json.loads, messages):
                method, params = message.get("method"), message.get("params", {})
                if "id" in message:
                    self._answers.put(message)
                elif method == "Network.requestWillBeSent":
                    self.requests.append(params["request"]["url"])
                elif method == "Log.entryAdded":
                    self.logs.append(params["entry"]["text"])
                elif method == "Runtime.exceptionThrown":
                    self.logs.append(json.dumps(params["exceptionDetails"])[:2000])

    def send(self, method, **params):
        """Calls a method of the protocol and gives its result."""
        self._count += 1
        message = {"id": self._count, "method": method, "params": params}
        if self._session:
            message["sessionId"] = self._session
        os.write(self._to, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._answers.get(timeout=PATIENCE)
            if answer["id"] == self._count:
                break
        if "error" in answer:
            raise RuntimeError(f"{method}: {answer['error']}")
        return answer["result"]

    def open(self, page):
        """Loads a page and waits until its script has run."""
        self.send("Page.navigate", url=Path(page).resolve().as_uri())
        self.until("document.documentElement?.dataset.ready === 'true'")

    def run(self, script):
        """The value of an expression in the page."""
        result = self.send("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True, userGesture=True)
        if "exceptionDetails" in result:
            raise RuntimeError(f"{script}: {result['exceptionDetails']}")
        return result["result"].get("value")

    def until(self, condition):
        """Waits until an expression holds."""
        end = time.monotonic() + PATIENCE
        while not self.run(f"Boolean({condition})"):
            if time.monotonic() > end:
                raise TimeoutError(f"{condition}; {self.logs[-3:]}; {self.text('body')[-2000:]}")
            time.sleep(0.02)

    def text(self, selector):
        """What a person reads in an element."""
        return self.run(f"document.querySelector({json.dumps(selector)})?.innerText ?? ''")

    def click(self, selector):
        """Clicks on an element."""
        self.run(f"document.querySelector({json.dumps(selector)}).click()")

    def choose(self, selector, *files):
        """Chooses files, or a folder, in a field."""
        root = self.send("DOM.getDocument")["root"]["nodeId"]
        node = self.send("DOM.querySelector", nodeId=root, selector=selector)["nodeId"]
        self.send("DOM.setFileInputFiles", nodeId=node, files=[str(Path(file).resolve()) for file in files])

    def key(self, key, code, **more):
        """Presses a key."""
        for kind in ("keyDown", "keyUp"):
            text = {"text": "\r"} if key == "Enter" and kind == "keyDown" else {}
            self.send("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, **text, **more)

    def saved(self, name):
        """The bytes of a file that the page offers to save."""
        target = self.downloads / name
        target.unlink(missing_ok=True)
        self.click(f"a[download={json.dumps(name)}]")
        end = time.monotonic() + PATIENCE
        while not target.exists():
            if time.monotonic() > end:
                raise TimeoutError(f"{name} is not saved; {self.logs[-3:]}")
            time.sleep(0.02)
        return target.read_bytes()

    def look(self, width, scheme="light", media=""):
        """Makes the page so wide, light or dark."""
        metrics = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600}
        self.send("Emulation.setDeviceMetricsOverride", **metrics)
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        self.send("Emulation.setEmulatedMedia", media=media, features=features)

    def picture(self, path, longest=12000):
        """A picture of the whole page."""
        size = self.send("Page.getLayoutMetrics")["cssContentSize"]
        clip = {"x": 0, "y": 0, "width": size["width"], "height": min(size["height"], longest), "scale": 1}
        shot = self.send("Page.captureScreenshot", format="png", clip=clip, captureBeyondViewport=True)
        Path(path).write_bytes(base64.b64decode(shot["data"]))

    def close(self):
        """Ends the browser."""
        self.process.terminate()
        self.process.wait(timeout=20)
        self.profile.cleanup()
