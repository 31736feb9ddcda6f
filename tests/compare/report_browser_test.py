#!/usr/bin/env python3
"""Opens the report of a comparison in a real browser and uses it: wipe, zoom, keys, switch, print.

    report_browser_test.py BURIN FOLDER    screenshots and a PDF are left in FOLDER
"""
import base64
import os
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "support"))
from browser import PRESS, RELEASE, Browser, at, center_of, check

ZOOM = "Number(document.querySelector('#viewer').dataset.zoom)"
PLACE = "Number(document.querySelector('#viewer').dataset.x)"
WIPE = "Number(document.querySelector('#wipe').getAttribute('aria-valuenow'))"
# Whether the picture right and left of the wipe is drawn: some dark pixel in each half of the canvas.
DARK = """(() => {
  const c = document.querySelector('#view'), g = c.getContext('2d');
  return [0, 1].map(half => {
    const d = g.getImageData(half * c.width >> 1, 0, c.width >> 1, c.height).data;
    let dark = 0;
    for (let i = 0; i < d.length; i += 4) dark += d[i] < 100 && d[i + 1] < 100 && d[i + 2] < 100;
    return dark;
  });
})()"""


def test_report(browser, page, folder):
    browser.post("/url", url="file://" + page)
    browser.wait_until("document.querySelector('#viewer').dataset.drawn === 'yes'", "the pictures are drawn")
    data = browser.run("return JSON.parse(document.querySelector('#data').textContent)")
    names = [m["name"] for m in data["methods"]]
    check(len(names) >= 2, "two methods to compare")
    check(all(n > 20 for n in browser.run("return " + DARK)), "lines are seen on both sides of the wipe")

    # The wipe follows the mouse, the keyboard, and stays within the picture.
    check(browser.run("return " + WIPE) == 50, "the wipe starts in the middle")
    start = center_of(browser, "#wipe")
    browser.mouse(at(start), PRESS, at((start[0] + 200, start[1])), RELEASE)
    browser.wait_until(WIPE + " > 60", "the wipe follows the mouse")
    moved = browser.run("return " + WIPE)
    browser.run("document.querySelector('#viewer').focus()")
    browser.keys(",,,")
    browser.wait_until(f"{WIPE} === {moved - 6}", "three commas move the wipe by six percent")
    browser.keys("." * 60)
    browser.wait_until(WIPE + " === 100", "the wipe stops at the border")
    browser.run("document.querySelector('#wipe').focus()")
    browser.keys("\ue012" * 25)  # left arrow
    browser.wait_until(WIPE + " === 50", "arrows move the wipe that has the focus")

    # Zoom by wheel, keys and buttons; dragging pans; all crops follow.
    fitted = browser.run("return " + ZOOM)
    crops = "[...document.querySelectorAll('#crops canvas')].map(c => c.toDataURL())"
    before = browser.run("return " + crops)
    check(len(before) == len(names) + 1, "a crop of every picture")
    middle = center_of(browser, "#viewer")
    focus, size = data["scene"]["focus"], (data["scene"]["width"], data["scene"]["height"])
    point = [m + (f - s / 2) * fitted for m, f, s in zip(middle, focus, size)]  # where lines are
    browser.post("/actions", actions=[{"type": "wheel", "id": "wheel", "actions": [
        {"type": "scroll", "x": round(point[0]), "y": round(point[1]), "deltaX": 0, "deltaY": -720, "duration": 0}]}])
    browser.wait_until(f"{ZOOM} > 7.9 * {fitted}", "the wheel zooms in")
    check(browser.run("return " + crops) != before, "the crops follow the zoom")
    zoomed = browser.run("return " + ZOOM)
    browser.run("document.querySelector('#viewer').focus()")
    browser.keys("-")
    browser.wait_until(f"Math.abs({ZOOM} / {zoomed} - .5) < .01", "minus zooms out")
    panned, x = browser.run("return " + crops), browser.run("return " + PLACE)
    browser.mouse(at(point), PRESS, at((point[0] + 20, point[1] + 10)), RELEASE)
    browser.wait_until(f"Math.abs({x} - {PLACE} - 20 / {ZOOM}) < .02", "dragging pans, one pixel per pixel")
    check(all(a != b for a, b in zip(browser.run("return " + crops), panned)), "all crops pan together")
    browser.save(os.path.join(folder, "zoomed.png"), browser.send("GET", browser.session + "/screenshot"))
    browser.keys("0")
    browser.wait_until(f"Math.abs({ZOOM} - {fitted}) < .002", "0 shows the whole picture")

    # Brackets go through the methods, D shows the difference.
    browser.run("document.querySelector('#viewer').focus()")
    right = "document.querySelector('#right').value"
    check(browser.run("return " + right) == names[0] + ".png", "the first method is on the right")
    browser.keys("]")
    browser.wait_until(f"{right} === '{names[1]}.png'", "] shows the next method")
    browser.keys("d")
    browser.wait_until(f"{right} === '{names[1]}_diff.png'", "D shows its difference")

    # The switch changes tables and curves; every method has a row in each, and no cell is odd.
    for kind in ("equal_width", "published"):
        x, y = center_of(browser, f".switch [data-row={kind}]")
        browser.run(f"document.querySelector('.switch [data-row={kind}]').click()")
        rows = browser.run(f"return [...document.querySelectorAll('table.{kind} tbody')].map(t => t.rows.length)")
        check(rows and all(n == len(names) for n in rows), "a row per method in every table")
        hidden = "published" if kind == "equal_width" else "equal_width"
        check(browser.run(f"return getComputedStyle(document.querySelector('table.{hidden}')).display") == "none",
              "only one kind of table is shown")
    cells = browser.run("return [...document.querySelectorAll('#tables td')].map(c => c.textContent)")
    check(cells and not [c for c in cells if not c or "NaN" in c or "undefined" in c or "Infinity" in c],
          "all cells have values or a dash")
    check(browser.run("return document.querySelectorAll('td.best').length") > 5, "best values are marked")
    check(browser.run("return document.querySelectorAll('#fingerprints svg .curve').length") >= 4 * len(names),
          "curves are drawn")
    paths = browser.run("return [...document.querySelectorAll('#fingerprints path')].map(p => p.getAttribute('d'))")
    check(not [p for p in paths if "NaN" in p], "curves have numbers")
    check(browser.run("return document.documentElement.scrollWidth <= window.innerWidth"), "nothing is cut off at the side")

    # Sorting by a column.
    browser.run("document.querySelector('table.published thead th:nth-child(2)').click()")
    column = browser.run("return [...document.querySelectorAll('table.published')][0].tBodies[0].rows"
                         " && [...document.querySelector('table.published tbody').rows].map(r => Number(r.cells[1].textContent))")
    check(column == sorted(column), "a click on a heading sorts")

    browser.save(os.path.join(folder, "laptop.png"), browser.send("GET", browser.session + "/screenshot"))
    pdf = browser.post("/print", orientation="landscape", background=True,
                       page={"width": 29.7, "height": 21.0}, margin={"top": 1, "bottom": 1, "left": 1, "right": 1})
    browser.save(os.path.join(folder, "report.pdf"), pdf)
    check(base64.b64decode(pdf)[:5] == b"%PDF-", "it prints")
    messages = [m for m in browser.console()
                if m["level"] in ("SEVERE", "WARNING")]
    check(not messages, f"the console is clean: {messages}")


SCENE = """
[[object]]
shape = "box"
rotate = [20, 30, 0]
[[object]]
shape = "sphere"
radius = 0.4
segments = 24
rings = 12
translate = [0.7, 0.2, 0.3]
[reference]
samples = 4
"""


def main():
    burin, folder = sys.argv[1:3]
    os.makedirs(folder, exist_ok=True)
    scratch = tempfile.mkdtemp()
    browser = None
    try:
        scene = os.path.join(scratch, "scene.toml")
        with open(scene, "w") as file:
            file.write(SCENE)
        subprocess.run([burin, "compare", scene, "-o", os.path.join(scratch, "c"), "--size", "240x180",
                        "--methods", "patel,gbuffer,simple", "--frames", "2"], check=True)
        browser = Browser(scratch, 1366, 768)
        test_report(browser, os.path.join(scratch, "c", "report.html"), folder)
        print("report.html works in", browser.run("return navigator.userAgent"))
    finally:
        if browser:
            browser.close()
        shutil.rmtree(scratch, ignore_errors=True)


if __name__ == "__main__":
    main()
