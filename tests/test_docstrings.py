"""Docstrings of the public names: every parameter, result and field is described."""

import ast
import inspect
import re

import pydantic
import pytest

import planetary_twin_py as pt

PUBLIC = [getattr(pt, name) for name in pt.__all__]
COMPILED = [pt.PortStates]
CLASSES = [public for public in PUBLIC if inspect.isclass(public) and public not in COMPILED]


def sections(docstring):
    """Text of the sections of a Google-style docstring by name; the part before them is ''."""
    found, name = {"": []}, ""
    for line in inspect.cleandoc(docstring or "").splitlines():
        heading = re.fullmatch(r"(Args|Returns|Raises|Warns|Yields):", line)
        name = heading[1] if heading else name
        found.setdefault(name, []).append("" if heading else line)
    return {name: "\n".join(lines) for name, lines in found.items()}


def described(arguments):
    """Names that an Args section describes."""
    return set(re.findall(r"^    \*{0,2}(\w+): \S", arguments, re.MULTILINE))


def own_functions(public):
    """Public functions and methods that the class itself defines, with the docstring of each."""
    if inspect.isfunction(public):
        yield public.__name__, public, public.__doc__
        return
    for name, member in vars(public).items():
        function = member.__func__ if isinstance(member, (classmethod, staticmethod)) else member
        written = inspect.isfunction(function) and is_written_in(function, public)
        if written and name == "__init__":
            yield f"{public.__name__}.__init__", function, public.__doc__
        elif written and not name.startswith("_"):
            yield f"{public.__name__}.{name}", function, function.__doc__


def is_written_in(function, cls):
    """Whether a function is in the source of a class; those of dataclasses are generated."""
    return function.__code__.co_filename == inspect.getsourcefile(cls)


FUNCTIONS = [
    found
    for public in PUBLIC
    if inspect.isfunction(public) or inspect.isclass(public)
    for found in own_functions(public)
]


def faults_of(function, docstring):
    """What the docstring of a function lacks."""
    parts = sections(docstring)
    parameters = [name for name in inspect.signature(function).parameters if name != "self"]
    missing = set(parameters) - described(parts.get("Args", ""))
    unknown = described(parts.get("Args", "")) - set(parameters)
    faults = [f"{name} is not described" for name in sorted(missing)]
    faults += [f"{name} is not a parameter" for name in sorted(unknown)]
    returns = inspect.signature(function).return_annotation not in (None, "None")
    if returns and not parts.get("Returns", "").strip():
        faults.append("no Returns section")
    return faults


def field_docstrings(cls):
    """String below each annotated field in the source of a class, by name of the field."""
    (tree,) = ast.parse(inspect.getsource(cls)).body
    texts = {}
    for statement, after in zip(tree.body, [*tree.body[1:], None], strict=True):
        if isinstance(statement, ast.AnnAssign):
            text = isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant)
            texts[statement.target.id] = after.value.value if text else ""
    return texts


def undescribed_fields(cls):
    """Fields without a docstring below them or an entry in the docstring of the class."""
    if issubclass(cls, pydantic.BaseModel):
        return [name for name, field in cls.model_fields.items() if not field.description]
    entries = described(sections(cls.__doc__).get("Args", ""))
    return [n for n, text in field_docstrings(cls).items() if not text and n not in entries]


@pytest.mark.parametrize(
    ("name", "function", "docstring"), FUNCTIONS, ids=[f[0] for f in FUNCTIONS]
)
def test_parameters_and_result_are_described(name, function, docstring):
    assert faults_of(function, docstring) == []


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_fields_are_described(cls):
    assert undescribed_fields(cls) == []


@pytest.mark.parametrize("cls", COMPILED, ids=lambda cls: cls.__name__)
def test_fields_of_a_compiled_class_are_described_with_their_units(cls):
    texts = {name: field.__doc__ for name, field in vars(cls).items() if name[0] != "_"}
    assert cls.__doc__
    assert len(texts) > 6
    assert [
        n for n, text in texts.items() if n != "copy" and not re.search(r" \[.+\]\.", text)
    ] == []


def test_every_public_function_is_examined():
    examined = {name for name, _, _ in FUNCTIONS}
    assert {n for n in pt.__all__ if inspect.isfunction(getattr(pt, n))} <= examined
    assert {"Twin.__init__", "Twin.advance", "Scene.replace", "Tunable.within"} <= examined
    assert set(field_docstrings(pt.Energy)) >= {"machines", "stored"}


def example(value: float, unit: str = "m") -> float:
    """An example.

    Args:
        value: a number.
        units: its unit.
    """
    return value


class Example:
    """An example."""

    first: float
    """Described."""
    second: float


def test_what_is_missing_is_found():
    assert faults_of(example, example.__doc__) == [
        "unit is not described",
        "units is not a parameter",
        "no Returns section",
    ]
    assert undescribed_fields(Example) == ["second"]
