"""Cameras of Blender as fields of burin_view. All follow from the projection matrix: no case of sensor fit is left."""

import math

from mathutils import Matrix

from .core import BurinError


def lens_of_projection(projection, is_orthographic):
    """Field of view or height, and shift, of a projection matrix of Blender's: what the picture's middle is off the
    axis is in column 2 of a perspective one, and in column 3 of an orthographic one."""
    p = projection
    wider = p[1][1] / p[0][0]  # the picture's width by its height, in the world
    if is_orthographic:
        return {"ortho_height": 2 / p[1][1], "shift": (-p[0][3] * wider / 2, -p[1][3] / 2)}
    return {"fov_deg": math.degrees(2 * math.atan(1 / p[1][1])), "shift": (p[0][2] * wider / 2, p[1][2] / 2)}


def numbers_of(matrix):
    """The 16 numbers of a matrix, row by row."""
    return tuple(float(x) for row in matrix for x in row)


def rigid(matrix, name):
    """A camera's matrix without its scale. Raises BurinError if more than rotation and position is left."""
    found = matrix.normalized()
    rotation = found.to_3x3()
    off = max(abs(x) for row in rotation.transposed() @ rotation - Matrix.Identity(3) for x in row)
    if not off < 1e-4:
        raise BurinError(f"camera {name} is skewed or flattened, as by parents that are scaled along one axis; apply "
                         "their scale")
    if rotation.determinant() < 0:
        raise BurinError(f"camera {name} is mirrored by a negative scale; make it positive")
    return found


def view_of_camera(camera_object, depsgraph, width, height):
    """What the render of a camera object shows: fields of burin_view. The crop is the caller's."""
    camera = camera_object.evaluated_get(depsgraph)
    if camera.type != "CAMERA":
        raise BurinError(f"{camera.name} is no camera")
    if camera.data.type == "PANO":
        raise BurinError(f"camera {camera.name} is panoramic; Burin draws perspective and orthographic ones")
    render = depsgraph.scene.render
    aspect_x, aspect_y = render.pixel_aspect_x, render.pixel_aspect_y
    projection = camera.calc_matrix_camera(depsgraph, x=width, y=height, scale_x=aspect_x, scale_y=aspect_y)
    view = {"width": width, "height": height, "camera_to_world": numbers_of(rigid(camera.matrix_world, camera.name))}
    view.update(lens_of_projection(projection, camera.data.type == "ORTHO"))
    if aspect_x != aspect_y:
        view["pixel_aspect"] = aspect_x / aspect_y
    return view


def view_of_region(region, region_data):
    """What a 3D viewport shows: fields of burin_view."""
    projection = region_data.window_matrix
    # A viewport that looks through a camera is perspective or not as the camera is: the last row of the matrix tells.
    is_orthographic = projection[3][3] == 1
    to_world = region_data.view_matrix.inverted().normalized()
    if is_orthographic:  # such views begin behind their own place, at Blender's near plane
        nearest = (1 + projection[2][3]) / projection[2][2]
        to_world = to_world @ Matrix.Translation((0, 0, -nearest))
    view = {"width": region.width, "height": region.height, "camera_to_world": numbers_of(to_world)}
    view.update(lens_of_projection(projection, is_orthographic))
    return view
