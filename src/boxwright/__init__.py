"""boxwright: from one depth frame of an open box to its articulated 3D model.

    cloud = boxwright.read_cloud("frame.pcd")
    model = boxwright.infer(cloud).model
    for k, found in enumerate(model.objects):
        boxwright.save_urdf(found, f"box_{k}.urdf")

Metres, radians and seconds throughout. Every coordinate is in the input's own frame (a depth camera's: x right,
y down, z forward). Names are loaded when they are first used.

- `Cloud`: points (N, 3) float32, metres; pixel (u, v) of an organized one is point v * width + u.
- `read_cloud(path, ...) -> Cloud`: PCD, PLY, NPY, or a depth PNG with its intrinsics.
- `infer(cloud, ...) -> Inferred`: the model, and the object and part of each point, (N,) int16, -1 for none.
- `infer_frames(frames, ...) -> Fused`: one model of several `PosedCloud`s: each a cloud and base_from_camera (4, 4).
- `read_poses(path)`: the files and poses of a TOML file that lists frames.
- `KnownSize`, `read_sizes(path)`: outer sizes of boxes, metres; `infer(cloud, method="fitted", sizes=...)` uses them.
- `segment(cloud, ...) -> Segmented`: the cloud's planar segments without meaning, as a record and as perceived.
- `Model`: panels (4 corners, metres), hinges (origin, axis, position in radians: 0 closed, growing as a flap opens).
- `load_model(path) -> Model`: a model.json.
- `save_urdf`, `save_mjcf`, `save_sdf(object, path, ...)`: one object of a model as URDF, MJCF or SDF.
- `plan_closing(model, robot, base_from_input, ...) -> Plan`: motions that close a box: metres, radians, seconds.
- `simulate(plan, model, truth, ...) -> Run`: a plan in physics: which flaps close and stay closed; needs the extra
  `physics`.
- `evaluate(folder, ...) -> Summary`: figures of merit on a labelled set: per cent, degrees, millimetres.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from boxwright.fusion import infer_frames
    from boxwright.io.clouds import read_cloud
    from boxwright.io.models import load_model
    from boxwright.io.poses import read_poses
    from boxwright.io.sizes import read_sizes
    from boxwright.kinematics import save_mjcf, save_sdf, save_urdf
    from boxwright.pipeline import infer
    from boxwright.planning import plan_closing
    from boxwright.scoring import evaluate
    from boxwright.segmentation import segment
    from boxwright.simulation.physics import simulate
    from boxwright.types import Cloud, KnownSize, Model, PosedCloud

__version__ = "0.1.0"

__all__ = [
    "Cloud",
    "KnownSize",
    "Model",
    "PosedCloud",
    "__version__",
    "evaluate",
    "infer",
    "infer_frames",
    "load_model",
    "plan_closing",
    "read_cloud",
    "read_poses",
    "read_sizes",
    "save_mjcf",
    "save_sdf",
    "save_urdf",
    "segment",
    "simulate",
]

_HOMES = {
    "Cloud": "boxwright.types",
    "KnownSize": "boxwright.types",
    "Model": "boxwright.types",
    "PosedCloud": "boxwright.types",
    "evaluate": "boxwright.scoring",
    "infer": "boxwright.pipeline",
    "infer_frames": "boxwright.fusion",
    "load_model": "boxwright.io.models",
    "plan_closing": "boxwright.planning",
    "read_cloud": "boxwright.io.clouds",
    "read_poses": "boxwright.io.poses",
    "read_sizes": "boxwright.io.sizes",
    "save_mjcf": "boxwright.kinematics",
    "save_sdf": "boxwright.kinematics",
    "save_urdf": "boxwright.kinematics",
    "segment": "boxwright.segmentation",
    "simulate": "boxwright.simulation.physics",
}


def __getattr__(name: str) -> Any:
    """Loads a public name from its home; `boxwright --help` needs none of them."""
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
