"""MuJoCo's warnings kept, where it would print them and write MUJOCO_LOG.TXT into the caller's folder."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import mujoco


@contextmanager
def heard_warnings() -> Iterator[list[str]]:
    """What MuJoCo warns of within; whoever hears its warnings otherwise does so again afterwards."""
    said: list[str] = []
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(said.append)
    try:
        yield said
    finally:
        mujoco.set_mju_user_warning(before)
