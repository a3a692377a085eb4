"""Terms at the end of ARCHITECTURE.md are names in the code, or told to users; those under "never" name nothing."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
HEAD = "| term | what it is | never |\n|---|---|---|\n"
OTHERS = ("pymunk", "rapier", "peers")
"""Engines that are measured here have names of their own."""


def rows() -> list[list[str]]:
    _, _, table = (ROOT / "ARCHITECTURE.md").read_text().partition(HEAD)
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table.strip().splitlines()]


def said(text: str) -> Iterator[str]:
    """Strings of a Python source, which users may read, without those that only explain."""
    tree = ast.parse(text)
    explaining = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in explaining:
            yield node.value


def of_python(text: str) -> Iterator[str]:
    for node in ast.walk(ast.parse(text)):
        for field in ("name", "id", "attr", "arg"):
            name = getattr(node, field, None)
            if isinstance(name, str):
                yield name


def of_rust(text: str) -> Iterator[str]:
    code = re.sub(r'//.*|"(?:[^"\\]|\\.)*"', "", text)
    yield from re.findall(r"[A-Za-z_]\w*", code)


def words(name: str) -> list[str]:
    """Of `stateHash`, `state_hash` or `StateHash`: state, hash."""
    return re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", name)


@pytest.fixture(scope="module")
def sources() -> list[Path]:
    found = [
        path
        for room in ("shared", "server", "client")
        for path in (ROOT / room).rglob("*")
        if path.suffix in (".py", ".rs") and "target" not in path.parts
    ]
    return [path for path in found if not any(other in str(path.relative_to(ROOT)) for other in OTHERS)]


@pytest.fixture(scope="module")
def names(sources) -> set[str]:
    """All identifiers of the sources, in small letters with spaces between their words and around them."""
    taken = {".py": of_python, ".rs": of_rust}
    found = {name for path in sources for name in taken[path.suffix](path.read_text())}
    assert len(found) > 3000
    return {f" {' '.join(words(name)).lower()} " for name in found}


@pytest.fixture(scope="module")
def told(sources) -> set[str]:
    """All that is told to users, with spaces between its words and around them."""
    texts = {text for path in sources if path.suffix == ".py" for text in said(path.read_text())}
    return {f" {' '.join(re.findall(r'[a-z]+', text.lower()))} " for text in texts}


def used(name: str, names: set[str]) -> list[str]:
    """The names with that term in them, or with more than one of it."""
    return [known for known in names if f" {name} " in known or f" {name}s " in known]


@pytest.mark.parametrize("term", [row[0] for row in rows()])
def test_each_term_is_a_name_in_the_code_or_told_to_users(term, names, told):
    # A world of one kind is named by the kind: `confirmed`.
    assert used(term.removesuffix(" world"), names | told)


@pytest.mark.parametrize("never", [name for row in rows() for name in filter(None, row[2].split(", "))])
def test_no_second_name_is_in_the_code(never, names):
    assert used(never, names) == []


def test_terms_are_told_once():
    terms = [name for row in rows() for name in (row[0], *filter(None, row[2].split(", ")))]
    assert len(terms) == len(set(terms)) > 40
    assert all(len(row) == 3 for row in rows())
