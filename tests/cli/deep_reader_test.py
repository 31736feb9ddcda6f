"""What programs that others wrote make of Burin's deep files: OpenImageIO reads samples and flattens them, exrheader
reads the header. Names are read by a decoder of this test's own.

    deep_reader_test.py BURIN SCENES
"""
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy as np
import OpenImageIO as oiio

BURIN, SCENES = sys.argv[1], pathlib.Path(sys.argv[2])
WIDTH, HEIGHT = 120, 90
CLASSES = ["silhouette", "border", "crease", "intersection", "object", "material", "polygon", "mark"]

GLASS = """
[camera]
eye = [3, 2, 6]
target = [0, 0.4, 0]
fov = 30
[[material]]
name = "glass \\"blue\\""
color = "#3050ff"
opacity = 0.4
[[material]]
name = "clay"
color = "#c8765a"
[[object]]
name = "pane"
shape = "box"
size = [1.6, 1.2, 0.1]
translate = [0.2, 0.5, 1.2]
rotate = [0, 12, 0]
material = "glass \\"blue\\""
[[object]]
name = "größe"
shape = "box"
size = [1, 1, 1]
translate = [0, 0.5, 0]
rotate = [0, 30, 0]
material = "clay"
[[object]]
name = "ball"
shape = "sphere"
radius = 0.5
translate = [-1, 0.5, 0.6]
material = "clay"
[surfaces]
shading = "lambert"
"""


def run(*command, fails=False):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    assert (done.returncode != 0) == fails, (command, done.stdout, done.stderr)
    return done.stdout + done.stderr


def render(scene, *options):
    run(BURIN, "render", scene, "-q", "-r", f"{WIDTH}x{HEIGHT}", *options)


def flat(path):
    file = oiio.ImageInput.open(str(path))
    assert file, oiio.geterror()
    spec = file.spec()
    pixels = file.read_image("float")
    names = spec.channelnames
    file.close()
    return {name: pixels[..., c] for c, name in enumerate(names)}


class Deep:
    """All samples of a file, pixel by pixel: arrays by channel."""

    def __init__(self, path):
        file = oiio.ImageInput.open(str(path))
        assert file, oiio.geterror()
        spec = file.spec()
        assert spec.deep and spec.getattribute("openexr:deepImageState") in (None, 3)
        self.names = list(spec.channelnames)
        data = file.read_native_deep_image()
        self.counts = np.array([data.samples(i) for i in range(data.pixels)])
        get = {c: data.deep_value_uint if n.endswith("id") or n == "qi" else data.deep_value
               for c, n in enumerate(self.names)}
        self.pixels = [{n: np.array([get[c](i, c, s) for s in range(self.counts[i])]) for c, n in enumerate(self.names)}
                       for i in np.nonzero(self.counts)[0]]
        self.places = np.nonzero(self.counts)[0]
        file.close()

    def sum_up(self, chosen=lambda p: np.ones(len(p["A"]), bool), value=lambda p: 1.0, drop=False):
        """What is seen of chosen samples; `drop`: the others are not there."""
        total = np.zeros((HEIGHT * WIDTH,) + np.shape(value(self.pixels[0]))[1:])
        for place, p in zip(self.places, self.pixels):
            take = chosen(p)
            alpha = np.where(take, p["A"], 0) if drop else p["A"]
            left = np.concatenate([[1.0], np.cumprod(1 - alpha)[:-1]])
            total[place] = np.sum(np.where(take, value(p) * left, 0))
        return total.reshape(HEIGHT, WIDTH)


    def mattes_of_objects(self):
        """What is seen of each object, in one go: by the numbers of their names."""
        mattes = {}
        for place, p in zip(self.places, self.pixels):
            left = np.concatenate([[1.0], np.cumprod(1 - p["A"])[:-1]])
            for number, share in zip(p["objectid"].tolist(), p["A"] * left):
                mattes.setdefault(number, np.zeros(HEIGHT * WIDTH))[place] += share
        return {number: matte.reshape(HEIGHT, WIDTH) for number, matte in mattes.items()}


