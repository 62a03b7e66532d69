"""Randomly altered scenes are read, or refused in one line."""

import pytest
import yaml
from fuzzing import check, searching
from hypothesis import given
from hypothesis import strategies as st

import planetary_twin_py as pt
from planetary_twin_py.scene import SceneError
from planetary_twin_py.scene.load import packaged_scenes

pytestmark = [pytest.mark.exhaustive, pytest.mark.filterwarnings("ignore")]

SOUND = [pt.load_scene(name).model_dump(mode="json") for name in packaged_scenes()]
SCALARS = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.integers(-3, 300),
    st.floats(),
    st.floats(1e-9, 1e9),
    st.text(max_size=20),
    st.dates(),
    st.binary(max_size=8),
    st.sampled_from(["1e999", "-1 mm", "5 furlong", "20 degC", "1e-7 m", "nan", "paper", "10 N*m"]),
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=4),
        st.dictionaries(st.text(max_size=8) | SCALARS, inner, max_size=4),
    ),
    max_leaves=10,
)


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    return tmp_path_factory.mktemp("fuzzed") / "scene.yaml"


def places(value, path=()):
    """Paths of all values below one."""
    inner = value.items() if isinstance(value, dict) else enumerate(value)
    for key, below in inner:
        yield (*path, key)
        if isinstance(below, dict | list):
            yield from places(below, (*path, key))


@st.composite
def changed(draw):
    """A packaged scene with up to three values replaced, removed, or moved to another key."""
    scene = yaml.safe_load(yaml.safe_dump(draw(st.sampled_from(SOUND))))
    for _ in range(draw(st.integers(1, 3))):
        *above, last = draw(st.sampled_from(list(places(scene))))
        inner = scene
        for key in above:
            inner = inner[key]
        way = draw(st.sampled_from(["value", "value", "number", "key", "none"]))
        if way == "value":
            inner[last] = draw(VALUES)
        elif way == "number":
            inner[last] = draw(st.floats(-1e3, 1e3))
        elif way == "key" and isinstance(inner, dict):
            inner[draw(st.text(max_size=8))] = inner.pop(last)
        else:
            del inner[last]
    return scene


def read(file):
    check(lambda: pt.load_scene(file), SceneError)


@searching
@given(scene=changed())
def test_a_scene_with_other_values_is_read_or_refused(file, scene):
    file.write_text(yaml.safe_dump(scene, allow_unicode=True), "utf-8")
    read(file)


@searching
@given(text=st.text(alphabet="ab:-[]{}&*!<>|?#%@`'\", \n\t0123456789.~e_xb", max_size=60))
def test_a_text_of_yaml_characters_is_read_or_refused(file, text):
    file.write_text(text, "utf-8")
    read(file)
