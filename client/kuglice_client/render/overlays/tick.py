"""Tick, time, number of balls, and whether the state is the server's, or the server is silent."""

from __future__ import annotations

from functools import cache

import numpy as np

from kuglice import _core
from kuglice_client.render.moment import HashState, Moment, Verdict
from kuglice_client.render.stage import Pixels, Stage
from kuglice_client.render.text import Font

__all__ = ["draw_tick"]

VERDICTS: dict[Verdict, tuple[str, tuple[int, int, int]]] = {
    "local": ("", (150, 164, 190)),
    "equal": ("equal to the server's", (84, 220, 140)),
    "different": ("DIFFERENT", (255, 84, 84)),
}
SILENT = ("no news from the server", (255, 190, 70))
PANEL = (7, 9, 13, 205)
TEXT = (226, 232, 243)
FAINT = (140, 152, 174)


@cache
def _font(size: int) -> Font:
    return Font(size)


def draw_tick(pixels: Pixels, stage: Stage, moment: Moment) -> None:
    """One line in a dark pill at the top left. Needs the extra `render`, for the font."""
    height = pixels.shape[0]
    font = _font(max(9, min(28, round(height / 45))))
    words = [
        (f"tick {moment.tick:,}", TEXT),
        (f"{moment.time:.2f} s", FAINT),
        (f"{len(moment.id):,} ball{'' if len(moment.id) == 1 else 's'}", FAINT),
    ]
    if moment.hash_state is not None:
        words.append((_hash_word(moment, moment.hash_state), TEXT))
    verdict = _verdict(moment)
    if verdict[0]:
        words.append(verdict)
    gap = 1.1 * font.size
    length = sum(font.length(word) for word, _ in words) + gap * (len(words) - 1)
    thick = 2.0 * font.size
    corner = stage.camera.window()
    left, middle = (0.5 * font.size + thick / 2 + side for side in corner[:2])
    dot = 0.42 * font.size
    length += 0 if moment.hash_state is None else 2 * dot + 0.5 * font.size
    ends = np.array([[left, middle]]), np.array([[left + length, middle]])
    _core.draw_segments(pixels, *ends, np.array([thick]), np.array([PANEL], dtype=np.uint8))
    at = left
    if moment.hash_state is not None:
        colour = np.array([[*verdict[1], 255]], dtype=np.uint8)
        _core.draw_discs(pixels, np.array([[at + dot, middle]]), np.array([dot]), colour)
        at += 2 * dot + 0.5 * font.size
    for word, ink in words:
        font.draw(pixels, at, middle, word, ink)
        at += font.length(word) + gap


def _hash_word(moment: Moment, state: HashState) -> str:
    digits = f"{state.hash:016x}"
    of = "" if state.tick == moment.tick else f" at {state.tick:,}"
    return f"hash {digits[:8]} {digits[8:]}{of}"


def _verdict(moment: Moment) -> tuple[str, tuple[int, int, int]]:
    state = moment.hash_state
    # A difference was found and stays true; that all was equal says nothing of what the server has done since.
    if moment.silent and (state is None or state.verdict != "different"):
        return SILENT
    return VERDICTS["local" if state is None else state.verdict]
