"""Replay files: what happened, so that it can happen again, and proof that it was the same.

with Recorder("run.kuglice", world) as recorder:
    for inputs in script:
        world.step(inputs)
        recorder.add(inputs)
print(Replay.load("run.kuglice").verify())
"""

from kuglice.replay.difference import Difference, difference
from kuglice.replay.recorder import Recorder
from kuglice.replay.replay import Replay
from kuglice.replay.verification import Mismatch, Verification

__all__ = ["Difference", "Mismatch", "Recorder", "Replay", "Verification", "difference"]
