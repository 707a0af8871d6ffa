"""A point cloud as it was read."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.types.truth import Vector


class Cloud(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """Points in metres in the input's own frame; the arrays are read-only.

    A point with any non-finite coordinate is no reading. An organized cloud has `height` > 1 and its pixel (u, v) is
    point `v * width + u`; an unorganized one has `height` 1.

    Raises ValueError when an array's shape or type does not fit.
    """

    points: NDArray[np.float32]
    """(N, 3) float32, C-contiguous, metres, input's frame."""
    width: int
    height: int
    viewpoint: Vector | None = None
    """Where the sensor stood, metres, input's frame; None where nobody knows it."""
    colors: NDArray[np.uint8] | None = None
    """(N, 3) uint8: red, green, blue."""
    labels: NDArray[np.uint32] | None = None
    """(N,) uint32: the file's own field `label`."""
    path: str | None = None
    """The file it was read from."""

    def __post_init__(self) -> None:
        n = self.width * self.height
        for name, dtype, shape in (
            ("points", np.float32, (n, 3)),
            ("colors", np.uint8, (n, 3)),
            ("labels", np.uint32, (n,)),
        ):
            array = getattr(self, name)
            if array is not None:
                msgspec.structs.force_setattr(self, name, _read_only(name, array, dtype, shape))

    @property
    def organized(self) -> bool:
        """True when the points are the pixels of an image."""
        return self.height > 1


def _read_only(name: str, array: object, dtype: type, shape: tuple[int, ...]) -> NDArray[np.generic]:
    """A read-only view of a C-contiguous array, checked."""
    if not isinstance(array, np.ndarray) or array.dtype != dtype or array.shape != shape:
        found = f"{array.dtype} {array.shape}" if isinstance(array, np.ndarray) else type(array).__name__
        raise ValueError(f"cloud: {name}: is {found}; must be a numpy array of {np.dtype(dtype)}, shape {shape}")
    if not array.flags.c_contiguous:
        raise ValueError(f"cloud: {name}: is not C-contiguous; numpy.ascontiguousarray makes it so")
    view = array.view()
    view.flags.writeable = False
    return view
