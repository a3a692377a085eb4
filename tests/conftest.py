"""For every room: property tests without a stopwatch, and the same examples in each CI run."""

import os

from hypothesis import HealthCheck, settings

# Machines differ and are busy: how long an example takes is no property of the code.
settings.register_profile("local", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("ci", parent=settings.get_profile("local"), derandomize=True, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "local")
