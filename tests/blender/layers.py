"""View layers, passes and the compositor: equal to what single renders give."""

import os
import sys

sys.path.insert(0, os.path.dirname(__file__))

import bpy
import numpy as np

from in_blender import add, main, new_scene, paint, render


def two_layers():
    """A scene with a view layer of all, and one without the collection `part`."""
    scene = new_scene()
    monkey = add("monkey", "monkey", size=2, location=(0, 0, 1.2))
    paint(monkey, "red", (.8, .2, .1, 1))
    part = bpy.data.collections.new("part")
    scene.collection.children.link(part)
    cube = add("cube", "cube", size=1.6, location=(2.4, 0, .8))
    paint(cube, "blue", (.1, .3, .8, 1))
    cube.pass_index, cube.data.materials[0].pass_index = 7, 5
    scene.collection.objects.unlink(cube)
    part.objects.link(cube)
    scene.burin.shading = "LAMBERT"
    first = scene.view_layers[0]
    first.name = "all"
    second = scene.view_layers.new("less")
    second.layer_collection.children["part"].exclude = True
    return scene, first, second


def all_passes(view_layer):
    view_layer.use_pass_z = view_layer.use_pass_normal = True
    view_layer.use_pass_object_index = view_layer.use_pass_material_index = True
    view_layer.use_pass_cryptomatte_object = view_layer.use_pass_cryptomatte_material = True
    view_layer.burin.use_pass_lines = view_layer.burin.use_pass_hidden = True
    view_layer.burin.use_pass_object_id = view_layer.burin.use_pass_material_id = True


def layers_are_equal_to_single_renders():
    scene, first, second = two_layers()
    both = render("both")
    for view_layer, name in ((first, "all"), (second, "less")):
        first.use = second.use = False
        view_layer.use = True
        single = render("single")
        own = {channel: values for channel, values in both.items() if channel.startswith(name + ".")}
        assert set(single) == set(own) and len(own) >= 8, (set(single), set(own))
        for channel, values in own.items():
            assert (values == single[channel]).all(), channel
        assert own[name + ".Combined.A"].max() == 1
    assert (both["all.Combined.A"] != both["less.Combined.A"]).any()


def compositor_gets_the_passes():
    """Lines of one layer over the picture of the other: equal to the sum by hand."""
    scene, first, second = two_layers()
    parts = render("parts")
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    below, above = (tree.nodes.new("CompositorNodeRLayers") for _ in range(2))
    below.layer, above.layer = "less", "all"
    over = tree.nodes.new("CompositorNodeAlphaOver")
    over.premul = 1
    composite = tree.nodes.new("CompositorNodeComposite")
    tree.links.new(below.outputs["Image"], over.inputs[1])
    tree.links.new(above.outputs["Lines"], over.inputs[2])
    tree.links.new(over.outputs[0], composite.inputs[0])
    seen = render("composited")
    alpha = parts["all.Lines.A"]
    assert alpha.max() > 0.9
    for letter in "RGBA":
        wanted = parts[f"all.Lines.{letter}"] + (1 - alpha) * parts[f"less.Combined.{letter}"]
        name = next(n for n in (f"Composite.Combined.{letter}", f"Combined.{letter}", letter) if n in seen)
        assert np.abs(seen[name] - wanted).max() < 1e-5, letter


def passes_are_what_they_say():
    scene, first, second = two_layers()
    second.use = False
    all_passes(first)
    scene.burin.hidden = "SOLID"
    pixels = render("passes")
    assert pixels["all.Depth.Z"].max() == np.float32(1e10) and 5 < pixels["all.Depth.Z"].min() < 12
    length = np.sqrt(sum(pixels[f"all.Normal.{axis}"] ** 2 for axis in "XYZ"))
    hit = pixels["all.Depth.Z"] < 1e9
    assert np.abs(length[hit] - 1).max() < 2e-3 and length[~hit].max() == 0
    # The cube stands upright: its normals are along axes.
    cube = pixels["all.IndexOB.X"] == 7
    assert cube.sum() > 100 and np.isin(pixels["all.IndexOB.X"], (0, 7)).all()
    largest = np.max([np.abs(pixels[f"all.Normal.{axis}"][cube]) for axis in "XYZ"], axis=0)
    assert largest.min() == 1, largest.min()
    assert ((pixels["all.IndexMA.X"] == 5) == cube).all()
    assert set(np.unique(pixels["all.ObjectNumber.X"])) == {0, 1, 2}
    assert set(np.unique(pixels["all.MaterialNumber.X"])) == {0, 1, 2}
    assert pixels["all.LinesHidden.A"].max() > 0.9 and pixels["all.Lines.A"].max() > 0.9
    share = sum(pixels[f"all.CryptoObject{i:02}.{letter}"] for i in range(3) for letter in "GA")
    assert np.abs(share - pixels["all.Combined.A"]).max() < 2e-3


