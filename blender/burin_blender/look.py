"""Gives a scene of the library its settings and its style sheet, and only what has changed since."""


class Look:
    """What one scene of the library was given last."""

    def __init__(self):
        self.lines = []
        self.keys = set()
        self.sheet = None

    def fits(self, lines):
        """Whether the scene can take these settings. The library has no way to take a setting back, so a scene that
        was given more keys must be made anew."""
        return self.keys <= keys_of(lines)

    def apply(self, scene, lines, sheet):
        """`lines`: as properties.settings_lines(); `sheet`: text, name or file, or None. Says whether anything was
        new. What failed is given again the next time."""
        if sheet == self.sheet and lines == self.lines:
            return False
        old, self.lines = self.lines, []
        if sheet != self.sheet:
            self.sheet = None
            scene.set_style(sheet)
            self.sheet = sheet
            old = [line for line in old if not line.startswith("style.")]
        known = set(old)
        for line in lines:
            if line not in known:
                scene.set(line)
                self.keys |= keys_of([line])
        self.lines = lines
        return True


def keys_of(lines):
    """The settings that lines name, but those of a style sheet, which go with the sheet, and those of looks, which
    nothing reads beside one."""
    keys = {line.partition("=")[0] for line in lines}
    return {key for key in keys if not key.startswith(("style.", "lines."))}
