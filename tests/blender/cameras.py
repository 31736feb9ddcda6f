"""Every kind of camera and border: what Burin covers lies where Cycles has it, to 0.02 pixels."""

import os
import sys

sys.path.insert(0, os.path.dirname(__file__))

import bpy
import numpy as np

from in_blender import add, main, new_scene, render

CAMERA = {"type": "PERSP", "lens": 40, "shift_x": 0, "shift_y": 0, "sensor_fit": "AUTO", "ortho_scale": 6,
          "sensor_width": 36, "sensor_height": 24}
RENDER = {"resolution_x": 160, "resolution_y": 90, "resolution_percentage": 100, "use_border": False,
          "use_crop_to_border": False, "border_min_x": .2, "border_max_x": .7, "border_min_y": .3, "border_max_y": .9,
          "pixel_aspect_x": 1, "pixel_aspect_y": 1}
PORTRAIT = {"resolution_x": 90, "resolution_y": 160}
CASES = {
    "perspective": {},
    "portrait": PORTRAIT,
    "fit vertical": {"sensor_fit": "VERTICAL", "sensor_height": 20},
    "fit horizontal, portrait": {"sensor_fit": "HORIZONTAL", **PORTRAIT},
    "shift x": {"shift_x": .21},
    "shift x and y": {"shift_x": -.13, "shift_y": .17},
    "shift by a part of a pixel": {"shift_x": .1004},
    "shift, fit vertical": {"shift_x": .1, "shift_y": -.05, "sensor_fit": "VERTICAL"},
    "orthographic": {"type": "ORTHO"},
    "orthographic, portrait, shift": {"type": "ORTHO", "shift_x": .1, "shift_y": -.08, **PORTRAIT},
    "percentage": {"resolution_percentage": 53},
    "border": {"use_border": True},
    "border, crop": {"use_border": True, "use_crop_to_border": True},
    "border, crop, shift": {"use_border": True, "use_crop_to_border": True, "shift_x": .2},
    "wide pixels": {"pixel_aspect_x": 2},
    "high pixels": {"pixel_aspect_y": 1.5},
}


def alpha(engine):
    """What the scene covers."""
    scene = bpy.context.scene
    scene.render.engine = engine
    pixels = render(engine)
    return pixels["ViewLayer.Combined.A"].astype(float)


def offset_between(a, b):
    """By how many pixels `a` is moved against `b`, by least squares."""
    gradient_y, gradient_x = np.gradient(b)
    moved = np.column_stack([gradient_x.ravel(), gradient_y.ravel()])
    return np.linalg.lstsq(moved, (b - a).ravel(), rcond=None)[0]


def cameras_are_as_in_cycles():
    scene = new_scene()
    add("monkey", "monkey", size=2, location=(0, 0, 1.2))
    add("cube", "cube", size=1.6, location=(2.4, 0, .8))
    add("torus", "torus", location=(-1.5, -1, .4), major_radius=.8, minor_radius=.2)
    cycles = scene.cycles
    cycles.samples, cycles.max_bounces, cycles.pixel_filter_type = 256, 0, "BOX"
    cycles.use_denoising = cycles.use_adaptive_sampling = False
    scene.burin.line_types, scene.burin.samples = set(), "8"
    for name, case in CASES.items():
        for defaults, owner in ((CAMERA, scene.camera.data), (RENDER, scene.render)):
            for key, value in defaults.items():
                setattr(owner, key, case.get(key, value))
        burin = alpha("BURIN")
        truth = alpha("CYCLES")
        assert burin.shape == truth.shape, (name, burin.shape, truth.shape)
        x, y = offset_between(burin, truth)
        error = np.sqrt(((burin - truth) ** 2).mean())
        print(f"{name}: {burin.shape} offset {x:+.4f} {y:+.4f} px, error {error:.4f}")
        assert abs(x) < 0.02 and abs(y) < 0.02 and error < 0.03, name


main([cameras_are_as_in_cycles])
