"""Frames by their content."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import kuglice as kg
from client.render.stages import BOX, SIZE, moment, scene
from kuglice.errors import PictureError
from kuglice.picture import PEG, SPEED_PALETTE, Camera, background
from kuglice_client.render import OVERLAYS, STYLES, HashState, Renderer
from kuglice_client.render.players import OWN, PLAYER_COLOURS

CAMERA = Camera.fit(BOX, SIZE)


def renderer(**more):
    return Renderer(scene(), size=SIZE, **{"reference": 10.0, **more})


def pixel(frame, x, y):
    column, row = CAMERA.points(np.array([[x, y]]))[0]
    return frame[int(row), int(column)].astype(int)


def close(one, two, tolerance=14):
    return np.abs(np.asarray(one, dtype=int) - np.asarray(two, dtype=int)).max() <= tolerance


@pytest.mark.parametrize("style", sorted(STYLES))
def test_where_a_ball_is_something_is_and_elsewhere_is_the_background(style):
    frame = renderer(style=style).frame(moment((4, 7), (15, 2)))
    empty = background(CAMERA)
    assert frame.shape == (180, 320, 3)
    assert not close(pixel(frame, 4, 7), pixel(empty, 4, 7), 60)
    assert not close(pixel(frame, 15, 2), pixel(empty, 15, 2), 60)
    for x, y in ((4, 2), (15, 7), (10, 5), (5.8, 7), (4, 8.8)):
        assert (pixel(frame, x, y) == pixel(empty, x, y)).all()


def test_a_disc_has_the_colour_of_its_speed():
    seen = replace(moment((4, 7), (15, 2)), velocity=np.array([[0.0, 0.0], [8.0, 6.0]]))
    frame = renderer().frame(seen)
    assert close(pixel(frame, 4, 7), SPEED_PALETTE[0])
    assert close(pixel(frame, 15, 2), SPEED_PALETTE[-1])


def test_pegs_have_a_colour_of_their_own_in_every_style():
    seen = moment((4, 7), fixed=np.array([True]))
    for style in STYLES:
        assert close(pixel(renderer(style=style).frame(seen), 4, 7), PEG)


@pytest.mark.parametrize("style", sorted(STYLES))
def test_players_have_their_colours_and_one_knows_ones_own(style):
    seen = moment((4, 5), (10, 5), (16, 5), ids=(3, 7, 9), players={3: 1, 9: 2, 1000: 3})
    frame = renderer(style=style, own=2).frame(seen)
    assert close(pixel(frame, 4, 5), PLAYER_COLOURS[0])
    assert close(pixel(frame, 16, 5), PLAYER_COLOURS[1])
    ring = 1 + 3.25 / CAMERA.scale
    assert close(pixel(frame, 16, 5 + ring), OWN[:3], 40)
    assert close(pixel(frame, 4, 5 + ring), PLAYER_COLOURS[0], 40)
    assert (pixel(frame, 10, 5 + ring) == pixel(background(CAMERA), 10, 5 + ring)).all()


def test_equal_moments_make_equal_frames():
    world = kg.World(kg.scenes.find("mixed"))
    world.run(20)
    for style in STYLES:
        frames = []
        for _ in range(2):
            one = Renderer(world.scene, size=SIZE, style=style, overlays=tuple(OVERLAYS))
            one.frame(one.look(kg.World(world.scene)))
            frames.append(one.frame(one.look(world)).copy())
        assert (frames[0] == frames[1]).all()


def test_a_frame_leaves_nothing_behind_for_the_next():
    one = renderer(overlays=("tick",))
    one.frame(moment((4, 7), (15, 2), hash_state=HashState(2**64 - 1, 1, "different")))
    again = one.frame(moment((10, 5))).copy()
    assert (again == renderer(overlays=("tick",)).frame(moment((10, 5)))).all()


def test_trails_are_where_the_ball_was_and_fade_in_their_time():
    one = renderer(trails=1.0)
    one.frame(moment((4, 5), time=0.0))
    empty = pixel(background(CAMERA), 7, 5).sum()
    fresh = pixel(one.frame(moment((12, 5), time=0.1)), 7, 5).sum()
    later = pixel(one.frame(moment((12, 5), time=0.6)), 7, 5).sum()
    gone = pixel(one.frame(moment((12, 5), time=3.0)), 7, 5).sum()
    assert fresh > later > gone
    assert fresh > empty + 60
    assert abs(gone - empty) <= 3
    assert (pixel(one.frame(moment((12, 5), time=3.1)), 4, 8) == pixel(background(CAMERA), 4, 8)).all()


def test_trails_follow_ids_not_rows():
    one = renderer(trails=1.0)
    one.frame(moment((4, 2), (4, 8), ids=(1, 2), time=0.0))
    frame = one.frame(moment((14, 8), ids=(2,), time=0.1))
    empty = background(CAMERA)
    assert not close(pixel(frame, 9, 8), pixel(empty, 9, 8), 20)
    assert (pixel(frame, 9, 2) == pixel(empty, 9, 2)).all()
    assert (pixel(frame, 9, 5) == pixel(empty, 9, 5)).all()


def test_trails_start_anew_when_time_goes_back():
    one = renderer(trails=1.0)
    one.frame(moment((4, 5), time=5.0))
    one.frame(moment((12, 5), time=5.1))
    frame = one.frame(moment((12, 5), time=0.0))
    assert (pixel(frame, 7, 5) == pixel(background(CAMERA), 7, 5)).all()


def test_the_tree_overlay_outlines_the_nodes():
    seen = moment((4, 7), nodes=np.array([[10.0, 2.0, 15.0, 7.0]]))
    frame, bare = renderer(overlays=("tree",)).frame(seen), renderer().frame(seen)
    changed = (frame != bare).any(axis=2)
    left, top, right, bottom = CAMERA.rectangles(np.array([[10.0, 2.0, 15.0, 7.0]]))[0].astype(int)
    assert changed[top, left : right + 1].all()
    assert changed[bottom, left : right + 1].all()
    assert changed[top : bottom + 1, left].all()
    assert changed[top : bottom + 1, right].all()
    assert changed.sum() == 2 * (right - left) + 2 * (bottom - top)


def overlay(**more):
    """The part of the picture that the tick overlay changes, and the frame."""
    large = (1280, 720)
    seen = moment((18, 1), **more)
    frame = Renderer(scene(), size=large, overlays=("tick",)).frame(seen).copy()
    bare = Renderer(scene(), size=large).frame(seen)
    return (frame != bare).any(axis=2), frame


def test_the_tick_overlay_is_one_line_at_the_top_left():
    changed, frame = overlay(tick=1234, time=20.5)
    rows, columns = np.nonzero(changed)
    assert rows.max() < 100
    assert columns.max() < 640
    assert (frame[changed] > 180).all(axis=1).sum() > 40


def test_another_tick_or_hash_is_another_text():
    texts = [
        overlay(tick=7)[1],
        overlay(tick=8)[1],
        overlay(tick=8, hash_state=HashState(1, 8))[1],
        overlay(tick=8, hash_state=HashState(2, 8))[1],
        overlay(tick=8, hash_state=HashState(2, 5))[1],
    ]
    assert len({text.tobytes() for text in texts}) == len(texts)


def test_the_verdict_is_told_by_colour():
    def hue(verdict):
        _, frame = overlay(hash_state=HashState(9, 0, verdict))
        dot = frame[50:90, 20:60].reshape(-1, 3).astype(int)
        return dot[(dot.max(axis=1) - dot.min(axis=1)).argmax()]

    red, green, _ = hue("equal")
    assert green > red + 60
    red, green, _ = hue("different")
    assert red > green + 60


def test_a_silent_server_is_told_by_colour_and_words_and_hides_no_difference():
    def seen(verdict, *, silent):
        return overlay(hash_state=HashState(9, 0, verdict), silent=silent)[1]

    told = seen("equal", silent=True)
    dot = told[50:90, 20:60].reshape(-1, 3).astype(int)
    red, green, blue = dot[(dot.max(axis=1) - dot.min(axis=1)).argmax()]
    assert red > blue + 60 < green
    assert (told != seen("equal", silent=False)).any(axis=2)[:, 100:].any(), "other words, too"
    assert (seen("different", silent=True) == seen("different", silent=False)).all()
    assert (overlay(silent=True)[1] != overlay(silent=False)[1]).any(), (
        "a view has no hash, and says it as well"
    )


def test_texts_are_clipped_to_small_pictures():
    tiny = Renderer(scene(), size=(30, 16), overlays=("tick", "tree"))
    assert tiny.frame(tiny.look(kg.World(scene()))).shape == (16, 30, 3)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"style": "jelly"}, "style 'jelly'.*discs, fluid"),
        ({"overlays": ("tick", "forest")}, "overlay 'forest'.*tick, tree, scale"),
        ({"trails": -1.0}, r"trails -1\.0"),
        ({"trails": float("nan")}, "trails nan"),
        ({"size": (0, 5)}, "size 0x5"),
        ({"reference": 0.0}, r"reference speed 0\.0"),
    ],
)
def test_what_cannot_be_drawn_is_refused_by_name(wrong, message):
    with pytest.raises(PictureError, match=message):
        Renderer(scene(), **wrong)
