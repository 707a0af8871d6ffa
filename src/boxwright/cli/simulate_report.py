"""What `boxwright simulate` prints and draws."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from boxwright.simulation.physics import Run
    from boxwright.types import FlapVerdict, Plan, Simulation

NOT_CLOSED = 3
"""Exit status when some flap was not closed (docs/formats.md)."""


def all_held(simulation: Simulation, order: Sequence[str]) -> bool:
    """Is every flap that was planned closed at the end? False for a run that proves nothing."""
    return simulation.failure is None and all(
        name in simulation.flaps and simulation.flaps[name].held for name in order
    )


def all_closed(simulation: Simulation) -> bool:
    """Is every flap that the box has closed at the end, planned or not? False for a run that proves nothing."""
    flaps = [flap for name, flap in simulation.flaps.items() if name.startswith("flap")]
    return simulation.failure is None and all(flap.held for flap in flaps)


def all_as_planned(simulation: Simulation, plan: Plan) -> bool:
    """Is every flap of the plan closed at the end, planned or not, but for hidden ones that a true box does not have?

    Which flaps the box has of which a model was inferred, nobody knows.
    """
    from boxwright.cli.plan_report import exit_status

    lacking = plan.flaps.keys() - simulation.flaps.keys() if simulation.box == "true" else ()
    return not exit_status(plan, lacking) and all_held(simulation, plan.order)


def draw(run: Run, folder: Path, *, picture: bool, video: bool) -> list[Path]:
    """The pictures that were asked for; raises OSError where nothing can draw."""
    if not (picture or video):
        return []
    from boxwright.simulation.physics.pictures import save_film, save_strip

    files = []
    for wanted, save, name in ((picture, save_strip, "simulation.png"), (video, save_film, "simulation.gif")):
        if wanted:
            files.append(folder / name)
            save(run, files[-1])
    return files


def print_run(simulation: Simulation, order: Sequence[str], files: Sequence[Path], *, as_json: bool) -> None:
    """A table of flaps and a line of what else happened; or the record itself."""
    import msgspec

    from boxwright.cli.screen import console, table

    if as_json:
        print(msgspec.json.encode(simulation).decode())
        return
    rows = table(f"{simulation.robot}, {simulation.box} box, {simulation.crease} creases", "flap", *_COLUMNS)
    for name, flap in simulation.flaps.items():
        rows.add_row(name, *_cells(flap, name in order))
    screen = console()
    screen.print(rows)
    for line in _lines(simulation):
        screen.print(line, soft_wrap=True)
    for path in files:
        print(path)


_COLUMNS = ("planned", "before, deg", "pushed to", "after", "at the end", "closed", "held")


def _cells(flap: FlapVerdict, planned: bool) -> tuple[str, ...]:
    import math

    from boxwright.cli.screen import number

    angles = (flap.before_rad, flap.pushed_to_rad, flap.after_rad, flap.end_rad)
    degrees = [number(None if angle is None else math.degrees(angle)) for angle in angles]
    return (_yes(planned), *degrees, _yes(flap.closed), _yes(flap.held))


def _yes(value: bool) -> str:
    return "yes" if value else "no"


def _lines(simulation: Simulation) -> list[str]:
    import math

    speed = simulation.simulated_s / simulation.seconds if simulation.seconds else 0.0
    lines = [
        f"box of {simulation.mass_kg:.2f} kg slid {1e3 * simulation.box_slid_m:.1f} mm, "
        f"turned {math.degrees(simulation.box_turned_rad):.1f} deg; pressed with at most "
        f"{simulation.max_force_n:.1f} N; sank in {1e3 * simulation.max_penetration_m:.2f} mm",
        f"{simulation.simulated_s:.1f} s in {simulation.seconds:.1f} s, {speed:.0f} times real time",
    ]
    lines += [simulation.stopped.line()] if simulation.stopped else []
    lines += [f"touched and should not have: {first}, {second}" for first, second in simulation.unwanted]
    lines += [f"warning: {warning}" for warning in simulation.warnings]
    return lines if simulation.failure is None else [*lines, f"proves nothing: {simulation.failure}"]