def murmur(name):
    data, mask = name.encode(), 0xFFFFFFFF
    h = 0
    rot = lambda v, n: (v << n | v >> 32 - n) & mask
    mix = lambda k: rot(k * 0xCC9E2D51 & mask, 15) * 0x1B873593 & mask
    whole = len(data) // 4 * 4
    for i in range(0, whole, 4):
        h = (rot(h ^ mix(struct.unpack("<I", data[i:i + 4])[0]), 13) * 5 + 0xE6546B64) & mask
    if data[whole:]:
        h ^= mix(int.from_bytes(data[whole:], "little"))
    h ^= len(data)
    h = (h ^ h >> 16) * 0x85EBCA6B & mask
    h = (h ^ h >> 13) * 0xC2B2AE35 & mask
    return h ^ h >> 16


def manifest_of(path):
    """Names by channel, decoded as the file's documentation has it."""
    data = path.read_bytes()
    at = data.index(b"idManifest\0idmanifest\0") + len(b"idManifest\0idmanifest\0")
    size, = struct.unpack_from("<i", data, at)
    value = data[at + 4:at + 4 + size]
    behind = data[at + 4 + size:]
    assert behind.startswith(b"idManifestNote\0string\0"), behind[:40]
    raw = zlib.decompress(value[8:])
    assert struct.unpack("<Q", value[:8])[0] == len(raw)
    place = 0

    def number(form):
        nonlocal place
        value, = struct.unpack_from(form, raw, place)
        place += struct.calcsize(form)
        return value

    def varint():
        nonlocal place
        value, shift = 0, 0
        while True:
            byte = raw[place]
            place += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def text(length):
        nonlocal place
        place += length
        return raw[place - length:place]

    assert number("<i") == 0
    lengths = [varint() for _ in range(number("<i"))]
    names = []
    for i, length in enumerate(lengths):
        body = text(length)
        if i == 0:
            names.append(body)
        elif len(names[-1]) > 255:
            names.append(names[-1][:body[0] << 8 | body[1]] + body[2:])
        else:
            names.append(names[-1][:body[0]] + body[1:])
    assert names == sorted(names)
    assert (number("<i"), number("<i"), number("<i")) == (1, 0, len(names) - 1)
    found = {}
    for _ in range(number("<i")):
        assert number("<i") == 1
        channel = text(varint()).decode()
        assert number("<i") == 1
        component = text(varint()).decode()
        assert number("<b") == 2
        assert text(number("<i")) == b"MurmurHash3_32" and text(number("<i")) == b"id"
        assert number("<b") == 2
        ids, last = {}, 0
        for _ in range(number("<i")):
            last += varint()
            ids[last] = names[varint()].decode()
        found[channel] = (component, ids)
    assert place == len(raw)
    return found


# What docs/pipeline/deep.md says of each, where more than one rounding of half precision meets.
FLAT_BOUND, MATTE_BOUND = 2**-11, 3 * 2**-12


