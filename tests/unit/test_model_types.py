"""The types of model.json: what they take, what they refuse, and how they say it."""

from __future__ import annotations

import copy
from collections.abc import Callable
from typing import Any

import msgspec
import pytest

from boxwright.types import Model
from support.sample_model import sample_model

Change = Callable[[dict[str, Any]], None]


def test_sample_survives_a_round_trip() -> None:
    model = msgspec.convert(sample_model(), Model)
    assert msgspec.json.decode(msgspec.json.encode(model), type=Model) == model
    assert model.objects[0].part("flap_0").points == 500
    assert model.objects[1].pose is None


def test_unknown_keys_are_ignored() -> None:
    data = sample_model()
    data["later"] = 1
    data["objects"][0]["joints"][0]["later"] = {"a": []}
    assert msgspec.convert(data, Model) == msgspec.convert(sample_model(), Model)


def joint(data: dict[str, Any]) -> dict[str, Any]:
    first: dict[str, Any] = data["objects"][0]["joints"][0]
    return first


BAD: list[tuple[str, Change, str]] = [
    ("format", lambda d: d.update(format="other"), "format"),
    ("version", lambda d: d.update(version=2), "version"),
    ("up", lambda d: d.update(up=[0, 0, 2]), "up has length 2"),
    ("support", lambda d: d["support_plane"].update(normal=[0, 0, 0]), "normal has length 0"),
    ("axis", lambda d: joint(d).update(axis=[1, 1, 0]), "axis has length 1.41421356"),
    ("limits", lambda d: joint(d).update(limits=[1, -1]), "the lower must be below"),
    ("parent", lambda d: joint(d).update(parent="side_9"), "no part with corners"),
    ("child", lambda d: joint(d).update(child="base"), "no part with corners"),
    ("circle", lambda d: joint(d).update(parent="flap_0"), "in a circle"),
    ("name", lambda d: d["objects"][0]["parts"][0].update(name="side 0"), "a name is a letter"),
    ("same name", lambda d: d["objects"][0]["parts"][1].update(name="side_0"), "more than once"),
    ("observed", lambda d: d["objects"][0]["parts"][1].update(corners=None), "has no corners"),
    ("corners", lambda d: d["objects"][0]["parts"][0]["corners"].pop(), "corners"),
    ("nan", lambda d: joint(d).update(position=float("nan")), "must be finite"),
    ("infinity", lambda d: d["objects"][0].update(score=float("inf")), "must be finite"),
    ("probability", lambda d: d["objects"][0].update(probability=1.5), "lies in 0..1"),
    ("state", lambda d: d["objects"][0]["parts"][0]["state"].update(seen=1.0), "must sum to 1"),
    ("dimensions", lambda d: d["objects"][0].update(dimensions=[0.4, 0, 0.2]), "must be above 0"),
    ("quaternion", lambda d: d["objects"][0]["pose"].update(orientation=[0, 0, 0, 2]), "must be a unit vector"),
    ("gap", lambda d: d["objects"][0]["inference"].update(gap=1.0), "must be 0 there"),
    ("sigma", lambda d: joint(d)["sigma"].update(axis=-1), "0 or more"),
    ("seconds", lambda d: d["seconds"].update(total=-1), "0 or more"),
    ("missing key", lambda d: d["objects"][0].pop("score"), "score"),
]


@pytest.mark.parametrize(("change", "message"), [case[1:] for case in BAD], ids=[case[0] for case in BAD])
def test_bad_values_are_refused_with_a_reason(change: Change, message: str) -> None:
    data = copy.deepcopy(sample_model())
    change(data)
    with pytest.raises(msgspec.ValidationError, match=message):
        msgspec.convert(data, Model)


def test_each_refusal_is_a_case_of_its_own() -> None:
    assert len({case[0] for case in BAD}) == len(BAD) == 23
