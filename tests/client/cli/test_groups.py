"""Closing figures for people: grouped, complete, and quiet about what could have gone wrong and did not."""

from __future__ import annotations

import ast
import inspect

import pytest

from kuglice.cli.figures import Group, print_groups
from kuglice_client import summary
from kuglice_client.cli.groups import CLIENT, VIEW
from kuglice_client.view import summary as view_summary

FIGURES = {
    "client": (summary, CLIENT),
    "view": (view_summary, VIEW),
}


def told_by(module: object) -> set[str]:
    """The figures of a summary: every name that its functions give at the top level."""
    functions = {
        node.name: node for node in ast.parse(inspect.getsource(module)).body if hasattr(node, "name")
    }
    chosen = [functions[name] for name in ("figures", "summarise") if name in functions]
    returned = [
        node.value for function in chosen for node in ast.walk(function) if isinstance(node, ast.Return)
    ]
    return {key.value for told in returned for key in told.keys if key is not None}


@pytest.mark.parametrize("of", FIGURES)
def test_every_figure_has_its_place_and_only_one(of):
    module, groups = FIGURES[of]
    placed = [name for group in groups.values() for name in (*group.figures, *group.troubles)]
    assert len(placed) == len(set(placed))
    assert told_by(module) <= set(placed)


def test_troubles_are_shown_when_there_were_some(capsys):
    groups = {"state": Group(("hashes",), troubles=("rejoins",)), "feel": Group(("feel",))}
    figures = {"hashes": 0, "rejoins": 0, "feel": {"delay_ms": None}, "new": 1.5}
    print_groups("Client", figures, groups)
    quiet = capsys.readouterr()
    assert "hashes" in quiet.out
    assert "rejoins" not in quiet.out
    assert "more" in quiet.out
    assert "--json has every figure" in quiet.err
    assert "None" not in quiet.out
    print_groups("Client", {**figures, "rejoins": 2}, groups)
    assert "rejoins" in capsys.readouterr().out
