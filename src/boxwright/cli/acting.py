"""A plan in physics as `close` and `simulate` carry it out: at one go, or flap by flap with looks between."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from boxwright.replanning import Looked
    from boxwright.simulation.physics import Run, Staged
    from boxwright.types import Cloud, Model, Plan

SEED = 0
"""Of the simulated sensor's noise, look by look."""


class Acted:
    """What came of it: the run, the flaps that were to be closed, and with looks what was seen and planned at each."""

    def __init__(self, run: Run, order: tuple[str, ...], looked: Looked | None) -> None:
        self.run, self.order, self.looked = run, order, looked

    def save_looks(self, folder: Path) -> list[Path]:
        """Writes each look's model and plan, the first model being the folder's own; the files that were written."""
        from boxwright.io.models import save_model
        from boxwright.io.plans import save_plan

        files = []
        for number, step in enumerate(self.looked.steps if self.looked else (), start=1):
            look = folder / f"look_{number}"
            look.mkdir(exist_ok=True)
            save_model(step.model, look / "model.json")
            save_plan(step.plan, look / "plan.json")
            files += [look / "model.json", look / "plan.json"]
        return files


def act_at_once(staged: Staged, plan: Plan, crease: str) -> Acted:
    """Follows the whole plan; raises ValueError where it has no motion."""
    from boxwright.simulation.physics import require_motion, run_of

    require_motion(plan)
    staged.session.follow(plan.segments)
    return Acted(run_of(staged.session, crease, staged.kind), plan.order, None)


def act_looking(
    staged: Staged,
    plan: Plan,
    model: Model,
    crease: str,
    infer: Callable[[Cloud], Model],
    robot: str | Path,
    **planning: Any,
) -> Acted:
    """Closes the first flap of the plan, looks, plans anew, and so on; `planning` goes to `plan_closing`."""
    import numpy as np

    from boxwright.replanning import close_by_looking
    from boxwright.simulation.physics import LiveBox, run_of

    base_from_input = np.array(plan.base_from_input)
    live = LiveBox(staged.session, base_from_input, staged.others, SEED)
    looked = close_by_looking(
        model, robot, base_from_input, live, infer, object_index=plan.object, method=plan.method, **planning
    )
    return Acted(run_of(staged.session, crease, staged.kind), live.pushed, looked)
