"""`boxwright explain`: what a model's score is made of, and what it was chosen against."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import MODEL, JsonOption, ModelOptions, ReadOptions, SceneOptions

if TYPE_CHECKING:
    from boxwright.cli.explain_report import Reason
    from boxwright.pipeline import Inferred
    from boxwright.types import Cloud

PAPER = "paper"
"""The method whose search is staged; others prove their answers."""
FITTED = "fitted"
"""The method that judges whole boxes where it can."""


@grouped
def explain(
    source: Annotated[
        Path, typer.Argument(metavar="CLOUD|MODEL", help="A cloud; or a model.json, or a folder that holds one.")
    ],
    model: ModelOptions,
    reading: ReadOptions,
    scene: SceneOptions,
    search: Annotated[
        Literal["staged", "exact"] | None,
        typer.Option(
            "--search",
            help="How the best assignments are found: the paper's list, or proven. Default: the method's; "
            "not for whole boxes.",
            rich_help_panel=MODEL,
        ),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Say why each object scores as it does: every feature's value, weight and share of the score.

    A share is weight x value; the shares sum to the score. Angles in radians, distances in metres.

    [bold]fitted[/] (default): the score is the log odds that this is a box, the shares are what speaks for and against
    it; trees is what all trees add (docs/maths.md, eq. 90). Each box is judged by itself, so none came second. A cloud
    without an image or a viewpoint goes by assignments, as with exact.

    [bold]exact[/], [bold]paper[/]: the score is J(G) of the assignment of segments to parts (eq. 1), the shares are
    those of the template's features and relations. Of a cloud, it says too which assignment came second, and which
    terms decided between the two; segments are numbered as in the picture that boxwright segment draws with the same
    options.

    [bold]Examples[/]

    boxwright explain frame.pcd

    boxwright explain frame.pcd --method exact

    boxwright infer frame.pcd -o out && boxwright explain out/frame
    """
    from boxwright.cli.explain_report import print_json, print_reasons

    if source.is_dir() or source.suffix == ".json":
        _refuse_options((model, ModelOptions()), (reading, ReadOptions()), (scene, SceneOptions()), (search, None))
        path, reasons, planes = *_of_model(source), None
    else:
        path, planes = source, _planes(model, scene)
        reasons = _of_cloud(source, model, reading, scene, planes, search)
    if as_json:
        print_json(reasons)
    else:
        print_reasons(reasons, path, planes)


def _refuse_options(*given: tuple[object, object]) -> None:
    """Options without an effect are mistakes."""
    if any(value != default for value, default in given):
        raise typer.BadParameter(
            "a model is explained as it stands; these options are for clouds, leave them out", param_hint="MODEL"
        )


def _of_model(source: Path) -> tuple[Path, list[Reason]]:
    from boxwright.cli.explain_report import Reason
    from boxwright.io.models import load_model

    path = source / "model.json" if source.is_dir() else source
    model = load_model(path)
    for k, found in enumerate(model.objects):
        if not found.score_terms and model.method != FITTED:
            raise ValueError(f"{path}: objects[{k}]: score_terms: is empty; infer the cloud anew to have them")
    return path, [Reason(found) for found in model.objects]


def _planes(model: ModelOptions, scene: SceneOptions) -> str:
    from boxwright.pipeline import PLANES_OF_METHOD

    return scene.planes or PLANES_OF_METHOD[model.method_name]


def _of_cloud(
    path: Path,
    model: ModelOptions,
    reading: ReadOptions,
    scene: SceneOptions,
    planes: str,
    search: Literal["staged", "exact"] | None,
) -> list[Reason]:
    from boxwright.cli.failures import warn
    from boxwright.pipeline import infer

    cloud = reading.read(path)
    if search is not None:
        _refuse_search(model.method_name, cloud)
    inferred = infer(
        cloud,
        method=model.method_name,
        templates=model.template_names,
        weights=model.weights,
        up=scene.up,
        roi=scene.roi,
        planes=planes,
        search=None if search is None else {"search": search},
    )
    for line in inferred.model.warnings:
        warn(f"{path}: warning: {line}")
    return _reasons(inferred, model, planes, search or ("staged" if model.method_name == PAPER else "exact"))


def _refuse_search(method: str, cloud: Cloud) -> None:
    """Where whole boxes are judged nothing is searched that a user could choose."""
    if method == FITTED and cloud.organized and cloud.viewpoint is not None:
        raise typer.BadParameter(
            "with an image and a viewpoint the method fitted judges whole boxes and searches no assignment; leave it "
            "out, or add --method exact or paper",
            param_hint="--search",
        )


def _reasons(inferred: Inferred, model: ModelOptions, planes: str, search: Literal["staged", "exact"]) -> list[Reason]:
    """Why each object; of assignments with what came second, of whole boxes and of boxes told anew without."""
    from boxwright.cli.explain_report import Reason
    from boxwright.models import load_template, load_weights, shipped_for
    from boxwright.pipeline import PLANES_OF_METHOD
    from boxwright.runner_up import is_judged_whole, runner_up, segments_of

    shipped = shipped_for(model.method_name, planes if model.weights is None else PLANES_OF_METHOD[model.method_name])
    templates = {loaded.name: loaded for loaded in (load_template(name, shipped) for name in model.template_names)}
    reasons = []
    for k, found in enumerate(inferred.model.objects):
        if is_judged_whole(found) or not found.score_terms:
            reasons.append(Reason(found))
            continue
        weights = load_weights(model.weights or found.template, shipped)
        second = runner_up(inferred, k, templates[found.template], weights, search)
        reasons.append(Reason(found, segments_of(inferred, k), search, second))
    return reasons
