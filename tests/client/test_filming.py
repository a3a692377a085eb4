"""Moments become a film in a process of its own, all of them, or the reason why not is told."""

from __future__ import annotations

import av
import pytest

from kuglice.errors import KugliceError, PictureError
from kuglice_client.filming import Film, FilmSettings
from kuglice_client.interpolation import interpolate
from kuglice_client.render.moment import HashState

SIZE = (160, 80)


def moments(authority, count: int):
    for _ in range(count):
        previous = authority.world.clone()
        authority.step()
        state = HashState(authority.world.state_hash, authority.world.tick, "equal")
        yield interpolate(previous, authority.world, 0.5, state, nodes=False)


def test_every_moment_is_a_frame(authority, tmp_path):
    film = Film(authority.world.scene, FilmSettings(tmp_path / "a.mp4", size=SIZE, still_every=10))
    for moment in moments(authority, 25):
        film.add(moment)
    assert film.close(60) == 25
    with av.open(str(tmp_path / "a.mp4")) as container:
        assert sum(1 for _ in container.decode(video=0)) == 25
    assert sorted(path.name for path in tmp_path.glob("*.png")) == ["a-01.png", "a-02.png"]


@pytest.mark.parametrize(
    "wrong", [{"path": "a.doc"}, {"path": "a.mp4", "style": "oil"}, {"path": "a.mp4", "overlays": ("clock",)}]
)
def test_what_cannot_be_drawn_is_refused_before_anything_is_played(authority, tmp_path, wrong):
    wrong = {**wrong, "path": tmp_path / wrong["path"]}
    with pytest.raises(PictureError):
        Film(authority.world.scene, FilmSettings(size=SIZE, **wrong))


def test_a_film_that_fails_says_why_and_holds_nobody_up(authority, tmp_path):
    (tmp_path / "taken").write_text("a file where a folder should be")
    film = Film(authority.world.scene, FilmSettings(tmp_path / "taken" / "a.mp4", size=SIZE))
    for moment in moments(authority, 5):
        film.add(moment)
    with pytest.raises(KugliceError, match="taken"):
        film.close(60)