def check(folder, scene, options, hidden="none", is_float=False, has_glass=False, flat_bound=2**-11,
          matte_bound=2.3e-4):
    is_filtered = any("filter" in option for option in options)
    more = ["--set", "deep.float=true"] if is_float else []
    render(scene, "-o", folder / "flat.exr", "--deep", folder / "deep.exr", "--layers",
           "beauty,lines,coverage,surface,Z,CryptoObject", "--hidden", hidden, "--set", "crypto.ranks=16", *options, *more)
    render(scene, "-o", folder / "plain.exr", "--layers", "beauty", "--hidden", "none", *options, *more)
    pixels, deep = flat(folder / "flat.exr"), Deep(folder / "deep.exr")
    beauty = flat(folder / "plain.exr")
    what = (scene, options, hidden, is_float)
    assert deep.names == ["R", "G", "B", "A", "Z", "lineid", "materialid", "objectid", "qi"] or sorted(
        deep.names) == sorted(["R", "G", "B", "A", "Z", "lineid", "materialid", "objectid", "qi"]), deep.names

    manifest = manifest_of(folder / "deep.exr")
    assert {c: m[0] for c, m in manifest.items()} == {
        "lineid": "line class", "materialid": "material", "objectid": "object"}
    for channel, (_, names) in manifest.items():
        assert all(murmur(name) == number for number, name in names.items())
        seen = set(np.concatenate([p[channel] for p in deep.pixels]).tolist()) - {0}
        assert seen <= set(names), (what, channel, seen)

    for p in deep.pixels:
        assert np.isfinite(p["Z"]).all() and (p["Z"] > 0).all() and (np.diff(p["Z"]) > 0).all(), (what, p)
        for c in "RGBA":
            assert np.isfinite(p[c]).all() and (p[c] >= 0).all(), (what, p)
        assert (p["A"] <= 1).all(), (what, p)

    worst = {}
    for c in "RGBA":
        worst[c] = np.abs(deep.sum_up(value=lambda p: p[c]) - beauty[c]).max()
        assert worst[c] <= flat_bound, (what, c, worst)
    run("oiiotool", folder / "deep.exr", "--flatten", "-o", folder / "by_oiio.exr")
    by_oiio = flat(folder / "by_oiio.exr")
    for c in "RGBA":
        difference = np.abs(by_oiio[c] - beauty[c]).max()
        assert difference <= flat_bound, (what, "oiiotool", c, difference)

    names = {name: number for number, name in manifest["lineid"][1].items()}
    for channel in [n for n in pixels if n.startswith("coverage.")]:
        number = names[channel[9:]]
        matte = deep.sum_up(lambda p: (p["lineid"] == number) & (p["qi"] == 0), lambda p: p["A"])
        difference = np.abs(matte - pixels[channel]).max()
        worst[channel] = difference
        assert difference <= matte_bound, (what, channel, difference)
    if not has_glass:
        for c in "RGBA":
            difference = np.abs(deep.sum_up(lambda p: p["lineid"] == 0, lambda p: p[c], drop=True) -
                                pixels["surface." + c]).max()
            worst["surface." + c] = difference
            assert difference <= 2.5e-4, (what, "surface", c, difference)
    if hidden == "none":
        mattes = deep.mattes_of_objects()
        for number, name in manifest["objectid"][1].items():
            # Cryptomatte's numbers are floats, none of them infinite or nearly 0.
            as_float = number ^ 1 << 23 if number >> 23 & 255 in (0, 255) else number
            total = np.zeros((HEIGHT, WIDTH))
            for level in range(8):
                for ids, shares in ("RG", "BA"):
                    crypto = pixels[f"CryptoObject{level:02}.{ids}"].view(np.uint32)
                    total += np.where(crypto == as_float, pixels[f"CryptoObject{level:02}.{shares}"], 0)
            difference = np.abs(mattes.get(number, 0) - total).max()
            assert difference <= (5e-3 if is_filtered else 1e-3), (what, name, difference)
        assert all((p["qi"] == 0).all() for p in deep.pixels), what
    print(f"{pathlib.Path(scene).name} {' '.join(options)} {hidden}: {deep.counts.sum()} samples, off by "
          f"{max(worst.values()):.6f}")
    return deep, pixels


def check_numbers_of_page(page):
    """The table of classes, and the function that tells the number of any name."""
    text = page.read_text(encoding="utf-8")
    for name in CLASSES:
        assert f"| `{name}` | {murmur(name)} |" in text, name
    told = {}
    function = text.split("```python\n")[1].split("```")[0]
    assert function in (page.parent / "examples/take_away.py").read_text(encoding="utf-8")
    exec(function, told)
    for name in CLASSES + ["", "a", "ab", "abc", "größe", 'glass "blue"', "abcdefgh"]:
        assert told["number_of"](name) == murmur(name), name


