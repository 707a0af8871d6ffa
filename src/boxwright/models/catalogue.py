"""Where templates and weights are found: those shipped, by name, or a user's own, by path."""

from __future__ import annotations

from pathlib import Path

import msgspec

from boxwright import _core
from boxwright.models.weights import LearnedWeights

TEMPLATE_NAMES = ("carton", "cake_box", "pizza_box")
"""The shipped templates."""

_HERE = Path(__file__).parent
# Made once, at import: threads that make their first decoder of a type together have crashed.
_WEIGHTS = msgspec.json.Decoder(LearnedWeights)


def _template_path(name_or_path: str | Path) -> Path:
    if str(name_or_path) in TEMPLATE_NAMES:
        return _HERE / "templates" / f"{name_or_path}.toml"
    path = Path(name_or_path)
    if path.suffix != ".toml":
        raise ValueError(
            f"{name_or_path}: no template of that name; shipped are {', '.join(TEMPLATE_NAMES)}, or name a .toml file"
        )
    return path


def load_template(name_or_path: str | Path) -> _core.Template:
    """A shipped template by its name, or one of the user's own by its `.toml` file.

    Raises ValueError naming the file and the key that does not fit, OSError where the file cannot be read.
    """
    path = _template_path(name_or_path)
    text = _read_text(path)
    try:
        return _core.Template(text)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def load_weights(name_or_path: str | Path, planes: str | None = None) -> LearnedWeights:
    """The shipped weights of a template by its name, or a weights file.

    Shipped weights are learnt for each front end, one of `_core.PLANES`; `planes` None takes the default's.

    Raises ValueError naming the file and the key that does not fit, OSError where the file cannot be read.
    """
    path = _weights_path(name_or_path, planes)
    try:
        return _WEIGHTS.decode(_read_text(path))
    except msgspec.DecodeError as error:
        raise ValueError(f"{path}: {error}; boxwright train writes weights that fit") from None


def _weights_path(name_or_path: str | Path, planes: str | None) -> Path:
    if str(name_or_path) in TEMPLATE_NAMES:
        return _HERE / "weights" / (planes or _core.DEFAULT_PLANES) / f"{name_or_path}.json"
    return Path(name_or_path)


def load_object_model(
    template: str | Path, weights: str | Path | None = None, planes: str | None = None, **search: float | str
) -> tuple[_core.Template, _core.ObjectModel]:
    """A template with its weights, ready to infer with; `search` overrides settings of the search.

    Without `weights` the shipped ones for the front end `planes` are taken, which only shipped templates have. Raises
    as those above.
    """
    loaded = load_template(template)
    if weights is None and loaded.name not in TEMPLATE_NAMES:
        raise ValueError(
            f"{template}: no weights are shipped for {loaded.name!r}; train some and name them with --weights"
        )
    path = _weights_path(loaded.name if weights is None else weights, planes)
    try:
        return loaded, _core.ObjectModel(loaded, _read_text(path), **search)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ValueError(f"{path}: byte {error.start}: is not UTF-8 text") from None
