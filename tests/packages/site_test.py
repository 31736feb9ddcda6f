"""The site of docs/: it is made without a complaint, links lead somewhere, nothing comes from other hosts, all pages are
in its list, and its reference has all of the library's interface.

    site_test.py SOURCE_FOLDER
"""

import os
import re
import subprocess
import sys
import tempfile
from html.parser import HTMLParser
from urllib.parse import unquote, urlparse

SOURCE = sys.argv[1]
failures = []


def expect(is_so: bool, message: str) -> None:
    if not is_so:
        failures.append(message)


class Page(HTMLParser):
    def __init__(self, path: str):
        super().__init__()
        self.links, self.assets, self.ids, self.text = [], [], set(), []
        with open(path, encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attributes):
        a = dict(attributes)
        if "id" in a:
            self.ids.add(a["id"])
        if tag == "a" and "href" in a:
            self.links.append(a["href"])
        elif tag in ("script", "img", "iframe", "source") and "src" in a:
            self.assets.append(a["src"])
        elif tag == "link" and "href" in a:
            self.assets.append(a["href"])

    def handle_data(self, data):
        self.text.append(data)


def read(*parts: str) -> str:
    with open(os.path.join(*parts), encoding="utf-8") as file:
        return file.read()


def check_links(site: str, pages: dict[str, Page]) -> int:
    count = 0
    for name, page in pages.items():
        for link in page.links + page.assets:
            url = urlparse(link)
            if url.scheme or url.netloc:
                expect(link not in page.assets, f"{name}: {link} comes from another host")
                continue
            path = unquote(url.path)
            base = "" if path.startswith("/") else os.path.dirname(name)  # the page for errors is shown at any path
            target = os.path.normpath(os.path.join(base, path.lstrip("/"))) if path else name
            expect(os.path.isfile(os.path.join(site, target)), f"{name}: {link} leads nowhere")
            if url.fragment and target in pages:
                expect(unquote(url.fragment) in pages[target].ids, f"{name}: {link}: there is no such heading")
            count += 1
    return count


def check_reference(page: Page, html: str) -> int:
    """The names are read here by another way than the page is made."""
    header = re.sub(r"/\*.*?\*/", "", read(SOURCE, "burin", "burin.h"), flags=re.S)
    functions = re.findall(r"^BURIN_API[^;]*?\b(burin_\w+)\(", header, re.M)
    types = re.findall(r"^typedef struct (burin_\w+)|^enum (burin_\w+)|^typedef \w+ \(\*(burin_\w+)\)", header, re.M)
    constants = re.findall(r"^\s*(BURIN_\w+) = ", header, re.M) + ["BURIN_ABI"]
    names = functions + ["".join(t) for t in types] + constants
    expect(len(functions) > 35, "burin.h declares too little")
    for name in names:
        expect(name in page.ids, f"api.html has no {name}")
    for name in functions:
        # Behind the declaration comes what the header says of it, before the next heading.
        after = html[html.index(f'id="{name}"'):]
        after = after[after.index("</pre>"):]
        end = after.find("<h")
        expect(len(re.sub(r"<[^>]*>", "", after[:end])) > 15, f"api.html says nothing of {name}")
    classes = re.findall(r"^(?:class|struct) (\w+)", read(SOURCE, "burin", "error.hpp") + read(SOURCE, "burin", "burin.hpp"), re.M)
    expect(len(classes) > 8, "burin.hpp declares too little")
    for name in classes:
        expect(f"burin::{name}" in page.ids, f"api.html has no burin::{name}")
    for field in ("pixel_aspect", "corner_uv", "for_paths"):
        expect(html.count(field) >= 2, f"api.html does not explain the field {field}")
    return len(names)


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        site = os.path.join(folder, "site")
        made = subprocess.run([os.path.join(SOURCE, "scripts", "docs"), site], capture_output=True, text=True)
        if made.returncode != 0:
            sys.exit(f"site_test: scripts/docs: {made.stdout}{made.stderr}")
        expect(made.stdout + made.stderr == "", "scripts/docs complains: " + made.stdout + made.stderr)
        paths = [os.path.relpath(os.path.join(f, n), site) for f, _, names in os.walk(site) for n in names]
        pages = {p: Page(os.path.join(site, p)) for p in paths if p.endswith(".html")}
        links = check_links(site, pages)
        for style in (p for p in paths if p.endswith(".css")):
            expect("url(http" not in read(site, style) and "@import" not in read(site, style), f"{style}: another host")
        names = check_reference(pages["api.html"], read(site, "api.html"))
        listed = {os.path.normpath(link) for link in pages["index.html"].links}
        for where, _, files in os.walk(os.path.join(SOURCE, "docs")):
            for file in files:
                page = os.path.relpath(os.path.join(where, file), os.path.join(SOURCE, "docs"))
                if file.endswith(".md") and not page.startswith("decisions/"):
                    expect(page.removesuffix(".md") + ".html" in listed, f"mkdocs.yml does not list {page}")
        # Markdown that was not read as such.
        for name, page in pages.items():
            for text in page.text:
                expect(not re.search(r"^\s*(\| .* \||- \S.*\n- )", text) or "pre" in name, f"{name}: not read: {text[:60]!r}")
        expect(len(pages) > 60 and links > 2000, f"only {len(pages)} pages with {links} links")
    for failure in failures:
        print("site_test:", failure)
    print(f"site_test: {len(pages)} pages, {links} links, {names} names of the library, {len(failures)} failures")
    sys.exit(1 if failures else 0)


main()
