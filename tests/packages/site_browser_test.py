"""The site in a browser: no page is wider than a phone, pictures are there, search finds, the list of pages opens.

    site_browser_test.py SOURCE_FOLDER [FOLDER_FOR_SCREENSHOTS]
"""

import functools
import http.server
import os
import subprocess
import sys
import tempfile
import threading

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from support.browser import Browser, check, center_of, at, PRESS, RELEASE  # noqa: E402


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


def pages_of(site):
    paths = [os.path.relpath(os.path.join(f, n), site) for f, _, names in os.walk(site) for n in names]
    return sorted(p for p in paths if p.endswith(".html") and not p.startswith(("404", "decisions/0")))


def look_at_all(browser, base, site):
    """Each page in a frame as wide as a phone."""
    browser.post("/url", url=base + "index.html")
    wide = browser.post("/execute/async", script="""
        const [pages, done] = arguments, frame = document.createElement("iframe"), bad = [];
        frame.style = "width: 390px; height: 800px; border: 0";
        let i = 0;
        frame.onload = () => {
            const page = frame.contentDocument;
            if (page.documentElement.scrollWidth > 390) bad.push(pages[i] + " is " + page.documentElement.scrollWidth + " wide");
            for (const image of page.images) if (!image.naturalWidth) bad.push(pages[i] + ": " + image.src);
            if (++i < pages.length) frame.src = pages[i]; else done(bad);
        };
        frame.src = pages[0];
        document.body.append(frame);""", args=[pages_of(site)])
    check(not wide, f"pages wider than a phone, or pictures that are missing: {wide}")


def search(browser, base):
    browser.post("/url", url=base + "index.html")
    browser.mouse(at(center_of(browser, "#mkdocs-search-query")), PRESS, RELEASE)
    browser.keys("dashed")
    # Keys that were pressed before the index was there count with the next one.
    browser.wait_until("(document.getElementById('mkdocs-search-query').dispatchEvent(new Event('keyup')),"
                       " document.querySelectorAll('#mkdocs-search-results h3').length > 2)", "search finds pages")
    check(browser.run("return document.querySelector('#mkdocs-search-results').checkVisibility()"), "results are shown")


def list_of_pages(browser, base):
    """Is open beside the text, and closed above it."""
    browser.post("/url", url=base + "gallery.html")
    check(browser.run("return document.getElementById('pages').open"), "the list is open where there is room")
    check(browser.run("return document.querySelector('[aria-current]').textContent") == "Gallery", "the page is marked")
    browser.post("/window/rect", width=500, height=900)
    browser.wait_until("!document.getElementById('pages').open", "the list closes where there is none")
    browser.mouse(at(center_of(browser, "#pages summary")), PRESS, RELEASE)
    browser.wait_until("document.getElementById('pages').open", "the list opens")


def main():
    source = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        site = os.path.join(folder, "site")
        subprocess.run([os.path.join(source, "scripts", "docs"), site], check=True)
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=site))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        base = f"http://127.0.0.1:{server.server_address[1]}/"
        browser = Browser(folder, 1440, 900)
        try:
            look_at_all(browser, base, site)
            search(browser, base)
            if len(sys.argv) > 2:
                for page in ("index", "start", "api", "methods"):
                    browser.post("/url", url=f"{base}{page}.html")
                    browser.save(os.path.join(sys.argv[2], page + ".png"), browser.send("GET", browser.session + "/screenshot"))
            list_of_pages(browser, base)
            errors = [entry for entry in browser.console() if entry["level"] == "SEVERE"]
            check(not errors, f"the browser complains: {errors}")
        finally:
            browser.close()
            server.shutdown()
    print("site_browser_test: all is well")


main()
