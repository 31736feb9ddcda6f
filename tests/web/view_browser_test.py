#!/usr/bin/env python3
"""Looks at a scene by `burin view` in a real browser, with a real mouse, and uses all of it.

    view_browser_test.py BURIN FOLDER    screenshots are left in FOLDER
"""
import base64
import json
import os
import resource
import shutil
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import time
import urllib.request

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from browser import PRESS, RELEASE, Browser, at, center_of, check
from view_page import FIRST_INK, IS_WELL, PICTURE, SET_VALUE, STATE, Page

SCENE = """
[[object]]
name = "ring"
shape = "torus"
rotate = [65, 10, 0]
segments = 96
tube_segments = 48
[[object]]
name = "cube"
shape = "box"
size = [0.5, 0.5, 0.5]
rotate = [0, 30, 0]
translate = [0.1, 0.15, 0]
"""

def start(burin, scene, *more):
    server = subprocess.Popen([burin, "view", scene, "--no-browser", "-q", *more], stdout=subprocess.PIPE, text=True)
    url = server.stdout.readline().strip()
    check(url.startswith("http://127.0.0.1:"), "the address stands on standard output")
    return server, url


def test_signal_at_once(burin, scene):
    for number in (signal.SIGTERM, signal.SIGINT) * 8:
        server, _ = start(burin, scene)
        server.send_signal(number)
        check(server.wait(timeout=10) == 0, "a signal ends it that comes right after the address")


def test_many_connections(burin, scene):
    """More connections than it has file descriptors wait, and keep no core busy; later ones are answered."""
    def few_files():
        resource.setrlimit(resource.RLIMIT_NOFILE, (24, 24))

    server = subprocess.Popen([burin, "view", scene, "--no-browser", "-q"], stdout=subprocess.PIPE, text=True,
                              preexec_fn=few_files)
    try:
        url = server.stdout.readline().strip()
        port = int(url.split(":")[2].split("/")[0])

        def ticks():
            with open(f"/proc/{server.pid}/stat") as file:
                return sum(int(n) for n in file.read().rsplit(")", 1)[1].split()[11:13])

        waiting = [socket.create_connection(("127.0.0.1", port)) for _ in range(40)]
        time.sleep(0.2)
        before = ticks()
        time.sleep(1.5)
        used = (ticks() - before) / os.sysconf("SC_CLK_TCK")
        check(used < 0.1, f"it waits: {used} s of CPU time in 1.5 s")
        for each in waiting:
            each.close()
        with urllib.request.urlopen(url, timeout=20) as answer:
            check(answer.status == 200, "those that come later are answered")
    finally:
        server.terminate()
        check(server.wait(timeout=10) == 0, "SIGTERM ends it with 0")


def test_view(page):
    page.changes(lambda: page.drag(160, 60), "dragging turns the scene")
    page.changes(lambda: page.drag(60, 20, button=2), "dragging with the right button moves it")
    page.changes(lambda: page.wheel(-300), "the wheel zooms")
    browser = page.browser
    browser.run("document.querySelector('#picture').focus()")
    for key, what in (("\ue012", "an arrow turns"), ("+", "plus zooms"), ("p", "P makes it parallel"),
                      ("3", "3 shows it from behind"), ("h", "H shows hidden lines"), ("f", "F fits it")):
        page.changes(lambda: browser.keys(key), what)
    browser.keys("?")
    browser.wait_until("document.querySelector('#help').open", "? shows the keys")
    browser.keys("\ue00c")
    browser.wait_until("!document.querySelector('#help').open", "Escape hides them")
    page.changes(lambda: page.click("#home"), "Home is the first view")
    page.settle()
    home, address = page.picture(), browser.run("return location.hash")
    page.changes(lambda: page.drag(90, 30), "it is turned once more")
    browser.run("location.hash = arguments[0]", address)
    browser.wait_until(f"{PICTURE} === arguments[0]", "an address that is put over this one is followed", home)
    for _ in range(40):
        page.wheel(-500)
    page.settle()
    check(browser.run("return document.querySelector('#toast').hidden"), "the zoom ends before the eye is at the target")
    page.changes(lambda: page.click("#home"), "Home is the first view again")


