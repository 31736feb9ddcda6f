"""The eight lines of docs/shading/lines-files.md read what `burin render --save-lines` writes.

usage: numpy_test.py PROGRAM SOURCE_FOLDER WORK_FOLDER
"""
import os
import re
import subprocess
import sys

import numpy as np


def main():
    program, source, work = sys.argv[1:]
    os.makedirs(work, exist_ok=True)
    os.chdir(work)
    scene = os.path.join(source, "scenes", "still_life.toml")
    subprocess.run([program, "render", scene, "-r", "160x120", "--style", "technical", "--save-lines", "engine.lines",
                    "-o", "engine.png", "-q"], check=True)
    page = open(os.path.join(source, "docs", "shading", "lines-files.md"), encoding="utf-8").read()
    code = re.search(r"```python\n(.*?)```", page, re.S).group(1)
    assert len(code.strip().split("\n")) <= 8, "the page says eight lines"
    names = {}
    exec(code, names)
    arrays = names["arrays"]
    xy, qi, classes = arrays["xy"], arrays["qi"], arrays["classes"]
    assert len(xy) == 2 * len(qi) == 2 * len(classes) > 100, (xy.shape, qi.shape, classes.shape)
    assert np.isfinite(xy).all()
    assert (qi == 0).any() and (qi > 0).any(), "technical has hidden lines, too"
    # Most lines lie within the picture, and none far from it.
    assert (xy > -64).all() and (xy[:, 0] < 160 + 64).all() and (xy[:, 1] < 120 + 64).all()
    lengths = np.hypot(*(xy[1::2] - xy[::2]).T)
    assert 500 < lengths.sum() < 50000, lengths.sum()


main()
