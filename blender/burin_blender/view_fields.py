"""Which part of a viewport is drawn, and how the view is told to the library."""

from bpy_extras.view3d_utils import location_3d_to_region_2d

from .camera import view_of_region


def fields_of(context, depsgraph):
    """Fields of burin_view for a viewport, with the crop of its border."""
    view = view_of_region(context.region, context.region_data)
    view["frame"] = depsgraph.scene.frame_current
    crop = crop_of(context, depsgraph.scene)
    if crop is not None:
        view["crop"] = crop
    return view


def crop_of(context, scene):
    """The render border within the region in pixels, x0 y0 x1 y1 from the upper left; None: there is none."""
    space, region, region_data = context.space_data, context.region, context.region_data
    width, height = region.width, region.height
    if region_data.view_perspective == "CAMERA":
        frame = camera_frame(context, scene) if scene.render.use_border else None
        if frame is None:
            return None
        left, bottom, right, top = frame
        render = scene.render
        x0, x1 = (left + (right - left) * share for share in (render.border_min_x, render.border_max_x))
        y0, y1 = (bottom + (top - bottom) * share for share in (render.border_min_y, render.border_max_y))
    elif space.use_render_border:
        x0, x1 = space.render_border_min_x * width, space.render_border_max_x * width
        y0, y1 = space.render_border_min_y * height, space.render_border_max_y * height
    else:
        return None
    x0, x1 = (min(max(round(x), 0), width) for x in (x0, x1))
    y0, y1 = (min(max(round(height - y), 0), height) for y in (y1, y0))
    return (x0, y0, x1, y1)


def camera_frame(context, scene):
    """The frame of the camera in the region: left, bottom, right, top in pixels."""
    camera = context.space_data.camera if context.space_data.use_local_camera else scene.camera
    if camera is None or camera.type != "CAMERA":
        return None
    to_world = camera.matrix_world.normalized()
    corners = [location_3d_to_region_2d(context.region, context.region_data, to_world @ corner)
               for corner in camera.data.view_frame(scene=scene)]
    if any(corner is None for corner in corners):
        return None
    xs, ys = [corner.x for corner in corners], [corner.y for corner in corners]
    return min(xs), min(ys), max(xs), max(ys)
