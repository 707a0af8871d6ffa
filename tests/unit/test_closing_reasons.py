"""Why flaps stay open, counted by kind."""

from __future__ import annotations

from closing.reasons import kind_of

NEAR = "blocked: on its way: gripper comes too near to a side"


def test_reasons_that_differ_in_names_and_numbers_are_of_one_kind() -> None:
    kinds = {
        kind_of("blocked", f"at {degrees} degrees: gripper comes too near to side_{side}", None)
        for degrees, side in ((165, 0), (-9, 3))
    }
    assert kinds == {NEAR}
    assert kind_of("blocked", "where it stands: gripper comes too near to side_1", None) != NEAR
    assert kind_of("blocked", "flap_2 meets flap_3", None) == "blocked: a flap meets a flap"


def test_what_is_planned_is_told_by_its_run() -> None:
    asked = [kind_of("planned", None, failure) for failure in (None, "side_1 sank 1.63 mm into tuck_3")]
    assert asked == ["planned, but not held", "planned, but the run proves nothing"]
    stopped = "stopped at 16.4 s, closing flap_2: finger_left pressed flap_2"
    assert kind_of("planned", None, None, stopped) == "planned, but the arm was stopped"
    assert kind_of("planned", None, "side_1 sank 1.63 mm into tuck_3", stopped) == asked[1]
    assert kind_of("unreachable", None, None, stopped) == "unreachable: not told"
    assert kind_of("unreachable", None, None) == "unreachable: not told"
