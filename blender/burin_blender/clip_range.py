"""The clip range of a camera: objects that lie wholly outside of it are left out.

The library has no such range. So objects that are in it with a part are drawn whole, and named if the other part can be
seen."""

import math

import numpy as np

MOST_POLYGONS = 1000  # that are looked at one by one
HAIR = 1e-6  # of the range, which single precision does not tell


class Range:
    """Where a camera sees and what it clips. Places are x, y and depth, by the camera's axes."""

    def __init__(self, view, start, end):
        to_camera = np.linalg.inv(np.array(view["camera_to_world"], float).reshape(4, 4))
        to_camera[2] *= -1
        self.to_camera, self.start, self.end = to_camera, start, end
        is_parallel = "ortho_height" in view
        half_y = view["ortho_height"] / 2 if is_parallel else math.tan(math.radians(view["fov_deg"]) / 2)
        half_x = half_y * view["width"] * view.get("pixel_aspect", 1) / view["height"]
        (x, y), by_depth = (2 * half_y * shift for shift in view["shift"]), 0 if is_parallel else 1
        # What is not negative within the view: x, y, depth, 1 times these.
        self.sides = np.array([(sign if axis == 0 else 0, sign if axis == 1 else 0, by_depth * edge,
                                (1 - by_depth) * edge)
                               for axis, middle, half in ((0, x, half_x), (1, y, half_y))
                               for sign, edge in ((1, half - middle), (-1, half + middle))])
        self.near = [(0, 0, 1, 0), (0, 0, -1, start)]
        self.far = [(0, 0, 1, -end)]
        # The corners of what is seen nearer than the range.
        self.near_corners = np.array([((x + i * half_x) * size, (y + j * half_y) * size, depth)
                                      for depth in (0, start) for size in (depth if by_depth else 1,)
                                      for i in (-1, 1) for j in (-1, 1)])

    def depths(self, boxes, matrices):
        """The least and the greatest depth of boxes (middle, half size) at their places."""
        middles, halves = boxes
        rows = self.to_camera[2] @ matrices
        middle = (rows[:, :3] * middles).sum(axis=1) + rows[:, 3]
        reach = (np.abs(rows[:, :3]) * halves).sum(axis=1)
        return middle - reach, middle + reach

    def holds(self, low, high):
        """Whether depths are all within the range, and whether any is."""
        hair = HAIR * np.maximum(np.abs(low), np.abs(high))
        return (low >= self.start - hair) & (high <= self.end + hair), (high >= self.start) & (low <= self.end)

    def is_cut(self, arrays, places):
        """Whether polygons with these places may be seen outside of the range."""
        return (self.reaches(arrays, places, self.near, self.near_corners) or
                self.reaches(arrays, places, self.far, None))

    def reaches(self, arrays, places, planes, corners):
        """Whether polygons may reach into the part of the view that planes bound; `corners`: of all that part."""
        planes = np.array([*planes, *self.sides], float)
        is_outside = places @ planes[:, :3].T + planes[:, 3] < 0
        sizes = np.full(len(arrays.corners) // 3, 3) if arrays.sizes is None else arrays.sizes
        if not len(sizes):
            return False
        begins = np.concatenate(([0], np.cumsum(sizes[:-1])))
        is_beside = np.logical_and.reduceat(is_outside[arrays.corners], begins, axis=0).any(axis=1)
        left = np.flatnonzero(~is_beside)
        if corners is None or len(left) > MOST_POLYGONS:
            return len(left) > 0
        return any(not lies_beside(places[arrays.corners[begins[i]:begins[i] + sizes[i]]], corners) for i in left)


def lies_beside(polygon, corners):
    """Whether the plane of a polygon has all of some corners on one side."""
    middle = polygon.mean(axis=0)
    around = polygon - middle
    normal = np.cross(around, np.roll(around, -1, axis=0)).sum(axis=0)
    off = np.abs(around @ normal).max()
    distances = (corners - middle) @ normal
    return (distances > off).all() or (distances < -off).all()


def leave_out(gathered, view, start, end):
    """Takes away the objects of a Gathered that are wholly out of a camera's range, and notes those that are cut."""
    if not len(gathered.objects):
        return
    seen = Range(view, start, end)
    boxes = [mesh.box() for mesh in gathered.meshes]
    meshes = [thing.mesh for thing in gathered.objects]
    matrices = gathered.matrices.reshape(-1, 4, 4)
    is_whole, is_in = seen.holds(*seen.depths((np.array([b[0] for b in boxes])[meshes],
                                               np.array([b[1] for b in boxes])[meshes]), matrices))
    cut = set()
    for number in np.flatnonzero(is_in & ~is_whole):
        thing = gathered.objects[number]
        arrays, to_camera = gathered.meshes[thing.mesh], seen.to_camera @ matrices[number]
        places = arrays.points.reshape(-1, 3) @ to_camera[:3, :3].T + to_camera[:3, 3]
        depths = places[:, 2]
        is_whole[number], is_in[number] = seen.holds(depths.min(), depths.max())
        if is_in[number] and not is_whole[number] and thing.name not in cut and seen.is_cut(arrays, places):
            cut.add(thing.name)
    for name in cut:
        gathered.notes.add(f"object {gathered.shown.own_name(name)} reaches out of the camera's clip range; it is "
                           "drawn whole")
    # What is not finite is told by the library.
    gathered.keep(is_in | ~np.isfinite(matrices).all(axis=(1, 2)) | ~np.array([b[2] for b in boxes])[meshes])
