"""`boxwright explain`: what a model's score is made of, and what it was chosen against."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import MODEL, JsonOption, ModelOptions, ReadOptions, SceneOptions

if TYPE_CHECKING:
    from boxwright.cli.explain_report import Reason

PAPER = "paper"
"""The method whose search is staged; others prove their answers."""


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
            help="How the best are found: the paper's list, or proven. Default: the method's.",
            rich_help_panel=MODEL,
        ),
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Say why each object scores as it does: every feature's value, weight and share of the score.

    A share is weight x value; the shares sum to the score J(G). Angles in radians, distances in metres. Of a cloud, it
    says too which assignment came second, and which terms decided between the two; segments are numbered as in the
    picture that boxwright segment draws with the same options.

    [bold]Examples[/]

    boxwright explain frame.pcd --search exact

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
    objects = load_model(path).objects
    for k, found in enumerate(objects):
        if not found.score_terms:
            raise ValueError(f"{path}: objects[{k}]: score_terms: is empty; infer the cloud anew to have them")
    return path, [Reason(found) for found in objects]


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
    from boxwright.cli.explain_report import Reason
    from boxwright.models import load_template, load_weights, shipped_for
    from boxwright.pipeline import PLANES_OF_METHOD, infer
    from boxwright.runner_up import runner_up, segments_of

    method = model.method_name
    inferred = infer(
        reading.read(path),
        method=method,
        templates=model.template_names,
        weights=model.weights,
        up=scene.up,
        roi=scene.roi,
        planes=planes,
        search=None if search is None else {"search": search},
    )
    used = search or ("staged" if method == PAPER else "exact")
    shipped = shipped_for(method, planes if model.weights is None else PLANES_OF_METHOD[method])
    templates = {loaded.name: loaded for loaded in (load_template(name, shipped) for name in model.template_names)}
    reasons = []
    for k, found in enumerate(inferred.model.objects):
        weights = load_weights(model.weights or found.template, shipped)
        second = runner_up(inferred, k, templates[found.template], weights, used)
        reasons.append(Reason(found, segments_of(inferred, k), used, second))
    return reasons
