"""A view: a client that is told of one rectangle of a world, and runs the same step on what it knows."""

from kuglice_client.view.settings import ViewSettings, parse_rectangle
from kuglice_client.view.view import View

__all__ = ["View", "ViewSettings", "parse_rectangle"]
