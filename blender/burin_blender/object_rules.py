"""What objects say about their lines, with Line Art's settings: who only hides, who has no intersections, and whose
creases begin at another angle."""


class ObjectRules:
    """Conditions for line sets that follow from the settings of the objects that are shown."""

    def __init__(self, shown):
        self.silent = shown.usages.get("OCCLUSION_ONLY", [])
        self.without_intersections = shown.usages.get("NO_INTERSECTION", [])
        self.only_intersections = shown.usages.get("INTERSECTION_ONLY", [])
        self.crease_angles = shown.crease_angles  # degrees: names

    def __bool__(self):
        return bool(self.silent or self.without_intersections or self.only_intersections or self.crease_angles)

    def crease_angle(self, degrees):
        """The angle at which creases have to be looked for, if it is `degrees` for all other objects."""
        return min([degrees, *self.crease_angles])

    def conditions(self, sheet, degrees):
        """Conditions that a line has to meet, over groups that are added to the sheet."""
        found = []
        if self.silent:
            found.append(f"not (object in {sheet.group('objects', self.silent)})")
        if self.without_intersections:
            group = sheet.group("objects", self.without_intersections)
            found.append(f"not (is_intersection and (object in {group} or object2 in {group}))")
        if self.only_intersections:
            found.append(f"(is_intersection or not (object in {sheet.group('objects', self.only_intersections)}))")
        if self.crease_angles:
            found.append(f"({self.crease_condition(sheet, degrees)})")
        return found

    def crease_condition(self, sheet, degrees):
        """A line that is nothing but a crease must be sharp enough for its object."""
        limit = str(degrees)
        for angle, names in sorted(self.crease_angles.items()):
            limit = f"(object in {sheet.group('objects', names)} ? {angle!r} : {limit})"
        return f"class != \"crease\" or dihedral > {limit}"
