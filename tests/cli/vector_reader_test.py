#!/usr/bin/env python3
"""SVG files as other programs read them: vector_reader_test.py BURIN SCENES

An XML parser reads them, ids are unique, and what rsvg-convert draws of them, with four times as many pixels, has the
coverage of Burin's own pixels. Without rsvg-convert that last part is left out.
"""
import math
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import xml.etree.ElementTree
import zlib

WIDTH, HEIGHT, TIMES = 200, 150, 4


def pixels_of(path):
    """The first channel of an 8-bit PNG, row by row."""
    data = path.read_bytes()
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        part = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", part[:10])
            assert depth == 8, "not 8 bits"
        if kind == b"IDAT":
            packed += part
        at += 12 + size
    step = {0: 1, 2: 3, 4: 2, 6: 4}[color]
    raw, rows, before = zlib.decompress(packed), [], bytearray(width * step)
    for y in range(height):
        begin = y * (width * step + 1)
        kind, row = raw[begin], bytearray(raw[begin + 1:begin + 1 + width * step])
        for i in range(len(row) if kind else 0):
            a = row[i - step] if i >= step else 0
            b = before[i]
            c = before[i - step] if i >= step else 0
            if kind == 1:
                row[i] = (row[i] + a) & 255
            elif kind == 2:
                row[i] = (row[i] + b) & 255
            elif kind == 3:
                row[i] = (row[i] + (a + b) // 2) & 255
            else:
                p, q, r = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                row[i] = (row[i] + (a if p <= q and p <= r else b if q <= r else c)) & 255
        rows.append(row[::step])
        before = row
    return rows


def linear(code):
    v = code / 255
    return v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4


def compare(folder, is_colored):
    subprocess.run(["rsvg-convert", "-w", str(TIMES * WIDTH), folder / "a.svg", "-o", folder / "fine.png"], check=True)
    fine, own = pixels_of(folder / "fine.png"), pixels_of(folder / "a.png")
    linears = [linear(c) for c in range(256)]
    shown = linears if is_colored else [c / 255 for c in range(256)]  # black on white: coverage
    squares, lines = [], 0
    for y in range(HEIGHT):
        block = fine[TIMES * y:TIMES * y + TIMES]
        for x in range(WIDTH):
            mean = sum(shown[c] for row in block for c in row[TIMES * x:TIMES * x + TIMES]) / (TIMES * TIMES)
            off = mean - linears[own[y][x]]
            if mean < 1 or own[y][x] < 255:
                squares.append(off * off)
    squares.sort()
    kept = squares[:len(squares) - len(squares) // 50]
    assert len(kept) > 500, "hardly any line"
    return 10 * math.log10(len(kept) / sum(kept))


def main():
    program, scenes = sys.argv[1], pathlib.Path(sys.argv[2])
    for scene, options, least_db in (
            ("flange", [], 39),
            ("teapot", [], 40),
            ("star", ["-w", "2"], 38),
            ("cube", ["--style", "patent"], 30),
            ("shaded", ["--set", "surfaces.shadows=false"], 34)):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            for name in ("a.svg", "a.png"):
                subprocess.run([program, "render", scenes / f"{scene}.toml", "-o", folder / name, "-q", "-r",
                                f"{WIDTH}x{HEIGHT}", "--background", "#ffffff", *options], check=True)
            root = xml.etree.ElementTree.parse(folder / "a.svg").getroot()
            ids = [e.get("id") for e in root.iter() if e.get("id")]
            assert len(ids) == len(set(ids)), f"{scene}: an id twice"
            assert root.findall(".//{http://www.w3.org/2000/svg}path"), f"{scene}: no path"
            if shutil.which("rsvg-convert") is None:
                print(f"{scene}: read; rsvg-convert is not installed")
                continue
            db = compare(folder, scene == "shaded")
            print(f"{scene}: PSNR98 {db:.1f} dB")
            assert db >= least_db, f"{scene}: {db:.1f} dB"


if __name__ == "__main__":
    main()
