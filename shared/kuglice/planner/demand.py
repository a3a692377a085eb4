"""What a scene demands: its accuracy as a number."""

from __future__ import annotations

from kuglice.scene import Scene

__all__ = ["LEVELS", "LONGEST", "VISUAL", "demanded"]

VISUAL = 0.5
LEVELS = {"visual": VISUAL, "faithful": 0.01, "exact": 1e-6}
"""Accuracy in words: the largest error of a position in radii, root mean square over balls, at the time when the
mean ball has collided once, or after LONGEST seconds if that is sooner. Farther on no number of digits would help:
errors grow by a factor with every collision.

0.5 is what the eye forgives; at 0.01, collisions are individually right; 1e-6 leaves rounding, and what an
integrator does to forces that vary.
"""
LONGEST = 1.0


def demanded(scene: Scene) -> float:
    """In radii."""
    return LEVELS[scene.accuracy] if isinstance(scene.accuracy, str) else scene.accuracy
