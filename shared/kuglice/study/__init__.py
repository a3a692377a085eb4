"""Study files: what a client saw, frame by frame, and what the server's world was in the end.

study = Study.load("ana.study")
for frame in study.frames():
    print(frame.at, frame.tick, frame.ahead, frame.mean_error, frame.worst_error)
"""

from kuglice.study.delays import other_screen_delays, own_screen_delays
from kuglice.study.study import Seen, SeenFrame, Study

__all__ = ["Seen", "SeenFrame", "Study", "other_screen_delays", "own_screen_delays"]