def test_rolled_camera(page, burin, scratch):
    """Whatever the roll of a model's camera, the scene is turned around its own vertical."""
    corners = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
    model = os.path.join(scratch, "rolled.gltf")
    with open(model, "w") as file:
        json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
                   "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0.3, 0.3, 4], "rotation": [0, 0, 0.2588, 0.9659]}],
                   "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}],
                   "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
                   "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,"
                                + base64.b64encode(corners).decode()}],
                   "bufferViews": [{"buffer": 0, "byteLength": 36}],
                   "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                                  "min": [0, 0, 0], "max": [1, 1, 0]}]}, file)
    server, url = start(burin, model)
    try:
        page.open(url)
        browser = page.browser
        page.changes(lambda: page.drag(40, 10), "the first drag turns it")
        upright = "new URLSearchParams(location.hash.slice(1)).get('up') === '0,1,0'"
        browser.wait_until(upright, "it stands upright")
        page.changes(lambda: page.click("#home"), "Home has the model's view")
        browser.wait_until("!(" + upright + ")", "with its roll")
        page.changes(lambda: page.click("#fit"), "Fit fits it")
        browser.wait_until(upright, "upright")
    finally:
        server.terminate()
        check(server.wait(timeout=10) == 0, "SIGTERM ends it with 0")


def test_looks(page):
    browser = page.browser
    page.changes(lambda: page.click("[data-lines=silhouette]"), "a click takes silhouettes away")
    page.changes(lambda: page.click("[data-lines=silhouette]"), "and brings them back")
    page.changes(lambda: page.click("#hidden [value=none]"), "hidden lines can be left out")
    page.changes(lambda: browser.run(SET_VALUE, "#width", "0.8"), "the slider makes lines wider")
    page.changes(lambda: browser.run(SET_VALUE, "#shading", "lambert"), "surfaces can be shaded")
    page.changes(lambda: browser.run(SET_VALUE, "#style", "comic"), "a style is chosen")
    check(browser.run("return document.querySelector('[data-lines=crease]').disabled"),
          "classes are the style's then")
    slider = "#parameters [data-name=width] input[type=range]"
    browser.wait_until(f"document.querySelector('{slider}')", "the style's parameters have sliders")
    x, y = center_of(browser, slider)
    page.changes(lambda: browser.mouse(at((x, y)), PRESS, at((x + 25, y)), RELEASE), "a parameter's slider changes it")
    page.settle()
    before, number = page.picture(), "#parameters [data-name=width] input[type=number]"
    had = browser.run("return document.querySelector(arguments[0]).value", number)
    browser.run(SET_VALUE, number, "-5")
    browser.wait_until("document.querySelector('#toast').textContent === 'width: must be at least 0, got -5'", "it is refused")
    browser.wait_until(f"document.querySelector('{number}').value === arguments[0]", "the value before comes back", had)
    page.settle()
    check(page.picture() == before, "the picture stays as it was")
    page.changes(lambda: browser.mouse(at((x + 25, y)), PRESS, at((x + 10, y)), RELEASE), "later changes are drawn")


def test_sheet(page):
    """A sheet is edited in place; what is wrong is shown at its line."""
    browser = page.browser
    page.click("#edit")
    area = "document.querySelector('#editor textarea')"
    browser.wait_until(f"{area}.value.includes('style_version')", "the text of the sheet is there")
    replace = f"""const a = {area}, from = a.value.indexOf(arguments[0]);
      a.focus(); a.setSelectionRange(from, from + arguments[0].length); return from"""
    element = browser.post("/element", using="css selector", value="#editor textarea")
    element = element["element-6066-11e4-a52e-4f735466cecf"]

    def edit(old, new):
        check(browser.run(replace, old) >= 0, f"the sheet has {old}")
        browser.post(f"/element/{element}/value", text=new)

    good = page.picture()
    edit("taper = {", "tapir = {")
    browser.wait_until("!document.querySelector('.fault-text').hidden", "a mistake is shown")
    text = browser.run("return document.querySelector('.fault-text').textContent")
    line = browser.run(f"return {area}.value.slice(0, {area}.value.indexOf('tapir')).split('\\n').length")
    check(f"line {line}" in text and "tapir" in text, f"at its line: {text}")
    place = browser.run("const f = document.querySelector('.fault').getBoundingClientRect(),"
                        f" a = {area}.getBoundingClientRect(); return [f.top - a.top, f.height, {area}.scrollTop]")
    check(abs(place[0] + place[2] - 8 - (line - 1) * place[1]) < 3, f"the line is marked: {place}, {line}")
    page.screenshot(os.path.join(page.folder, "mistake.png"))
    check(page.picture() == good, "the picture stays")
    edit("tapir = {", "taper = {")
    browser.wait_until("document.querySelector('.fault-text').hidden", "it goes away when it is mended")
    edit("* apart", "* aprat")
    browser.wait_until("document.querySelector('.fault-text').textContent.includes('aprat')",
                       "what is wrong in an expression is shown, too")
    edit("* aprat", "* 0.2")
    browser.wait_until("document.querySelector('.fault-text').hidden", "and mended")
    check(page.picture() != good, "an edited sheet draws at once")
    page.click("#edit")
    page.settle()
    kept = browser.run(f"return {area}.value")
    browser.run("document.activeElement.blur()")
    page.changes(lambda: browser.run(SET_VALUE, "#style", "pencil"), "another style is chosen")
    page.changes(lambda: browser.run(SET_VALUE, "#style", "comic"), "and the first one again")
    check(browser.run(f"return {area}.value") == kept, "what was typed into it is there")
    kept += "\n# at the last moment"
    page.changes(lambda: browser.run(
        f"const a = {area}; a.value = arguments[2]; a.dispatchEvent(new Event('input')); {SET_VALUE}",
        "#style", "pencil", kept), "another style is chosen at once")
    page.changes(lambda: browser.run(SET_VALUE, "#style", "comic"), "and the first one again")
    check(browser.run(f"return {area}.value") == kept, "what was typed just before is there, too")


