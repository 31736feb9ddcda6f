"""The page of a running `burin view`, as tests use it."""
import os
import time

from browser import PRESS, RELEASE, at, center_of

# A text that stands for all pixels that the page shows.
PICTURE = """(() => {
  const from = document.querySelector('#picture'), to = document.createElement('canvas');
  [to.width, to.height] = [from.width, from.height];
  to.getContext('2d').drawImage(from, 0, 0);
  return to.toDataURL();
})()"""
RESTS = "document.querySelector('#picture').dataset.rests === 'yes'"
# Where a row of the picture first has ink, on the page.
FIRST_INK = """const from = document.querySelector('#picture'), box = from.getBoundingClientRect(),
    to = document.createElement('canvas').getContext('2d'), [width, height] = [from.width, from.height];
  [to.canvas.width, to.canvas.height] = [width, height];
  to.drawImage(from, 0, 0);
  const y = Math.floor(height / 2), row = to.getImageData(0, y, width, 1).data;
  for (let x = 0; x < width; ++x) if (row[4 * x] < 128) return [box.left + x + .5, box.top + y + .5];"""
STATE = "document.body.dataset.connection === '{}' && !document.querySelector('#state').hidden"
IS_WELL = "document.body.dataset.connection === 'open' && document.querySelector('#state').hidden"
SET_VALUE = "const e = document.querySelector(arguments[0]); e.value = arguments[1];" \
            "e.dispatchEvent(new Event(e.type === 'range' ? 'input' : 'change', {bubbles: true}))"


class Page:
    """The page of a running `burin view`."""

    def __init__(self, browser, folder):
        self.browser = browser
        self.folder = folder

    def open(self, url):
        self.browser.post("/url", url=url)
        self.browser.wait_until("document.body.dataset.ready === 'yes'", "the page begins")
        self.settle()

    def settle(self):
        """Waits until nothing moves and the picture is in full quality."""
        time.sleep(0.3)  # what was done just now has reached the page
        self.browser.wait_until(RESTS, "the picture comes to rest")

    def picture(self):
        self.settle()
        return self.browser.run("return " + PICTURE)

    def changes(self, act, what):
        before = self.picture()
        act()
        self.browser.wait_until(f"{PICTURE} !== arguments[0]", what, before)
        self.settle()

    def drag(self, dx, dy, button=0):
        start = center_of(self.browser, "#picture")
        steps = [at(start), {"type": "pointerDown", "button": button}]
        steps += [at((start[0] + dx * i / 8, start[1] + dy * i / 8)) for i in range(1, 9)]
        self.browser.mouse(*steps, {"type": "pointerUp", "button": button})

    def click(self, selector):
        self.browser.run("document.querySelector(arguments[0]).scrollIntoView({block: 'nearest'})", selector)
        self.browser.mouse(at(center_of(self.browser, selector)), PRESS, RELEASE)

    def wheel(self, amount):
        x, y = center_of(self.browser, "#picture")
        self.browser.post("/actions", actions=[{"type": "wheel", "id": "wheel", "actions": [
            {"type": "scroll", "x": round(x), "y": round(y), "deltaX": 0, "deltaY": amount, "duration": 0}]}])

    def downloaded(self, selector, name):
        path = os.path.join(self.folder, name)
        if os.path.exists(path):
            os.remove(path)
        self.click(selector)
        for _ in range(400):
            if os.path.exists(path) and os.path.getsize(path) > 0:
                time.sleep(0.1)
                with open(path, "rb") as file:
                    return file.read()
            time.sleep(0.05)
        raise AssertionError(f"{name} was never saved")

    def screenshot(self, path):
        self.browser.save(path, self.browser.send("GET", self.browser.session + "/screenshot"))
