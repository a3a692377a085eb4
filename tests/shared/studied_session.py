"""A client's session, recorded by hand: what was confirmed, predicted and drawn is all made up here."""

from __future__ import annotations

import numpy as np

import kuglice as kg
from kuglice.inputs import pack
from kuglice.study.recorder import StudyRecorder
from server.small_arena import small_arena

RATE = 60.0
ME, OTHER = 1, 2


class Session:
    """A client that is two ticks ahead and knows nothing of what others do until it is confirmed."""

    def __init__(self, path, *, number=ME, epoch=5, seen_bytes=1e9):
        self.confirmed = kg.World(small_arena())
        self.confirmed.step(
            [
                kg.Join(client=client, sequence=1, x=x, y=1, radius=0.4, mass=2)
                for client, x in ((ME, 1), (OTHER, 19))
            ]
        )
        self.predicted = self.confirmed.clone()
        self.number, self.epoch = number, epoch
        self.recorder = StudyRecorder(path, seen_bytes=seen_bytes)
        self.now = 100.0
        self.joined()

    def joined(self):
        self.recorder.joined(
            self.now, self.confirmed, name="ana", number=self.number, epoch=self.epoch, rate=RATE
        )

    def act(self, given, tick):
        self.recorder.acted(self.now, given, tick)

    def tick(self, inputs=(), *, known=(), off=0.0):
        """One tick is confirmed with `inputs`, two ahead of it predicted with those that are `known`; then a frame."""
        tick = self.confirmed.tick
        self.confirmed.step(inputs)
        self.recorder.tick(self.now, tick, pack(inputs), self.confirmed.state_hash)
        self.predicted = self.confirmed.clone()
        self.predicted.step(known)
        self.predicted.step()
        self.now += 1 / RATE
        self.frame(off)

    def frame(self, off=0.0):
        shown = self.predicted
        self.recorder.frame(
            self.now,
            shown,
            1.0,
            self.confirmed.tick,
            lambda: (shown.id, shown.position + np.array([off, 0.0])),
        )