def test_explain(page):
    """A click says why the nearest line is there, whatever draws it; the answer goes with its view."""
    browser = page.browser
    page.settle()
    shows = "!document.querySelector('#explained').hidden"
    x, y = browser.run(FIRST_INK)
    for beside in (0, -3):
        browser.mouse(at((x + beside, y)), PRESS, RELEASE)
        browser.wait_until(shows, "a click explains the line")
        text = browser.run("return document.querySelector('#explained').innerText")
        reason = text.split("\n")[2]
        check(reason.startswith("silhouette of ring: its surface turns away"), f"the reason comes first: {text}")
        page.screenshot(os.path.join(page.folder, "explained.png"))
        page.click("#explained .close")
    browser.mouse(at((x - 40, y)), PRESS, RELEASE)
    browser.wait_until(shows + " && document.querySelector('#explained').innerText.includes('no line is near')",
                       "a click where there is nothing says so")
    page.changes(lambda: page.drag(20, 0), "it is turned")
    check(browser.run("return document.querySelector('#explained').hidden"), "the answer was of the view before")
    browser.run("""const c = document.querySelector('#picture');
      c.addEventListener('pointerup', () => c.dispatchEvent(new WheelEvent('wheel', {deltaY: -200})), {once: true})""")
    page.changes(lambda: page.click("#picture"), "a click, and it is zoomed before there is an answer")
    check(browser.run("return document.querySelector('#explained').hidden"), "which comes too late")
    page.changes(lambda: page.click("#home"), "Home is the first view")


def test_files(page, burin):
    """What is saved is what `burin render` draws of the scene that is saved."""
    page.settle()
    png = page.downloaded("#save-png", "scene.png")
    svg = page.downloaded("#save-svg", "scene.svg")
    page.downloaded("#save-toml", "scene-view.toml")
    check(png.startswith(b"\x89PNG") and b"<svg" in svg[:400], "files of these kinds")
    again = os.path.join(page.folder, "again.png")
    subprocess.run([burin, "render", os.path.join(page.folder, "scene-view.toml"), "-o", again, "-q"], check=True)
    with open(again, "rb") as file:
        check(file.read() == png, "the scene draws the same PNG")
    page.settle()
    shown = page.browser.run("return " + PICTURE)
    as_shown = page.browser.post("/execute/async", script="""
      const [bytes, done] = arguments, image = new Image();
      image.onload = () => {
        const to = document.createElement('canvas');
        [to.width, to.height] = [image.width, image.height];
        to.getContext('2d').drawImage(image, 0, 0);
        done(to.toDataURL());
      };
      image.src = 'data:image/png;base64,' + bytes;""", args=[base64.b64encode(png).decode()])
    check(as_shown == shown, "and the page shows the same pixels")
    page.click("#copy")
    page.browser.wait_until("document.body.dataset.command", "the command line is there")
    command = page.browser.run("return document.body.dataset.command")
    check(command.startswith("burin render "), command)


def test_address(page):
    """The address has the view and the look, so a page that is loaded again shows the same."""
    page.settle()
    time.sleep(0.5)
    before = page.picture()
    url = page.browser.run("return location.href")
    check("eye=" in url and "style=comic" in url, f"the address says it: {url[:300]}")
    page.browser.post("/url", url="about:blank")
    page.open(url)
    page.browser.wait_until(f"{PICTURE} === arguments[0]", "the address is restored", before)


