#!/usr/bin/env python3
"""Manual pages say what a command does.

    man_pages_test.py BURIN MAN_PAGES
"""
import os
import re
import subprocess
import sys
import tempfile


def section(page, name):
    return page.split(f".SH {name}\n", 1)[1].split("\n.SH ", 1)[0] if f".SH {name}\n" in page else ""


def statuses(page):
    return dict(re.findall(r"\.TP\n\.B (\d+)\n(.*)", section(page, "EXIT STATUS")))


def main():
    burin, man_pages = sys.argv[1:3]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, man_pages, burin, folder], check=True)
        pages = {}
        for name in os.listdir(folder):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                pages[name] = file.read()
    assert len(pages) > 8 and "burin-view.1" in pages, sorted(pages)
    for name, page in pages.items():
        assert list(statuses(page)) == ["0", "1", "2", "130"], name
        assert bool(section(page, "KEYS AND MOUSE")) == (name == "burin-view.1"), name
    # A command that only a signal ends has done all that it was asked for then.
    assert "Ctrl" in statuses(pages["burin-view.1"])["0"]
    assert "before" in statuses(pages["burin-view.1"])["130"]
    assert "Interrupted." in statuses(pages["burin-render.1"])["130"]
    keys = section(pages["burin-view.1"], "KEYS AND MOUSE")
    for key, meaning in (("F", "fit to view"), ("drag", "turn"), ("Home", "own view")):
        assert re.search(rf"\.TP\n\.B {key}\n.*{meaning}", keys), keys
    print(f"{len(pages)} manual pages")


if __name__ == "__main__":
    main()
