"""From what a schema found wrong to one error that names source, key, value and bound."""

from __future__ import annotations

import difflib
import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import wraps
from typing import NamedTuple, TypeVar, get_type_hints

from pydantic import ValidationError
from pydantic_core import ErrorDetails, InitErrorDetails, PydanticCustomError

from kuglice.errors import KugliceError, SceneError
from kuglice.schema.numbers import PAIR, SINGLE

__all__ = ["Problem", "raises", "refusal", "refuse", "told", "within"]

Schema = TypeVar("Schema", bound=type)
Raised = TypeVar("Raised", bound=KugliceError)
Key = tuple[int | str, ...]
SHOWN_CHARACTERS = 60
TAGGED = {
    "forces": ("gravity", "drag", "attractor", "spring", "thrust", "attract"),
    "groups": ("random", "lattice", "triangle", "listed"),
}
"""Lists whose items are told apart by a tag, which pydantic inserts into the key."""

WORDS = {
    "Value error, ": "",
    "Input should be": "must be",
    "must be a valid tuple": "must be an array",
    "must be a valid dictionary or object to extract fields from": "must be a table",
    "must be a valid dictionary or instance of ": "must be a table or a ",
    "Tuple should have": "must have",
    " item after validation": " item",
    " items after validation": " items",
}
"""What a schema says, and what is said of a file, in this order."""


class Problem(NamedTuple):
    """One thing that is wrong: where, what stands there, and what must hold."""

    key: Key
    value: object
    bound: str


def refusal(title: str, problems: Iterable[Problem]) -> ValidationError:
    """The error to raise from inside a validator; pydantic adds it to its own findings."""
    return ValidationError.from_exception_data(
        title,
        [
            InitErrorDetails(
                type=PydanticCustomError("bound", "{bound}", {"bound": problem.bound}),
                loc=problem.key,
                input=problem.value,
            )
            for problem in problems
        ],
    )


def refuse(title: str, problems: Sequence[Problem]) -> None:
    """Raise the problems from inside a validator, if there are any."""
    if problems:
        raise refusal(title, problems)


@contextmanager
def within(*key: int | str) -> Iterator[None]:
    """Problems that are refused inside have keys that start there."""
    try:
        yield
    except ValidationError as error:
        inner = error.errors(include_url=False)
        moved = [Problem((*key, *each["loc"]), each["input"], each["msg"]) for each in inner]
        raise refusal(error.title, moved) from None


def told(error: ValidationError, raised: type[Raised], source: str, keys: Iterable[str] = ()) -> Raised:
    """All findings as one error of this package. `keys` exist, and so may be what an unknown key meant."""
    known = tuple(keys)
    lines = tuple(_sentence(details, known) for details in error.errors(include_url=False))
    message = f"{source}: {lines[0]}"
    if len(lines) > 1:
        message = "\n  ".join([f"{source}: {len(lines)} problems", *lines])
    return raised(message, lines) if issubclass(raised, SceneError) else raised(message)


def raises(raised: type[KugliceError]) -> Callable[[Schema], Schema]:
    """Class decorator: a wrong argument raises this error instead of pydantic's own."""

    def decorate(schema: Schema) -> Schema:
        construct: Callable[..., None] = schema.__init__  # type: ignore[misc]

        # wraps copies pydantic's mark of an ordinary __init__ too, so nested schemas still report together.
        @wraps(construct)
        def __init__(self: object, *arguments: object, **named: object) -> None:  # noqa: N807
            try:
                construct(self, *arguments, **named)
            except ValidationError as error:
                keys = getattr(schema, "__pydantic_fields__", {})
                raise told(error, raised, schema.__name__, keys) from None

        schema.__init__ = __init__  # type: ignore[misc]
        schema.__signature__ = _readable(schema)  # type: ignore[attr-defined]
        return schema

    return decorate


def _readable(schema: type) -> inspect.Signature:
    """With plain types, as a notebook shows it: validators are for the schema."""
    types = get_type_hints(schema)
    signature = inspect.signature(schema)
    plain = [each.replace(annotation=types[name]) for name, each in signature.parameters.items()]
    return signature.replace(parameters=plain, return_annotation=inspect.Signature.empty)


def _sentence(details: ErrorDetails, keys: tuple[str, ...]) -> str:
    key, kind = details["loc"], details["type"]
    if kind in ("union_tag_invalid", "union_tag_not_found"):
        return _tag(details)
    if key and isinstance(key[0], int) and key[0] < len(keys):
        # An argument given by position.
        key = (keys[key[0]], *key[1:])
    if kind == "missing":
        return f"{_path(key)}: missing"
    if kind in ("extra_forbidden", "unexpected_keyword_argument"):
        near = difflib.get_close_matches(str(key[-1]), keys, n=1)
        guess = f"; did you mean {near[0]}?" if near else ""
        return f"{_path(key)} = {_shown(details['input'])}: no such key{guess}"
    message = details["msg"]
    for theirs, ours in WORDS.items():
        message = message.replace(theirs, ours)
    return f"{_path(key)} = {_shown(details['input'])}: {message}" if key else message


def _tag(details: ErrorDetails) -> str:
    """Of an item whose kind is none of those that there are."""
    known = TAGGED.get(str(details["loc"][0]) if details["loc"] else "", ())
    name = details["ctx"]["discriminator"].strip("'")
    path = _path((*details["loc"], name))
    listed = ", ".join(known) or details["ctx"].get("expected_tags", "")
    if details["type"] == "union_tag_not_found":
        return f"{path}: missing" + (f", must be one of {listed}" if listed else "")
    given = details["input"]
    tag = given[name] if isinstance(given, Mapping) else details["ctx"]["tag"]
    near = difflib.get_close_matches(str(tag), known, n=1)
    guess = f"; did you mean {near[0]}?" if near else ""
    return f"{path} = {_shown(tag)}: must be one of {listed}{guess}"


def _path(key: Key) -> str:
    if len(key) > 2 and key[2] in TAGGED.get(str(key[0]), ()):
        key = (*key[:2], *key[3:])
    key = tuple(part for part in key if part not in (SINGLE, PAIR))
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in key)
    return text.removeprefix(".")


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= SHOWN_CHARACTERS else text[: SHOWN_CHARACTERS - 3] + "..."
