"""Films and pictures: what was written is read back and looked at."""

from __future__ import annotations

import sys
import threading

import av
import numpy as np
import pytest

from client.render.stages import read
from kuglice.errors import MissingExtraError, PictureError
from kuglice_client.render import OUTPUTS, open_output, parse_size
from kuglice_client.render.outputs.output import Output

SIZE = (96, 64)


def frame(number):
    """A block that goes right by four pixels from frame to frame."""
    pixels = np.full((SIZE[1], SIZE[0], 3), 20, dtype=np.uint8)
    pixels[16:48, 4 * number : 4 * number + 32] = (220, 60, 40)
    return pixels


def write(path, numbers, fps=25.0, **more):
    with open_output(path, size=SIZE, fps=fps, **more) as output:
        for number in numbers:
            output.write(frame(number))
    return output


def decoded(path):
    with av.open(str(path)) as film:
        return [(picture.time, picture.to_ndarray(format="rgb24")) for picture in film.decode(video=0)]


@pytest.mark.parametrize("suffix", [".mp4", ".webm", ".gif"])
def test_a_film_has_every_frame_at_its_time_in_its_colours(tmp_path, suffix):
    path = tmp_path / "made" / f"film{suffix}"
    output = write(path, range(12))
    assert output.frames == 12
    films = decoded(path)
    assert len(films) == 12
    for number, (time, pixels) in enumerate(films):
        assert time == pytest.approx(number / 25, abs=0.011)
        assert pixels.shape == frame(0).shape
        inside = pixels[20:44, 4 * number + 4 : 4 * number + 28].reshape(-1, 3).mean(axis=0)
        assert inside == pytest.approx([220, 60, 40], abs=12)
        assert pixels[52:, :].mean() == pytest.approx(20, abs=6)


@pytest.mark.parametrize("suffix", [".mp4", ".webm"])
def test_rates_that_are_no_whole_numbers_are_kept(tmp_path, suffix):
    path = tmp_path / f"film{suffix}"
    write(path, range(10), fps=12.5)
    assert [time for time, _ in decoded(path)] == pytest.approx(
        [number / 12.5 for number in range(10)], abs=2e-3
    )


def test_pictures_with_a_number_are_a_sequence(tmp_path):
    write(tmp_path / "frame-%03d.png", range(3))
    assert sorted(file.name for file in tmp_path.iterdir()) == [
        f"frame-{number:03d}.png" for number in range(3)
    ]
    for number in range(3):
        assert (read(tmp_path / f"frame-{number:03d}.png") == frame(number)).all()


def test_a_directory_is_a_sequence_too(tmp_path):
    write(tmp_path / "frames", range(2))
    assert (read(tmp_path / "frames" / "frame-00001.png") == frame(1)).all()


def test_one_picture_is_the_last_frame(tmp_path):
    write(tmp_path / "end.png", range(5))
    assert (read(tmp_path / "end.png") == frame(4)).all()


def test_what_the_caller_draws_next_does_not_change_what_was_written(tmp_path):
    pixels = frame(0)
    with open_output(tmp_path / "%d.png", size=SIZE, fps=30) as output:
        for number in range(4):
            pixels[:] = frame(number)
            output.write(pixels)
    assert (read(tmp_path / "0.png") == frame(0)).all()


@pytest.mark.parametrize(
    ("name", "options", "message"),
    [
        ("film.avi", {}, r"film\.avi.*\.mp4, \.webm, \.gif, \.png"),
        ("film.mp4", {"size": (97, 64)}, "even.*97x64"),
        ("film.mp4", {"fps": 0.0}, r"0\.0 frames"),
        ("film.gif", {"fps": float("nan")}, "nan frames"),
        ("a%d-%d.png", {}, "one number pattern"),
        ("a%s.png", {}, "one number pattern"),
    ],
)
def test_outputs_that_cannot_be_are_refused_by_name(tmp_path, name, options, message):
    with pytest.raises(PictureError, match=message):
        open_output(tmp_path / name, **{"size": SIZE, "fps": 30.0, **options})
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("suffix", sorted(OUTPUTS))
def test_a_path_through_a_file_is_refused(tmp_path, suffix):
    (tmp_path / "file").write_text("no directory")
    with pytest.raises(PictureError, match="cannot be written"):
        open_output(tmp_path / "file" / f"film{suffix}", size=SIZE, fps=30)


@pytest.mark.parametrize(
    "pixels", [np.zeros((64, 95, 3), np.uint8), np.zeros((64, 96, 3)), np.zeros((64, 96), np.uint8)]
)
def test_frames_of_another_shape_or_type_are_refused(tmp_path, pixels):
    with open_output(tmp_path / "film.gif", size=SIZE, fps=30) as output:
        output.write(frame(0))
        with pytest.raises(PictureError, match=r"\(64, 96, 3\)"):
            output.write(pixels)
    assert len(decoded(tmp_path / "film.gif")) == 1


def test_a_closed_output_takes_no_more_and_may_be_closed_again(tmp_path):
    output = write(tmp_path / "film.gif", range(2))
    output.close()
    with pytest.raises(PictureError, match="is closed"):
        output.write(frame(0))


class Slow:
    """An encoder that holds its first frame until it is let go."""

    def __init__(self):
        self.go = threading.Event()
        self.holding = threading.Event()
        self.numbers = []

    def write(self, pixels, number):
        self.holding.set()
        assert self.go.wait(60)
        self.numbers.append(number)

    def close(self):
        pass


def test_a_loop_that_must_not_wait_leaves_frames_out_and_keeps_the_time(tmp_path):
    slow = Slow()
    with Output(tmp_path / "film", SIZE, slow, depth=2) as output:
        assert output.write(frame(0), wait=False)
        assert slow.holding.wait(60)
        taken = [output.write(frame(0), wait=False) for _ in range(4)]
        assert taken == [True, True, False, False]
        assert output.behind == 2
        slow.go.set()
    assert slow.numbers == [0, 1, 2]
    assert (output.frames, output.dropped) == (3, 2)


class Full:
    """An encoder whose disk is full."""

    def write(self, pixels, number):
        raise OSError(28, "No space left on device")

    def close(self):
        pass


def write_many(output):
    for _ in range(1000):
        output.write(frame(0))


def test_what_goes_wrong_in_the_thread_is_told_to_the_caller(tmp_path):
    output = Output(tmp_path / "film.mp4", SIZE, Full(), depth=1)
    with pytest.raises(PictureError, match=r"film\.mp4.*No space left"):
        write_many(output)
    with pytest.raises(PictureError, match="No space left"):
        output.close()


@pytest.mark.parametrize(
    ("module", "suffix", "package"),
    [("av", ".mp4", "PyAV"), ("av", ".gif", "PyAV"), ("PIL", ".png", "Pillow")],
)
def test_a_missing_package_is_one_sentence_that_names_the_extra(
    tmp_path, monkeypatch, module, suffix, package
):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingExtraError, match=rf"{package} is not installed.*kuglice\[render\]"):
        open_output(tmp_path / f"film{suffix}", size=SIZE, fps=30)


def test_sizes_are_read():
    assert parse_size("1280x720") == (1280, 720)
    for text in ("1280", "axb", "-1x5", "1280x", "1e3x5"):
        with pytest.raises(PictureError, match="1280x720"):
            parse_size(text)
