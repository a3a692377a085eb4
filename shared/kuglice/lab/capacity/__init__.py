"""How many clients one server feeds, directly and through routers: `kuglice bench capacity`."""

from __future__ import annotations
