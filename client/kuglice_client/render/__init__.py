"""Frames and films of moments.

A moment is what is to be seen: arrays, not a world, so that a client can draw a state between two ticks.

    renderer = Renderer(scene, size=(1280, 720), style="discs", overlays=("tick",), trails=0.0, own=client)
    with open_output("out/demo/client-1.mp4", size=(1280, 720), fps=30) as output:
        before = renderer.look(world)                     # copies what style and overlays need, nothing else
        world.step(inputs)
        after = renderer.look(world, HashState(hash, tick, "equal"))
        output.write(renderer.frame(between(before, after, alpha)))

`renderer.frame(moment)` returns (height, width, 3) bytes that the next frame draws over. `output.write`
copies them and encodes in a thread of its own; when too many frames wait there, `write` waits too, or with
`wait=False` leaves the frame out, which a loop in real time wants. A Moment can also be made from arrays
alone. `STYLES`, `OVERLAYS` and `OUTPUTS` are the tables of what there is.
"""

from __future__ import annotations

from kuglice_client.render.film import film
from kuglice_client.render.moment import HashState, Moment, between
from kuglice_client.render.outputs import OUTPUTS, Output, check_output, open_output
from kuglice_client.render.overlays import OVERLAYS
from kuglice_client.render.renderer import Renderer, check_look
from kuglice_client.render.size import parse_size
from kuglice_client.render.styles import STYLES

__all__ = [
    "OUTPUTS",
    "OVERLAYS",
    "STYLES",
    "HashState",
    "Moment",
    "Output",
    "Renderer",
    "between",
    "check_look",
    "check_output",
    "film",
    "open_output",
    "parse_size",
]