def main():
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        still, cube = SCENES / "still_life.toml", SCENES / "cube.toml"
        glass = folder / "glass.toml"
        glass.write_text(GLASS, encoding="utf-8")
        check(folder, still, [])
        check(folder, still, ["--set", 'surfaces.shading="lambert"', "-w", "2.5"], is_float=True)
        check(folder, still, ["-w", "0.4"])
        # What the film has of two classes may sum up to more than 1 there: one of them is off by what rounding adds.
        check(folder, still, ["--set", 'lines.filter="mitchell"'], matte_bound=2**-12)
        check(folder, still, ["--style", "technical"])
        check(folder, still, ["--ortho", "4", "--compression", "rle"])
        check(folder, cube, ["--samples", "4", "--compression", "none"])
        # Many strokes in a pixel, of colours of their own: more roundings meet there.
        engine, many = SCENES / "engine.toml", {"flat_bound": FLAT_BOUND, "matte_bound": MATTE_BOUND}
        check(folder, engine, ["--style", "blueprint", "--set", "surfaces.shading=none"], **many)
        check(folder, SCENES / "flange.toml", ["--style", "pencil"], **many)
        check(folder, engine, ["-w", "4", "--set", 'lines.filter="gaussian"', "--color", "#e08040"], **many)
        # A filter tells where in a pixel each stroke lies, and so do mattes of strokes that cross in one.
        for sheet in "technical", "pencil":
            check(folder, SCENES / "crossing.toml", ["--style", sheet, "--set", 'lines.filter="gaussian"'], **many)
        check_numbers_of_page(SCENES.parent / "docs/pipeline/deep.md")
        check(folder, glass, [], has_glass=True)
        check(folder, glass, ["--style", "technical"], has_glass=True)

        deep, pixels = check(folder, still, [], "solid")
        behind = deep.sum_up(lambda p: (p["lineid"] != 0) & (p["qi"] > 0), lambda p: p["A"], drop=True)
        assert (behind > 0.5).any()
        for p in deep.pixels:  # behind all that is seen, which leaves nothing of them
            hidden = (p["lineid"] != 0) & (p["qi"] > 0)
            if hidden.any():
                first = np.argmax(hidden)
                assert hidden[first:].all() and p["A"][first - 1] == 1, p
        render(still, "-o", folder / "flat.exr", "--layers", "lines_hidden,surface,ids", "--hidden", "solid")
        lines = flat(folder / "flat.exr")
        difference = lines["lines_hidden.A"] - behind
        assert difference.min() >= -5e-4, difference.min()
        # Lines behind a part of the pixel only are left out, so all are there for sure where nothing but one
        # surface is seen.
        seen = np.zeros(HEIGHT * WIDTH)
        seen[deep.places] = [(p["qi"] == 0).sum() for p in deep.pixels]
        alone = (behind > 0) & (seen.reshape(HEIGHT, WIDTH) == 1)
        assert alone.sum() > 100 and np.abs(difference[alone]).max() <= 5e-4, (alone.sum(), difference[alone].max())
        render(still, "--deep", folder / "deep.exr", "--hidden", "solid", "--set", 'deep.hidden="none"')
        assert not (Deep(folder / "deep.exr").sum_up(lambda p: p["qi"] > 0, lambda p: p["A"], drop=True) > 0).any()

        # Blurred lines that leave nothing of a surface leave no hole where they are taken away.
        blur = ["--lens", "0.02", "--blur-samples", "4", "-w", "12"]
        render(still, "-o", folder / "flat.exr", "--deep", folder / "deep.exr", "--layers", "beauty,lines,surface", *blur)
        deep, pixels = Deep(folder / "deep.exr"), flat(folder / "flat.exr")
        taken_away = deep.sum_up(lambda p: p["lineid"] == 0, lambda p: p["A"], drop=True)
        covered = (pixels["surface.A"] == 1) & (pixels["lines.A"] == 1)
        assert covered.sum() > 100 and taken_away[covered].min() > 0.999, (covered.sum(), taken_away[covered].min())
        assert taken_away[pixels["surface.A"] == 1].min() > 0.9

        header = run("exrheader", folder / "deep.exr")
        assert re.search(r'type \(type string\): "deepscanline"', header), header
        assert "chunkCount" in header and "imageCounter" not in header and "worldToNDC" in header, header
        run("exrinfo", folder / "deep.exr")
    print("OK")


main()
