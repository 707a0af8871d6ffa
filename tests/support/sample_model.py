"""A small hand-made model.json as plain data: one carton side with a flap that stands up, and one object half known."""

from __future__ import annotations

from typing import Any

SIDE: dict[str, Any] = {
    "name": "side_0",
    "observed": True,
    "state": {"seen": 0.75, "hidden": 0.25, "absent": 0.0},
    "seen_from": None,
    "corners": [[0.0, 0.0, 0.0], [0.4, 0.0, 0.0], [0.4, 0.0, -0.2], [0.0, 0.0, -0.2]],
    "points": 900,
    "probability": 0.9,
}
FLAP: dict[str, Any] = {
    "name": "flap_0",
    "observed": True,
    "state": None,
    "seen_from": None,
    "corners": [[0.0, 0.0, 0.0], [0.4, 0.0, 0.0], [0.4, 0.0, 0.1], [0.0, 0.0, 0.1]],
    "points": 500,
    "probability": 0.7,
}
ABSENT: dict[str, Any] = {
    "name": "base",
    "observed": False,
    "state": None,
    "seen_from": None,
    "corners": None,
    "points": 0,
    "probability": None,
}
HINGE: dict[str, Any] = {
    "name": "hinge_0",
    "type": "revolute",
    "parent": "side_0",
    "child": "flap_0",
    "origin": [0.2, 0.0, 0.0],
    "axis": [1.0, 0.0, 0.0],
    "position": 1.5707963267948966,
    "limits": [-1.5707963267948966, 4.71238898038469],
    "sigma": {"position": 0.01, "origin": [0.001, 0.001, 0.002], "axis": 0.005},
}


def sample_object() -> dict[str, Any]:
    """An object with everything told."""
    return {
        "template": "carton",
        "template_probability": 0.9,
        "score": 12.5,
        "score_terms": [{"name": "base_level", "kind": "phi 1", "value": 0.5, "weight": 2.0, "contribution": 1.0}],
        "probability": 0.8,
        "size": None,
        "inference": {"status": "optimal", "gap": 0.0, "alternatives": 3, "unsummed": None},
        "dimensions": [0.4, 0.3, 0.2],
        "outer_dimensions": [0.404, 0.304, 0.2],
        "thickness": 0.004,
        "pose": {"position": [0.0, 0.0, 1.0], "orientation": [0.0, 0.0, 0.0, 1.0]},
        "parameters": {"rack_rad": {"value": 0.01, "sigma": 0.002}, "flap_0_width_m": {"value": 0.1, "sigma": None}},
        "parts": [dict(SIDE), dict(FLAP), dict(ABSENT)],
        "joints": [dict(HINGE)],
    }


def sample_null_object() -> dict[str, Any]:
    """An object of the paper's method with one side only: all that may be null is null."""
    return {
        "template": "carton",
        "template_probability": None,
        "score": 2.0,
        "score_terms": [],
        "probability": None,
        "size": None,
        "inference": {"status": "gap", "gap": None, "alternatives": 0, "unsummed": None},
        "dimensions": None,
        "outer_dimensions": None,
        "thickness": None,
        "pose": None,
        "parameters": {},
        "parts": [dict(SIDE, state=None), dict(ABSENT)],
        "joints": [],
    }


def sample_model() -> dict[str, Any]:
    """A whole model.json with both objects."""
    return {
        "format": "boxwright.model",
        "version": 1,
        "method": "paper",
        "source": {"file": "frame.pcd", "points": 307200, "organized": True, "frames": []},
        "warnings": ["object 1: fewer than two sides, no URDF"],
        "seconds": {"read": 0.001, "stages": {"planes": 0.1, "inference": 0.2}, "total": 0.31},
        "up": [0.0, 0.0, 1.0],
        "support_plane": {"normal": [0.0, 0.0, 1.0], "distance": -0.5},
        "free_space": "no viewpoint",
        "objects": [sample_object(), sample_null_object()],
    }
