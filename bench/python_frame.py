#!/usr/bin/env python3
"""What the Python package takes from arrays to pixels, beside the program's way from a file to a PNG.

    python_frame.py BURIN [MODEL.ply]     MODEL: what meshio reads; none: a torus of a million triangles

CPU seconds at 1920x1080 with one thread, the least of some runs, each of both in turn. Prints a JSON object.
"""

import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

import burin

RUNS = 9
SIZE = (1920, 1080)


def torus(m=1000, n=504):
    u, v = np.meshgrid(np.arange(m) * 2 * np.pi / m, np.arange(n) * 2 * np.pi / n, indexing="ij")
    radius = 1 + 0.4 * np.cos(v)
    points = np.stack([radius * np.cos(u), 0.4 * np.sin(v), radius * np.sin(u)], -1).reshape(-1, 3)
    i, k = np.meshgrid(np.arange(m), np.arange(n), indexing="ij")
    i1, k1 = (i + 1) % m, (k + 1) % n
    a, b, c, d = (x.ravel() for x in (i * n + k, i * n + k1, i1 * n + k1, i1 * n + k))
    return points.astype(np.float32), np.stack([a, b, c, a, c, d], -1).reshape(-1, 3).astype(np.int32)


def write_ply(path, points, triangles):
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.zeros(len(triangles), [("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, triangles
    path.write_bytes(header.encode() + points.tobytes() + rows.tobytes())


def cpu_of_program(arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(arguments, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def main():
    program, *models = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if models:
            import meshio

            path, mesh = models[0], meshio.read(models[0])
            points, triangles = mesh.points, mesh.cells_dict["triangle"]
        else:
            path = folder / "torus.ply"
            points, triangles = torus()
            write_ply(path, points, triangles)
        view = {"threads": 1, "layers": "beauty"}

        def add():
            scene = burin.Scene()
            scene.add((points, triangles))
            return scene

        kept = add()
        kept.render(SIZE, **view)
        ways = {
            "arrays_to_pixels_s": lambda: np.asarray(add().render(SIZE, **view)),
            "add_s": add,
            "next_frame_s": lambda: kept.render(SIZE, **view),
        }
        command = [program, "render", path, "-r", "{}x{}".format(*SIZE), "-j", "1", "-q", "-o", folder / "a.png"]
        least = {"triangles": len(triangles)}
        for _ in range(RUNS):
            for key, way in ways.items():
                start = time.process_time()
                way()
                least[key] = min(least.get(key, 1e9), time.process_time() - start)
            least["program_s"] = min(least.get("program_s", 1e9), cpu_of_program(command))
        print(json.dumps({key: round(value, 4) for key, value in least.items()}))


main()
