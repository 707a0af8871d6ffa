"""Pictures of a run: a strip of its moments (PNG) and a film (GIF), drawn by MuJoCo without a screen.

Needs EGL (Debian: libegl1, libgl1-mesa-dri) and Pillow.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from os import PathLike
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

from boxwright.simulation.physics.boards import BoardBox
from boxwright.simulation.physics.run import Run

Array = NDArray[np.float64]
Pixels = NDArray[np.uint8]

TILE_PX = (400, 300)
COLUMNS = 4
TILES = 16
FILM_PX = (400, 300)
ELEVATION_DEG = -28.0
CAPTION_PX = 5
CAPTION_HEIGHT_PX = 20
SAMPLES = 2
EDGE_SHARE = 0.08
"""Of a picture's half height and width that stays free at its edges; the caption is there."""
FRAMED_STILLS = 24
"""Stills that the camera is put up for."""


class Painter:
    """Draws a scene at given joint positions, from beside robot and box. A context manager; it holds a GL context."""

    def __init__(self, run: Run, size_px: tuple[int, int]) -> None:
        model = run.world.model
        self._model, self._data = model, mujoco.MjData(model)
        self._size_px = size_px
        model.vis.global_.offwidth, model.vis.global_.offheight = size_px
        model.vis.quality.offsamples = SAMPLES
        self._context = _gl_context(size_px)
        self._drawer = mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100.value)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self._drawer)
        self._scene = mujoco.MjvScene(model, maxgeom=2000)
        # Shadows cost most of the time where the processor draws.
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = False
        self._scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = False
        self._camera = _camera(run.box)
        self._frame(run.film.positions)

    def _frame(self, stills: Sequence[Array]) -> None:
        """Puts the camera, as it looks, at the height and distance from which all that moves is seen in every still."""
        azimuth_rad, elevation_rad = np.radians([self._camera.azimuth, self._camera.elevation])
        level = np.array([np.cos(azimuth_rad), np.sin(azimuth_rad), 0.0])
        forward = np.cos(elevation_rad) * level + np.array([0.0, 0.0, np.sin(elevation_rad)])
        right = np.array([level[1], -level[0], 0.0])
        seen = self._extents(stills)
        self._camera.lookat[:] = (seen.min(axis=0) + seen.max(axis=0)) / 2.0
        at = (seen - self._camera.lookat) @ np.column_stack([right, np.cross(right, forward), forward])
        slope = np.tan(np.radians(self._model.vis.global_.fovy) / 2.0) * (1.0 - EDGE_SHARE)
        width, height = self._size_px
        slopes = slope * np.array([width / height, 1.0])
        self._camera.distance = float((np.abs(at[:, :2]) / slopes - at[:, 2:]).max())

    def _extents(self, stills: Sequence[Array]) -> Array:
        """(N, 3): low and high corners of the balls around all geoms of what moves, in some of the stills."""
        model, data = self._model, self._data
        moves = (model.body_weldid[model.geom_bodyid] != 0) & (model.geom_rbound > 0.0)
        radii_m = model.geom_rbound[moves, None]
        found = []
        for positions in stills[:: max(1, len(stills) // FRAMED_STILLS)]:
            data.qpos[:] = positions
            mujoco.mj_kinematics(model, data)
            found += [data.geom_xpos[moves] - radii_m, data.geom_xpos[moves] + radii_m]
        return np.concatenate(found)

    def __enter__(self) -> Painter:
        return self

    def __exit__(self, *_: object) -> None:
        self._drawer.free()
        self._context.free()

    def draw(self, positions: Array) -> Pixels:
        """(height, width, 3) at these joint positions (nq,)."""
        width, height = self._size_px
        self._data.qpos[:] = positions
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_camlight(self._model, self._data)
        shown = mujoco.mjtCatBit.mjCAT_ALL.value
        mujoco.mjv_updateScene(self._model, self._data, mujoco.MjvOption(), None, self._camera, shown, self._scene)
        pixels = np.empty((height, width, 3), dtype=np.uint8)
        area = mujoco.MjrRect(0, 0, width, height)
        mujoco.mjr_render(area, self._scene, self._drawer)
        mujoco.mjr_readPixels(pixels, None, area, self._drawer)
        return pixels[::-1]


def save_strip(run: Run, path: str | PathLike[str]) -> None:
    """Write up to TILES moments of a run side by side, each with its time and what the arm is doing.

    Raises ValueError for a run without stills, OSError when the file cannot be written or nothing can draw here.
    """
    chosen = _moments(run)
    width, height = TILE_PX
    rows = -(-len(chosen) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * width, rows * height), "white")
    for k, picture in enumerate(_pictures(run, chosen, TILE_PX)):
        sheet.paste(picture, (k % COLUMNS * width, k // COLUMNS * height))
    sheet.save(path, format="PNG")


def save_film(run: Run, path: str | PathLike[str]) -> None:
    """Write all stills of a run as a GIF at the pace at which they were taken; raises as `save_strip`."""
    pictures = list(_pictures(run, range(len(run.film.times)), FILM_PX))
    pace_ms = round(1000.0 * float(np.median(np.diff(run.film.times)))) if len(pictures) > 1 else 1000
    # One palette for all stills, taken from the middle: a palette each makes the colours flicker.
    palette = pictures[len(pictures) // 2].quantize(128)
    stills = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in pictures]
    stills[0].save(Path(path), format="GIF", save_all=True, append_images=stills[1:], duration=pace_ms, loop=0)


def _pictures(run: Run, numbers: Sequence[int], size_px: tuple[int, int]) -> Iterator[Image.Image]:
    if not run.film.times:
        raise ValueError("the run has no stills; ask for them when simulating")
    with Painter(run, size_px) as painter:
        for number in numbers:
            picture = Image.fromarray(painter.draw(run.film.positions[number]))
            caption = f"{run.film.times[number]:.1f} s  {run.film.captions[number]}"
            pen = ImageDraw.Draw(picture)
            pen.rectangle((0, 0, size_px[0], CAPTION_HEIGHT_PX), fill="white")
            pen.text((CAPTION_PX, CAPTION_PX), caption, fill="black")
            yield picture


def _moments(run: Run) -> list[int]:
    """Stills to show: the first and the last of each caption's time, thinned evenly where they are too many."""
    captions = run.film.captions
    edges = [k for k in range(len(captions)) if k in (0, len(captions) - 1) or captions[k] != captions[k - 1]]
    middles = [(a + b) // 2 for a, b in pairwise(edges) if captions[a].startswith("push")]
    moments = sorted({*edges, *middles})
    if len(moments) <= TILES:
        return moments
    return [moments[round(k * (len(moments) - 1) / (TILES - 1))] for k in range(TILES)]


def _camera(box: BoardBox) -> mujoco.MjvCamera:
    """Looks across the line between robot and box; from where, the painter finds."""
    camera = mujoco.MjvCamera()
    centre = np.concatenate([board.corners for board in box.boards]).mean(axis=0)
    camera.azimuth = float(np.degrees(np.arctan2(centre[1], centre[0]))) + 115.0
    camera.elevation = ELEVATION_DEG
    return camera


def _gl_context(size_px: tuple[int, int]) -> mujoco.egl.GLContext:
    """A drawing context without a screen; OSError where the machine has none."""
    try:
        from mujoco.egl import GLContext

        context = GLContext(*size_px)
        context.make_current()
    except (ImportError, AttributeError, RuntimeError) as error:
        raise OSError(
            f"no picture can be drawn here: EGL fails ({error}); Debian: apt-get install libegl1 libgl1-mesa-dri"
        ) from error
    return context
