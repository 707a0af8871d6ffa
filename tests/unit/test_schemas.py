"""The published schemas say what the types say, and hold against real files."""

from __future__ import annotations

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from boxwright.io.schemas import SCHEMAS, schema_text
from support.sample_model import sample_model

PUBLISHED = Path(__file__).resolve().parents[2] / "docs" / "schemas"


def published(name: str) -> jsonschema.Draft202012Validator:
    schema = json.loads((PUBLISHED / name).read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(schema)
    return jsonschema.Draft202012Validator(schema)


def test_the_committed_schemas_are_the_generated_ones() -> None:
    assert {path.name for path in PUBLISHED.iterdir()} == set(SCHEMAS)
    for name in SCHEMAS:
        committed = (PUBLISHED / name).read_text(encoding="utf-8")
        assert committed == schema_text(name), f"docs/schemas/{name} is stale; `make schemas` writes it"


def test_a_sample_model_fits_nulls_and_later_keys_included() -> None:
    data = sample_model()
    data["later"] = {"key": 1}
    data["support_plane"] = None
    published("model.schema.json").validate(data)


@pytest.mark.parametrize(
    "change",
    [
        lambda d: d.update(format="other"),
        lambda d: d.update(version=2),
        lambda d: d.pop("up"),
        lambda d: d["up"].append(0.0),
        lambda d: d["objects"][0].update(score=None),
        lambda d: d["objects"][0]["inference"].update(status="sure"),
        lambda d: d["objects"][0]["parts"][0]["corners"].pop(),
        lambda d: d["objects"][0]["joints"][0].update(type="prismatic"),
        lambda d: d["objects"][0]["joints"][0].pop("limits"),
    ],
)
def test_what_does_not_fit_is_refused(change: Callable[[dict[str, Any]], None]) -> None:
    data = copy.deepcopy(sample_model())
    change(data)
    with pytest.raises(jsonschema.ValidationError):
        published("model.schema.json").validate(data)


def test_shared_truths_fit(shared_dir: Path) -> None:
    validator = published("truth.schema.json")
    paths = sorted((shared_dir / "data" / "labelled").glob("*.truth.json"))
    for path in paths:
        validator.validate(json.loads(path.read_text(encoding="utf-8")))
    assert len(paths) == 14