def cryptomatte_node_finds_objects():
    scene, first, second = two_layers()
    second.use = False
    first.use_pass_cryptomatte_object = True
    cover = {}
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    node = tree.nodes.new("CompositorNodeCryptomatteV2")
    composite = tree.nodes.new("CompositorNodeComposite")
    tree.links.new(node.outputs["Matte"], composite.inputs[0])
    node.scene = scene
    tree.nodes.new("CompositorNodeRLayers").layer = "all"  # has Blender render
    node.layer_name = "all.CryptoObject"
    for name in ("monkey", "cube"):
        node.matte_id = name
        pixels = render("matte")
        cover[name] = next(pixels[n] for n in ("Composite.Combined.R", "Combined.R", "R", "Y") if n in pixels)
    tree.nodes.clear()
    scene.use_nodes = False
    alpha = render("alpha")["all.Combined.A"]
    assert cover["cube"].max() > 0.99 and cover["monkey"].max() > 0.99
    assert np.abs(cover["cube"] + cover["monkey"] - alpha).max() < 2e-3


def cryptomatte_has_the_levels_asked_for():
    """Many small objects in one pixel or two."""
    scene = new_scene(8, 8)
    scene.burin.line_types, scene.burin.samples = set(), "8"
    for i in range(9):
        add("cube", f"cube {i}", size=.2, location=(.2 * (i % 3), .2 * (i // 3), 0))
    layer = scene.view_layers[0]
    layer.use_pass_cryptomatte_object = True
    shares = {}
    for levels, passes in ((2, 1), (6, 3), (16, 8)):
        layer.pass_cryptomatte_depth = levels
        pixels = render("levels")
        names = [name for name in pixels if "CryptoObject" in name]
        assert len(names) == 4 * passes, names
        shares[levels] = sum(pixels[name] for name in names if name[-1] in "GA").sum()
        alpha = pixels["ViewLayer.Combined.A"].sum()
    assert shares[2] < shares[6] < shares[16] and abs(shares[16] - alpha) < 2e-3, (shares, alpha)


def film_has_paper():
    scene, first, second = two_layers()
    second.use = False
    clear = render("clear")
    scene.render.film_transparent = False
    scene.burin.background = (.5, .25, 1)
    filled = render("filled")
    alpha = clear["all.Combined.A"]
    assert (filled["all.Combined.A"] == 1).all()
    for letter, light in zip("RGB", (.5, .25, 1)):
        wanted = clear[f"all.Combined.{letter}"] + (1 - alpha) * np.float32(light)
        assert np.abs(filled[f"all.Combined.{letter}"] - wanted).max() < 1e-6, letter


def borders_are_parts_of_the_picture():
    """For many sizes and borders, the part is the whole picture's; in double precision some would be a pixel off."""
    scene, first, second = two_layers()
    second.use = False
    border = scene.render
    for width, low, high in ((160, .2, .7), (143, .1, .9), (101, .29, .58), (160, 0, .999), (87, .3, 1)):
        border.resolution_x = width
        border.use_border = False
        whole = render("whole")
        border.use_border = border.use_crop_to_border = True
        border.border_min_x, border.border_max_x, border.border_min_y, border.border_max_y = low, high, low, high
        part = render("part")["all.Combined.A"]
        height = border.resolution_y
        x0, x1 = int(np.float32(low) * np.float32(width)), int(np.float32(high) * np.float32(width))
        y0, y1 = int(np.float32(low) * np.float32(height)), int(np.float32(high) * np.float32(height))
        wanted = whole["all.Combined.A"][height - y1:height - y0, x0:x1]
        assert part.shape == wanted.shape and (part == wanted).all(), (width, low, high, part.shape, wanted.shape)


main([layers_are_equal_to_single_renders, compositor_gets_the_passes, passes_are_what_they_say,
      cryptomatte_node_finds_objects, cryptomatte_has_the_levels_asked_for, film_has_paper,
      borders_are_parts_of_the_picture])
