"""How long after acting an input is on screen: on one's own, and on another's. In seconds."""

from __future__ import annotations

from collections.abc import Iterator

from kuglice.inputs.record import OF_THE_SERVER, RECORD
from kuglice.study.format import Acted, DrawnFrame, Joined, Tick
from kuglice.study.study import Study

__all__ = ["other_screen_delays", "own_screen_delays"]


def own_screen_delays(study: Study) -> list[float]:
    """From each own input to the first frame with a state that it has acted in."""
    delays: list[float] = []
    waiting: list[Acted] = []
    for event in study.events:
        match event:
            case Joined():
                waiting = []
            case Acted():
                waiting.append(event)
            case DrawnFrame():
                delays += [event.at - one.at for one in waiting if one.tick < event.tick]
                waiting = [one for one in waiting if one.tick >= event.tick]
            case _:
                pass
    return delays


def other_screen_delays(acting: Study, looking: Study) -> list[float]:
    """From each input of `acting` to the first frame of `looking` with a state that it has acted in at the server.

    Both must have been recorded on one machine, in one run of the server. An input that the other has guessed right, as
    one that is held, is on screen even earlier.
    """
    number, epoch = acting.joined.number, acting.joined.epoch
    if number is None or looking.joined.epoch != epoch:
        return []
    made = {event.sequence: event.at for event in acting.events if isinstance(event, Acted)}
    return [at - made[sequence] for sequence, at in _first_frames(looking, number) if sequence in made]


def _first_frames(study: Study, number: int) -> Iterator[tuple[int, float]]:
    waiting: list[tuple[int, int]] = []
    for event in study.events:
        match event:
            case Joined() if event.epoch != study.joined.epoch:
                return
            case Tick():
                waiting += [
                    (event.tick, sequence)
                    for kind, who, sequence, *_ in RECORD.iter_unpack(event.inputs)
                    if who == number and kind not in OF_THE_SERVER
                ]
            case DrawnFrame():
                yield from ((sequence, event.at) for tick, sequence in waiting if tick < event.tick)
                waiting = [(tick, sequence) for tick, sequence in waiting if tick >= event.tick]
            case _:
                pass
