"""Calls as a type checker sees them: mypy must refuse each with an `ignore`, for one that is not needed is an error."""

import numpy as np

import burin

scene = burin.Scene((np.zeros((3, 3)), np.array([[0, 1, 2]])))
picture: burin.Picture = scene.render((64, 48), eye=(3, 2, 5), fov=30.0)
drawing: burin.Drawing = scene.find_lines((64, 48), style="technical")
number: int = scene.add((np.zeros((3, 3)), np.array([[0, 1, 2]])), name="part")

scene.render(64)  # type: ignore[arg-type]
scene.find_lines(find=True)  # type: ignore[arg-type]
scene.set_style(3)  # type: ignore[arg-type]
scene.move("part", None)  # type: ignore[arg-type]
scene.add_line_shader("a", ["s"], 3)  # type: ignore[arg-type]
scene.draw()  # type: ignore[attr-defined]
picture.save(3)  # type: ignore[arg-type]
picture.pixels("rgb")  # type: ignore[arg-type]
drawing.svg(3)  # type: ignore[arg-type]
burin.draw(scene, width="thick")  # type: ignore[arg-type]
burin.draw(scene, widht=2.0, size="large")  # type: ignore[arg-type]
text: str = scene.render()  # type: ignore[assignment]
