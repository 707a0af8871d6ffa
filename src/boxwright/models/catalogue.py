"""Where templates and weights are found: those shipped, by name, or a user's own, by path."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import msgspec

from boxwright import _core
from boxwright.models.weights import LearnedWeights

TEMPLATE_NAMES = ("carton", "cake_box", "pizza_box")
"""The shipped templates that compete where none is named, in the methods "paper" and "exact"."""
FITTED_TEMPLATES = (*TEMPLATE_NAMES, "tote")
"""Those of the method "fitted"."""
CLOSED = "closed_carton"
"""Shipped too, for the method "fitted" where it is named: rays tell closed boxes, without weights."""
SHIPPED_TEMPLATES = (*FITTED_TEMPLATES, CLOSED)
NO_WEIGHTS = LearnedWeights(template=CLOSED, weights={}, importance={}, accept_score=0.0)

_HERE = Path(__file__).parent
# Made once, at import: threads that make their first decoder of a type together have crashed.
_WEIGHTS = msgspec.json.Decoder(LearnedWeights)


EXACT = "exact"
"""What is shipped for the method of that name: templates with further terms, and weights for the default front end."""
FITTED = "fitted"
"""The method that fits bodies: its boxes are judged by weights of their own."""
JUDGEMENT_FILE = _HERE / "weights" / FITTED / "judgement.json"


def shipped_for(method: str, planes: str) -> str:
    """What a method takes of what is shipped: "exact" and "fitted" that of "exact", else that of the front end, one of
    `_core.PLANES`.

    Raises ValueError where the method's weights were learnt on another front end.
    """
    if method not in (EXACT, FITTED):
        return planes
    if planes != _core.DEFAULT_PLANES:
        raise ValueError(
            f"method {method!r}: its shipped weights are learnt on planes {_core.DEFAULT_PLANES!r}, not {planes!r};"
            " leave planes out, or name a template and its weights"
        )
    return EXACT


@cache
def load_judgement() -> _core.Judgement:
    """The shipped weights by which fitted boxes are judged; read once."""
    return _core.Judgement(_read_text(JUDGEMENT_FILE))


def _template_path(name_or_path: str | Path, shipped: str | None) -> Path:
    if str(name_or_path) in SHIPPED_TEMPLATES:
        folder = _HERE / "templates"
        # Rays tell closed boxes: they have one template, without terms.
        is_exact = shipped == EXACT or str(name_or_path) == CLOSED
        return (folder / EXACT if is_exact else folder) / f"{name_or_path}.toml"
    path = Path(name_or_path)
    if path.suffix != ".toml":
        raise ValueError(
            f"{name_or_path}: no template of that name; known are {', '.join(SHIPPED_TEMPLATES)}, or name a .toml file"
        )
    return path


def load_template(name_or_path: str | Path, shipped: str | None = None) -> _core.Template:
    """A shipped template by its name, or one of the user's own by its `.toml` file.

    `shipped` "exact" takes the templates of that method, which have further terms; else they are the paper's.

    Raises ValueError naming the file and the key that does not fit, OSError where the file cannot be read.
    """
    path = _template_path(name_or_path, shipped)
    text = _read_text(path)
    try:
        return _core.Template(text)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def load_weights(name_or_path: str | Path, shipped: str | None = None) -> LearnedWeights:
    """The shipped weights of a template by its name, or a weights file.

    Shipped weights are learnt for each front end, one of `_core.PLANES`, and for the method "exact"; `shipped` names
    which, None those of the default front end.

    Raises ValueError naming the file and the key that does not fit, OSError where the file cannot be read.
    """
    path = _weights_path(name_or_path, shipped)
    try:
        return _WEIGHTS.decode(_read_text(path))
    except msgspec.DecodeError as error:
        raise ValueError(f"{path}: {error}; boxwright train writes weights that fit") from None


def _weights_path(name_or_path: str | Path, shipped: str | None) -> Path:
    if str(name_or_path) in FITTED_TEMPLATES:
        return _HERE / "weights" / (shipped or _core.DEFAULT_PLANES) / f"{name_or_path}.json"
    return Path(name_or_path)


def load_object_model(
    template: str | Path, weights: str | Path | None = None, shipped: str | None = None, **search: float | str
) -> tuple[_core.Template, _core.ObjectModel]:
    """A template with its weights, ready to infer with; `search` overrides settings of the search.

    Without `weights` the shipped ones are taken, which only shipped templates have; `shipped` says which templates and
    weights, as for those above. Raises as those do.
    """
    loaded = load_template(template, shipped)
    if not loaded.feature_names and not loaded.relation_names:
        none = msgspec.structs.replace(NO_WEIGHTS, template=loaded.name)
        return loaded, _core.ObjectModel(loaded, msgspec.json.encode(none).decode(), **search)
    if weights is None and loaded.name not in FITTED_TEMPLATES:
        raise ValueError(
            f"{template}: no weights are shipped for {loaded.name!r}; train some and name them with --weights"
        )
    _core.check_search(**search)
    path = _weights_path(loaded.name if weights is None else weights, shipped)
    if weights is None and not path.is_file():
        raise ValueError(
            f"{template}: no weights are shipped for {loaded.name!r} on planes {shipped or _core.DEFAULT_PLANES!r};"
            ' they are for the methods "exact" and "fitted", or name some with --weights'
        )
    try:
        return loaded, _core.ObjectModel(loaded, _read_text(path), **search)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ValueError(f"{path}: byte {error.start}: is not UTF-8 text") from None
