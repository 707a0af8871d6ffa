"""Object models as data: templates (TOML) and learned weights (JSON)."""

from boxwright.models.catalogue import (
    TEMPLATE_NAMES,
    load_judgement,
    load_object_model,
    load_template,
    load_weights,
    shipped_for,
)
from boxwright.models.weights import LearnedWeights

__all__ = [
    "TEMPLATE_NAMES",
    "LearnedWeights",
    "load_judgement",
    "load_object_model",
    "load_template",
    "load_weights",
    "shipped_for",
]