def test_two_pages(browser, burin, scene, folder):
    """Each page has its own view."""
    server, url = start(burin, scene)
    try:
        page = Page(browser, folder)
        page.open(url)
        first = browser.send("GET", browser.session + "/window")
        before = page.picture()
        other = browser.post("/window/new", type="tab")["handle"]
        browser.post("/window", handle=other)
        page.open(url)
        page.changes(lambda: page.drag(-120, 40), "the second page turns its scene")
        browser.send("DELETE", browser.session + "/window")
        browser.post("/window", handle=first)
        check(page.picture() == before, "the first page does not")
    finally:
        server.terminate()
        check(server.wait(timeout=10) == 0, "SIGTERM ends it with 0")
    browser.wait_until(STATE.format("gone"), "the page says that its server has ended")


def test_connection(page, burin, scene):
    """What is so is said where a page has no connection, and it goes on by itself when there is one again."""
    browser = page.browser
    script = browser.post("/goog/cdp/execute", cmd="Page.addScriptToEvaluateOnNewDocument", params={"source": """
        const Plain = WebSocket;
        window.sockets = [];
        WebSocket = class extends Plain { constructor(...all) { super(...all); window.sockets.push(this); } };"""})
    server, url = start(burin, scene)
    try:
        page.open(url)
        browser.run(SET_VALUE, "#width", "0.9")
        page.drag(70, 20)
        before = page.picture()
        browser.run("window.sockets[0].close()")
        browser.wait_until("window.sockets.length > 1 && document.body.dataset.connection === 'open'",
                           "a connection that was cut is made again")
        page.changes(lambda: page.drag(30, 0), "the page goes on")
        page.changes(lambda: page.drag(-30, 0), "and back")
        browser.wait_until(f"{PICTURE} === arguments[0]", "with the look that it had", before)
        address = browser.run("return location.hash")
        browser.run("location.hash = 'style=comic&sheet=' + '%01'.repeat(15000)")
        browser.wait_until("document.querySelector('.fault-text').textContent.includes('too long')",
                           "a message that the server would not read is said to be too long")
        browser.run("location.hash = arguments[0]", address)
        browser.wait_until(f"{PICTURE} === arguments[0]", "and the page goes on", before)
        check(browser.run("return window.sockets.length") == 2, "by the same connection")
        test_silence(page, server)
        # As many as the server shows at once; then one more.
        browser.run("for (let i = 0; i < 15; ++i) new WebSocket(`ws://${location.host}${location.pathname}socket`)")
        browser.wait_until("window.sockets.filter(s => s.readyState === 1).length === 16", "there are 16 pages")
        first = browser.send("GET", browser.session + "/window")
        other = browser.post("/window/new", type="tab")["handle"]
        browser.post("/window", handle=other)
        browser.post("/url", url=url)
        browser.wait_until(STATE.format("full"), "a page too many says that it is one")
        browser.post("/window", handle=first)
        browser.run("window.sockets.slice(-15).forEach(s => s.close())")
        browser.post("/window", handle=other)
        browser.wait_until("document.body.dataset.ready === 'yes'", "it begins when there is room")
        check(browser.run("return document.querySelector('#state').hidden"), "and says nothing more")
        browser.send("DELETE", browser.session + "/window")
        browser.post("/window", handle=first)
        server.kill()
        server.wait()
        page.drag(30, 0)
        browser.wait_until(STATE.format("gone"), "a server that is gone is said to be")
        with socket.create_server(("127.0.0.1", int(url.split(":")[2].split("/")[0]))):
            browser.wait_until(STATE.format("silent"), "what takes connections and never answers is said to")
        browser.wait_until(STATE.format("gone"), "until it is gone, too")
    finally:
        if server.poll() is None:
            server.kill()
        browser.post("/goog/cdp/execute", cmd="Page.removeScriptToEvaluateOnNewDocument", params=script)


