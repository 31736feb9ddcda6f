"""Drives a headless Chromium for tests, in the W3C WebDriver protocol, with the standard library alone."""
import base64
import json
import os
import re
import subprocess
import time
import urllib.error
import urllib.request


class Browser:
    """One window of a headless Chromium."""

    def __init__(self, scratch, width, height, *more_arguments):
        self.scratch = scratch
        # Port 0: the driver finds a free one and says which.
        self.log = open(os.path.join(scratch, "driver.log"), "w+")
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=self.log, stderr=subprocess.STDOUT)
        self.base = f"http://127.0.0.1:{self.wait_for_port()}"
        arguments = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--hide-scrollbars", "--force-device-scale-factor=1", f"--window-size={width},{height}",
                     f"--user-data-dir={os.path.join(scratch, 'profile')}", *more_arguments]
        capabilities = {"browserName": "chrome", "goog:chromeOptions": {"args": arguments},
                        "goog:loggingPrefs": {"browser": "ALL"}}
        answer = self.send("POST", "/session", {"capabilities": {"alwaysMatch": capabilities}})
        self.session = f"/session/{answer['sessionId']}"

    def wait_for_port(self):
        for _ in range(600):
            with open(self.log.name) as log:
                found = re.search(r"started successfully on port (\d+)", log.read())
            if found:
                return int(found[1])
            time.sleep(0.05)
        raise RuntimeError("chromedriver did not start")

    def send(self, verb, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.base + path, data, {"Content-Type": "application/json"}, method=verb)
        try:
            with urllib.request.urlopen(request, timeout=120) as response:
                return json.load(response)["value"]
        except urllib.error.HTTPError as error:
            raise RuntimeError(f"{verb} {path}: {error.read().decode()[:500]}") from error

    def post(self, path, **body):
        return self.send("POST", self.session + path, body)

    def run(self, script, *arguments):
        return self.post("/execute/sync", script=script, args=list(arguments))

    def wait_until(self, script, what, *arguments):
        for _ in range(400):
            if self.run("return " + script, *arguments):
                return
            time.sleep(0.05)
        raise AssertionError(f"never happened: {what}")

    def mouse(self, *steps):
        self.post("/actions", actions=[{"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"},
                                        "actions": list(steps)}])

    def keys(self, text):
        steps = [{"type": kind, "value": key} for key in text for kind in ("keyDown", "keyUp")]
        self.post("/actions", actions=[{"type": "key", "id": "keyboard", "actions": steps}])

    def console(self):
        return self.post("/se/log", type="browser")

    def save(self, path, data):
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))

    def close(self):
        try:
            self.send("DELETE", self.session)
        finally:
            self.driver.terminate()
            self.driver.wait()
            self.log.close()


def check(condition, what):
    if not condition:
        raise AssertionError(what)


def center_of(browser, selector):
    return browser.run("const b = document.querySelector(arguments[0]).getBoundingClientRect();"
                       "return [b.left + b.width / 2, b.top + b.height / 2];", selector)


def at(point, kind="pointerMove", **more):
    return {"type": kind, "x": round(point[0]), "y": round(point[1]), "duration": 0, **more}


PRESS = {"type": "pointerDown", "button": 0}
RELEASE = {"type": "pointerUp", "button": 0}
