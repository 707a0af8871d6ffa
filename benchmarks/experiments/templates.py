"""The shipped carton's template with something taken away."""

from __future__ import annotations

import json
import tomllib
from importlib.resources import files
from typing import Any

from boxwright import _core

Spec = dict[str, Any]
"""A template as `tomllib` reads it."""


def carton() -> Spec:
    """The carton as it is shipped."""
    return tomllib.loads((files("boxwright.models") / "templates" / "carton.toml").read_text(encoding="utf-8"))


def terms(spec: Spec) -> list[str]:
    """Names of features, then of relations."""
    return [term["name"] for term in spec["feature"] + spec["relation"]]


def without_term(spec: Spec, name: str) -> Spec:
    """The template without a feature or relation."""
    kept = {key: [term for term in spec[key] if term["name"] != name] for key in ("feature", "relation")}
    return spec | kept


def with_pairs(spec: Spec, pairs: set[frozenset[str]]) -> Spec:
    """The template with relations between these pairs of parts alone."""
    relations = []
    for term in spec["relation"]:
        left = [pair for pair in term["pairs"] if frozenset(pair) in pairs]
        if left:
            relations.append(term | {"pairs": left})
    return spec | {"relation": relations}


def with_parts(spec: Spec, parts: tuple[str, ...]) -> Spec:
    """The template of these parts alone: without symmetries, and with a body that is no box."""
    kept = {part: part for part in parts}
    features = [term | {"parts": [p for p in term["parts"] if p in kept]} for term in spec["feature"]]
    pairs = {frozenset((a, b)) for a in parts for b in parts if a != b}
    out = with_pairs(spec, pairs) | {
        "part": [part for part in spec["part"] if part["name"] in kept],
        "joint": [joint for joint in spec["joint"] if {joint["parent"], joint["child"]} <= set(kept)],
        "feature": [term for term in features if term["parts"]],
        "symmetry": [],
        "accept": spec["accept"] | {"require": []},
    }
    del out["body"]
    return out


def built(spec: Spec) -> _core.Template:
    """The template, ready for use. Raises ValueError naming the key that does not fit."""
    return _core.Template("\n".join(f"{key} = {_toml(value)}" for key, value in spec.items()) + "\n")


def _toml(value: object) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return json.dumps(value)
