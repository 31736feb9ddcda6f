"""What programs that others wrote read of Burin's EXR files: OpenEXR's exrheader and exrinfo, OpenImageIO's oiiotool.

    exr_reader_test.py BURIN SCENES
"""
import pathlib
import subprocess
import sys
import tempfile

import numpy as np
import OpenImageIO as oiio

BURIN, SCENES = sys.argv[1], pathlib.Path(sys.argv[2])
LAYERS = "beauty,lines,Z,N,ids,coverage,surface,lines_hidden,line,motion,crypto"


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    assert done.returncode == 0, (command, done.stdout, done.stderr)
    return done.stdout


def render(folder, name, *options, scene="still_life.toml"):
    path = pathlib.Path(folder) / name
    run(BURIN, "render", SCENES / scene, "-o", path, "-q", "-r", "160x120", *options)
    return path


def channels(path):
    """All channels as OpenImageIO reads them, by name, whatever their parts."""
    file = oiio.ImageInput.open(str(path))
    assert file, oiio.geterror()
    found = {}
    part = 0
    while file.seek_subimage(part, 0):
        spec = file.spec()
        kinds = list(spec.channelformats) or [spec.format] * spec.nchannels
        for c, name in enumerate(spec.channelnames):
            kind = "uint" if str(kinds[c]) == "uint" else "float"
            found[name] = np.array(file.read_image(part, 0, c, c + 1, kind))
        part += 1
    file.close()
    return found


def check_equal(a, b):
    """All channels, to the bit: names of Cryptomatte may be numbers that are no numbers."""
    assert sorted(a) == sorted(b), sorted(set(a) ^ set(b))
    for name in a:
        assert a[name].tobytes() == b[name].tobytes(), name


def main():
    with tempfile.TemporaryDirectory() as folder:
        flat = render(folder, "flat.exr", "--layers", LAYERS, "--hidden", "solid")
        parts = render(folder, "parts.exr", "--layers", LAYERS, "--hidden", "solid", "--parts")
        assert "chunk" not in subprocess.run(["exrinfo", "-s", str(parts)], capture_output=True, text=True).stderr
        header = run("exrheader", parts)
        order = [line.split('"')[1] for line in header.splitlines() if line.startswith("name (type string)")]
        assert order == ["rgba", "lines", "lines_hidden", "coverage", "surface", "depth", "N", "id", "line", "motion",
                         "CryptoObject", "CryptoMaterial", "CryptoLine", "CryptoLineObject"], order
        pixels = channels(flat)
        assert len(pixels) > 60
        check_equal(pixels, channels(parts))
        for compression in ("zips", "rle", "none"):
            for more in ([], ["--parts"]):
                other = render(folder, "other.exr", "--layers", LAYERS, "--hidden", "solid", "--compression",
                               compression, *more)
                run("exrinfo", other)
                check_equal(pixels, channels(other))
        named = render(folder, "named.exr", "--layers", LAYERS, "--channel-names", "blender")
        names = list(channels(named))
        assert len(names) == len(pixels) and all(len(n.rsplit(".", 1)[-1]) == 1 for n in names), names
        assert all(len(n) < 32 for n in names), names
        wide = render(folder, "wide.exr", "--overscan", "20")
        text = run("exrheader", wide)
        assert "dataWindow (type box2i): (-20 -20) - (179 139)" in text, text
        assert "displayWindow (type box2i): (0 0) - (159 119)" in text, text
    print("OK")


main()
