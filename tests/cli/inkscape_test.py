#!/usr/bin/env python3
"""SVG files as Inkscape opens them: inkscape_test.py BURIN SCENES

Its layers are those of the file, by their labels; it knows the size of the sheet in mm; and it draws what rsvg-convert
draws.
"""
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"
DPI = 384  # four pixels for one of the picture


def pixels_of(path):
    spec = importlib.util.spec_from_file_location("reader", pathlib.Path(__file__).with_name("vector_reader_test.py"))
    reader = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(reader)
    return reader.pixels_of(path)


def main():
    program, scenes = sys.argv[1], pathlib.Path(sys.argv[2])
    for scene, options, layers in (
            ("flange", ["--style", "technical", "--paper", "100x80mm", "-r", "378"], ["2 hidden", "1 visible"]),
            ("shaded", ["--set", "surfaces.shadows=false", "-r", "320x240"], ["surfaces", "1 visible"]),
            ("cube", ["--style", "technical", "-r", "320x240", "--group", "qi"], ["2 hidden 1", "1 visible"])):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            subprocess.run([program, "render", scenes / f"{scene}.toml", "-o", folder / "a.svg", "-q", *options],
                           check=True)
            subprocess.run(["inkscape", "a.svg", "--export-filename=own.svg"], check=True, cwd=folder,
                           stderr=subprocess.DEVNULL)
            root = xml.etree.ElementTree.parse(folder / "own.svg").getroot()
            found = [g.get(INKSCAPE + "label") for g in root.iter("{http://www.w3.org/2000/svg}g")
                     if g.get(INKSCAPE + "groupmode") == "layer"]
            assert found == layers, f"{scene}: layers {found}"
            if "--paper" in options:
                assert (root.get("width"), root.get("height")) == ("100mm", "80mm"), root.attrib
            subprocess.run(["inkscape", "a.svg", f"--export-dpi={DPI}", "--export-filename=a.png"], check=True,
                           cwd=folder, stderr=subprocess.DEVNULL)
            own = pixels_of(folder / "a.png")
            subprocess.run(["rsvg-convert", "-w", str(len(own[0])), "-h", str(len(own)), folder / "a.svg", "-o",
                            folder / "b.png"], check=True)
            other = pixels_of(folder / "b.png")
            off = sum(abs(a - b) for x, y in zip(own, other) for a, b in zip(x, y))
            ink = sum(255 - a for row in own for a in row)
            print(f"{scene}: differs from rsvg-convert by {100 * off / ink:.2f} % of its ink")
            assert 0 < ink and off < 0.04 * ink, f"{scene}: {off / ink}"


if __name__ == "__main__":
    main()
