"""`boxwright train`: weights of a template from labelled frames."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from boxwright.cli.options import JobsOption, JsonOption, MethodOption, PlanesOption

if TYPE_CHECKING:
    from boxwright.evaluation import SetEntry
    from boxwright.learning import SeenFrame


LEARNER_OF_METHOD: dict[str, Literal["ridge", "margin", "likelihood"]] = {
    "paper": "ridge",
    "exact": "margin",
    "fitted": "margin",
}


def train(
    folders: Annotated[list[Path], typer.Argument(metavar="SET...", help="Folders of labelled frames.")],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="FILE", help="Weights file to write.")],
    template: Annotated[
        str | None,
        typer.Option(
            "--template",
            metavar="NAME|FILE.toml",
            help="Template whose weights are learned. The method fitted judges boxes of every template and takes none.",
        ),
    ] = None,
    category: Annotated[
        list[str] | None,
        typer.Option("--category", help="Learn from frames of this category alone; repeatable. Default: all."),
    ] = None,
    lying: Annotated[
        list[Path] | None,
        typer.Option(
            "--lying",
            metavar="SET",
            help="Frames of boxes on their side, from which only how such boxes are judged is learnt; repeatable. "
            "--method fitted.",
        ),
    ] = None,
    method: MethodOption = None,
    learner: Annotated[
        Literal["ridge", "margin", "likelihood"] | None,
        typer.Option(
            "--learner",
            help="ridge: the paper's normal equations. margin, likelihood: on exact inference, with calibrated "
            "probabilities. Default: ridge for the method paper, margin for exact.",
        ),
    ] = None,
    prior: Annotated[
        str | None,
        typer.Option(
            "--prior",
            metavar="NAME|FILE.json",
            help="Draw the weights towards these: a shipped template's of the method, or a file. For few frames.",
        ),
    ] = None,
    leave_one_out: Annotated[
        bool, typer.Option("--leave-one-out", help="Judge each frame by weights fitted without it, and tell.")
    ] = False,
    planes: PlanesOption = None,
    jobs: JobsOption = None,
    as_json: JsonOption = False,
) -> None:
    """Learn a template's weights from labelled frames; how strongly they are regularized, held-out frames decide.

    About ten frames teach a new kind of box in seconds, given a prior. Frames that cannot be used are told on standard
    error and left out. Same frames, same weights.

    [bold]Examples[/]

    boxwright synth train_set --count 120 --seed 1

    boxwright train train_set --template carton -o carton.json

    boxwright infer frame.pcd -o out --template carton --weights carton.json

    boxwright train train_set empty_set --method fitted -o judgement.json

    boxwright train ten_frames --template tote.toml --method exact --prior carton --leave-one-out -o tote.json
    """
    import shlex
    import sys

    from boxwright.cli.train_report import print_json, print_learned
    from boxwright.learning import train as learn
    from boxwright.models import load_template, load_weights, shipped_for
    from boxwright.parallel import processors
    from boxwright.pipeline import PLANES_OF_METHOD

    method = method or ("fitted" if template is None else "paper")
    if method == "fitted":
        if learn_judgement_of(folders, lying or [], output, jobs, as_json):
            raise typer.Exit(1)
        return
    if lying:
        raise typer.BadParameter("only the method fitted tells boxes that lie", param_hint="--lying")
    if template is None:
        raise typer.BadParameter("name the template whose weights are learned", param_hint="--template")
    planes = planes or PLANES_OF_METHOD[method]
    shipped = shipped_for(method, PLANES_OF_METHOD[method])
    loaded = load_template(template, shipped)
    known = None if prior is None else load_weights(prior, shipped)
    frames, refused = frames_of(folders, category, planes, jobs)
    command = shlex.join(["boxwright", *sys.argv[1:]])
    learned = learn(
        loaded,
        frames,
        command=command,
        learner=learner or LEARNER_OF_METHOD[method],
        prior=known,
        with_leave_one_out=leave_one_out,
        jobs=jobs or processors(),
        progress=lambda line: print(line, file=sys.stderr, flush=True),
    )
    learned.save(output)
    if as_json:
        print_json(learned)
    else:
        print_learned(learned, output)
    if refused:
        raise typer.Exit(1)


def learn_judgement_of(folders: list[Path], lying: list[Path], output: Path, jobs: int | None, as_json: bool) -> int:
    """Learns by what fitted boxes are judged, and tells it; how many frames could not be used."""
    import shlex
    import sys

    import msgspec

    from boxwright.cli.failures import tell
    from boxwright.evaluation import list_set
    from boxwright.learning import learn_judgement
    from boxwright.parallel import processors

    refused: list[Path] = []

    def refuse(entry: SetEntry, error: ValueError | OSError) -> None:
        refused.append(entry.cloud_path)
        tell(error, entry.cloud_path)

    learned = learn_judgement(
        [entry for folder in folders for entry in list_set(folder)],
        [entry for folder in lying for entry in list_set(folder)],
        command=shlex.join(["boxwright", *sys.argv[1:]]),
        jobs=jobs or processors(),
        progress=lambda line: print(line, file=sys.stderr, flush=True),
        refuse=refuse,
    )
    learned.save(output)
    report = learned.training
    if as_json:
        print(msgspec.json.encode(learned).decode())
    else:
        print(
            f"{output}: learned on {report.frames} frames, {report.boxes} boxes of which {report.false_boxes} false, "
            f"{report.parts} panels of which {report.wrong_parts} wrong"
        )
    return len(refused)


def frames_of(
    folders: list[Path], categories: list[str] | None, planes: str | None, jobs: int | None
) -> tuple[list[SeenFrame], int]:
    """The frames of all sets after perception, and how many could not be used."""
    from boxwright.cli.failures import tell
    from boxwright.cli.screen import progress
    from boxwright.evaluation import list_set
    from boxwright.parallel import ordered_map, processors

    entries = [entry for folder in folders for entry in list_set(folder)]
    seen = ordered_map(lambda entry: _look(entry, categories, planes), entries, jobs or processors())
    frames, refused = [], 0
    for entry, frame in zip(entries, progress(seen, len(entries), "perception"), strict=True):
        if isinstance(frame, (ValueError, OSError)):
            refused += 1
            tell(frame, entry.cloud_path)
        elif frame is not None:
            frames.append(frame)
    return frames, refused


def _look(entry: SetEntry, categories: list[str] | None, planes: str | None) -> SeenFrame | ValueError | OSError | None:
    """One frame after perception; None where its category is not asked for, the error where it cannot be used."""
    from functools import partial

    from boxwright.evaluation import read_entry
    from boxwright.io.clouds import read_cloud
    from boxwright.learning import SeenFrame
    from boxwright.perception import perceive

    try:
        labelled = read_entry(entry)
        if categories and labelled.truth.category not in categories:
            return None
        perception = perceive(read_cloud(entry.cloud_path), planes=planes)
        if len(perception.labels) != len(labelled.labels):
            count, points = len(labelled.labels), len(perception.labels)
            raise ValueError(
                f"{entry.labels_path}: labels: has {count}; must be as many as the cloud's {points} points"
            )
    except (ValueError, OSError) as error:
        return error
    read = partial(read_cloud, entry.cloud_path)
    return SeenFrame(entry.name, perception, labelled.truth, labelled.labels, read, planes)
