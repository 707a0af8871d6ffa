"""What docs/formats.md says of scores, probabilities and unseen parts, held against answers of the default method."""

from __future__ import annotations

import math

import boxwright
from boxwright.simulation import make_frame
from boxwright.types import Cloud


def test_scores_and_unseen_parts_are_as_the_page_says() -> None:
    boxes = hidden = flaps = 0
    for index, category in enumerate(("small", "carton", "medium", "large", "cake", "carton", "small", "medium")):
        frame = make_frame(category, 91, index, boxes=2)
        cloud = Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
        for found in boxwright.infer(cloud).model.objects:
            boxes += 1
            assert found.probability is not None
            assert math.isclose(found.probability, 1.0 / (1.0 + math.exp(-found.score)), abs_tol=1e-12)
            assert (found.inference.status, found.inference.gap) == ("gap", None)
            placed = {part.name for part in found.parts if part.corners is not None}
            assert {joint.child for joint in found.joints} == {name for name in placed if name[:4] in ("flap", "tuck")}
            for part in found.parts:
                if part.observed:
                    assert part.probability is not None
                    assert part.probability >= 0.5
                    assert part.state is not None
                    assert part.state.seen == part.probability
                    continue
                is_flap = part.name.startswith(("flap", "tuck"))
                assert (part.corners is None) == is_flap
                assert part.points == 0
                assert part.probability is None
                assert part.state is not None
                assert part.state.seen == 0.0
                hidden += not is_flap
                flaps += is_flap
    assert boxes >= 10
    assert min(hidden, flaps) >= 3, (hidden, flaps)