def test_silence(page, server):
    """A server that is there and does not answer: the page says so, and goes on when it answers again."""
    browser = page.browser

    def is_silent(what):
        began = time.time()
        browser.wait_until(STATE.format("silent"), what)
        check(time.time() - began < 12, f"{what}: within a few seconds")

    def goes_on(what):
        server.send_signal(signal.SIGCONT)
        browser.wait_until(IS_WELL, what)

    before = page.picture()
    server.send_signal(signal.SIGSTOP)
    page.drag(40, 0)
    is_silent("a server that hangs is said to, when something is asked of it")
    page.screenshot(os.path.join(page.folder, "silent.png"))
    goes_on("it answers again")
    check(page.picture() != before, "and draws what was asked for")
    server.send_signal(signal.SIGSTOP)
    is_silent("a server that hangs is said to, when nothing is asked of it, too")
    goes_on("it answers once more")
    server.send_signal(signal.SIGSTOP)
    browser.run("window.sockets.at(-1).close()")
    is_silent("a server that hangs while a connection ends is said to")
    goes_on("the page connects anew when it answers")
    page.changes(lambda: page.drag(-40, 0), "it can be turned as before")
    # A message that the server never gets, beside others that it answers, stands for work without an end.
    browser.run("const s = window.sockets.at(-1); s.send = () => { delete s.send; }")
    page.drag(20, 0)
    browser.wait_until(STATE.format("busy"), "it is said that an answer is long due")
    browser.run("document.querySelector('#home').click()")
    browser.wait_until(IS_WELL, "until there is an answer")
    browser.run("window.sockets.at(-1).close()")  # begins anew, for the lost message
    browser.wait_until("window.sockets.at(-1).readyState === 1 && " + IS_WELL, "the page connects anew")
    page.settle()


def test_sizes(page):
    """It works as narrow as a telephone, in the dark as well."""
    browser = page.browser
    for name, width, height, scheme in (("dark", 1366, 820, "dark"), ("narrow", 390, 844, "light"),
                                        ("narrow-dark", 390, 844, "dark")):
        browser.post("/goog/cdp/execute", cmd="Emulation.setEmulatedMedia",
                     params={"features": [{"name": "prefers-color-scheme", "value": scheme}]})
        browser.post("/goog/cdp/execute", cmd="Emulation.setDeviceMetricsOverride",
                     params={"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})
        page.settle()
        time.sleep(0.3)
        check(browser.run("return document.documentElement.scrollWidth <= innerWidth"), f"{name}: nothing is cut off")
        cut = browser.run("""return [...document.querySelectorAll('button, select, input')].filter(e => {
            const b = e.getBoundingClientRect(); return b.width > 0 && (b.left < 0 || b.right > innerWidth); }).length""")
        check(cut == 0, f"{name}: {cut} controls reach beyond the side")
        tops = browser.run("return [...document.querySelector('nav').children].map(e => e.getBoundingClientRect().top)")
        check(len(set(tops)) == 1, f"{name}: what changes the view is one row")
        check(browser.run("return document.querySelector('#picture').clientHeight") > 200, f"{name}: the picture has room")
        page.screenshot(os.path.join(page.folder, name + ".png"))
        if width < 500:
            page.changes(lambda: page.drag(60, 30), "it can be turned there, too")
            page.changes(lambda: browser.run(SET_VALUE, "#views", "Top"), "there are standard views without keys")
            page.changes(lambda: page.click("#home"), "and the scene's own view")
    browser.post("/goog/cdp/execute", cmd="Emulation.clearDeviceMetricsOverride", params={})


def main():
    burin, folder = sys.argv[1:3]
    os.makedirs(folder, exist_ok=True)
    scratch = tempfile.mkdtemp()
    browser = server = None
    try:
        scene = os.path.join(scratch, "scene.toml")
        with open(scene, "w") as file:
            file.write(SCENE)
        test_signal_at_once(burin, scene)
        test_many_connections(burin, scene)
        server, url = start(burin, scene)
        browser = Browser(scratch, 1366, 820)
        browser.post("/goog/cdp/execute", cmd="Browser.setDownloadBehavior",
                     params={"behavior": "allow", "downloadPath": folder})
        page = Page(browser, folder)
        page.open(url)
        page.screenshot(os.path.join(folder, "view.png"))
        test_view(page)
        test_explain(page)
        test_looks(page)
        test_explain(page)
        test_sheet(page)
        test_files(page, burin)
        test_address(page)
        test_sizes(page)
        messages = [m for m in browser.console() if m["level"] in ("SEVERE", "WARNING")]
        check(not messages, f"the console is clean: {messages}")
        server.send_signal(signal.SIGTERM)
        began = time.time()
        check(server.wait(timeout=10) == 0, "SIGTERM ends it with 0, with the page open")
        print(f"ended {1000 * (time.time() - began):.0f} ms after SIGTERM")
        browser.wait_until(STATE.format("gone"), "the page says so")
        test_two_pages(browser, burin, scene, folder)
        test_connection(page, burin, scene)
        test_rolled_camera(page, burin, scratch)
        print("burin view works in", browser.run("return navigator.userAgent"))
    finally:
        if browser:
            browser.close()
        if server and server.poll() is None:
            server.kill()
        shutil.rmtree(scratch, ignore_errors=True)


if __name__ == "__main__":
    main()
