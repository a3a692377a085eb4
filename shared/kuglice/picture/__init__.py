"""Balls as pictures: arrays in, an array of shape (height, width, 3) of bytes out.

    camera = Camera.fit(scene.box, (1280, 720))
    pixels = background(camera)
    draw_balls(pixels, camera, position, radius, speed_colours(velocity, reference_speed(scene)))

`draw` does all of that at once, `png` is what notebooks show. Writing PNG needs the extra `render`; drawing
does not.
"""

from __future__ import annotations

from kuglice.picture.background import background
from kuglice.picture.balls import draw, draw_balls
from kuglice.picture.camera import Camera
from kuglice.picture.png import encode_png, png
from kuglice.picture.speed import PEG, SPEED_PALETTE, reference_speed, speed_colours, speed_values

__all__ = [
    "PEG",
    "SPEED_PALETTE",
    "Camera",
    "background",
    "draw",
    "draw_balls",
    "encode_png",
    "png",
    "reference_speed",
    "speed_colours",
    "speed_values",
]
