"""Object models as data: templates (TOML) and learned weights (JSON)."""

from boxwright.models.catalogue import (
    CLOSED,
    FITTED,
    FITTED_TEMPLATES,
    JUDGEMENT_FILE,
    TEMPLATE_NAMES,
    load_judgement,
    load_object_model,
    load_template,
    load_weights,
    shipped_for,
)
from boxwright.models.kinds import LearnedKinds, load_kinds
from boxwright.models.weights import LearnedWeights

__all__ = [
    "CLOSED",
    "FITTED",
    "FITTED_TEMPLATES",
    "JUDGEMENT_FILE",
    "TEMPLATE_NAMES",
    "LearnedKinds",
    "LearnedWeights",
    "load_judgement",
    "load_kinds",
    "load_object_model",
    "load_template",
    "load_weights",
    "shipped_for",
]
