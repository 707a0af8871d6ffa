"""model.json, labels.npz and truth.json in and out: what was written is read, and what is wrong is named."""

from __future__ import annotations

import io
import json
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from boxwright.io.labels import PointLabels, read_labels, write_labels
from boxwright.io.models import load_model, save_model
from boxwright.io.truth import load_truth, read_truth_labels, save_truth
from boxwright.types import Model
from support.sample_model import sample_model


def test_a_model_survives_its_file(tmp_path: Path) -> None:
    model = msgspec.convert(sample_model(), Model)
    save_model(model, tmp_path / "model.json")
    assert load_model(tmp_path / "model.json") == model
    assert json.loads((tmp_path / "model.json").read_text()) == sample_model()


@pytest.mark.parametrize(
    ("change", "place"),
    [
        (lambda d: d["objects"][0]["joints"][0].update(axis=[0, 0, 2]), "objects[0].joints[0]: axis has length 2"),
        (lambda d: d["objects"][1].pop("score"), "objects[1]: Object missing required field `score`"),
        (lambda d: d.update(version=2), "version: Invalid enum value 2"),
    ],
)
def test_a_wrong_model_names_file_and_key(tmp_path: Path, change: Callable[[Any], Any], place: str) -> None:
    data = sample_model()
    change(data)
    path = tmp_path / "model.json"
    path.write_text(json.dumps(data))
    with pytest.raises(ValueError, match=r"model\.json: ") as caught:
        load_model(path)
    assert str(caught.value).startswith(f"{path}: {place}")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text", [b"", b"{", b"\xff\xfe", b"[1, 2]", b"null", b'{"later": ' + b"[" * 200_000])
def test_what_is_no_model_is_refused(tmp_path: Path, text: bytes) -> None:
    (tmp_path / "model.json").write_bytes(text)
    with pytest.raises(ValueError, match=r"model\.json: "):
        load_model(tmp_path / "model.json")


def test_labels_survive_their_file_and_its_bytes_are_the_same(tmp_path: Path) -> None:
    labels = PointLabels(np.array([0, 0, 1, -1], np.int16), np.array([2, -1, 0, -1], np.int16))
    for name in ("a.npz", "b.npz"):
        write_labels(labels, tmp_path / name)
    read = read_labels(tmp_path / "a.npz")
    np.testing.assert_array_equal(read.object, labels.object)
    np.testing.assert_array_equal(read.part, labels.part)
    assert (tmp_path / "a.npz").read_bytes() == (tmp_path / "b.npz").read_bytes()
    assert np.load(tmp_path / "a.npz")["part"].dtype == np.int16


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"object": np.zeros(3, np.int16)}, "part: no array of that name; found object"),
        ({"object": np.zeros(3, np.int32), "part": np.zeros(3, np.int16)}, "object: is int32"),
        ({"object": np.zeros(3, np.int16), "part": np.zeros(2, np.int16)}, "must be as many"),
        ({"object": np.zeros((3, 1), np.int16), "part": np.zeros(3, np.int16)}, r"must be int16, \(N,\)"),
        ({"object": np.full(3, -1, np.int16), "part": np.zeros(3, np.int16)}, "a part belongs to an object"),
        ({"object": np.full(3, -2, np.int16), "part": np.full(3, -1, np.int16)}, "holds -2"),
    ],
)
def test_labels_that_do_not_fit_are_refused(tmp_path: Path, arrays: dict[str, Any], message: str) -> None:
    np.savez(tmp_path / "labels.npz", **arrays)
    with pytest.raises(ValueError, match=message) as caught:
        read_labels(tmp_path / "labels.npz")
    assert str(caught.value).startswith(f"{tmp_path / 'labels.npz'}: ")


def test_a_header_that_claims_too_much_is_refused_unallocated(tmp_path: Path) -> None:
    header = io.BytesIO()
    np.lib.format.write_array_header_1_0(header, {"descr": "<u2", "fortran_order": False, "shape": (10**15,)})
    with zipfile.ZipFile(tmp_path / "huge.npz", "w") as archive:
        archive.writestr("labels.npy", header.getvalue())
    with pytest.raises(ValueError, match="header claims"):
        read_truth_labels(tmp_path / "huge.npz")


def test_bytes_that_are_no_archive_are_refused(tmp_path: Path) -> None:
    whole = tmp_path / "whole.npz"
    np.savez_compressed(whole, labels=np.arange(1000, dtype=np.uint16))
    data = whole.read_bytes()
    cases = 0
    for end in range(0, len(data), 37):
        (tmp_path / "cut.npz").write_bytes(data[:end])
        with pytest.raises(ValueError, match="labels: "):
            read_truth_labels(tmp_path / "cut.npz")
        cases += 1
    assert cases > 20


def test_shared_truths_are_read_and_survive_their_file(shared_dir: Path, tmp_path: Path) -> None:
    paths = sorted((shared_dir / "data" / "labelled").glob("*.truth.json"))
    for path in paths:
        truth = load_truth(path)
        labels = read_truth_labels(path.with_name(path.name.replace(".truth.json", ".labels.npz")))
        counts = np.bincount(labels, minlength=len(truth.parts) + 1)[1:]
        assert counts.tolist() == [part.visible_px for part in truth.parts]
        save_truth(truth, tmp_path / "truth.json")
        assert load_truth(tmp_path / "truth.json") == truth
    assert len(paths) == 14


def test_any_bytes_are_a_model_or_a_value_error(tmp_path: Path) -> None:
    rng = np.random.default_rng(77)
    whole = np.frombuffer(json.dumps(sample_model()).encode(), np.uint8)
    path = tmp_path / "model.json"
    refusals: list[str] = []
    for _ in range(1000):
        spoilt = whole.copy()
        places = rng.integers(0, len(spoilt), int(rng.integers(1, 4)))
        spoilt[places] = rng.integers(0, 256, len(places))
        path.write_bytes(spoilt.tobytes())
        try:
            assert isinstance(load_model(path), Model)
        except ValueError as error:
            refusals.append(str(error))
    assert 500 < len(refusals) < 1000
    assert all(line.startswith(f"{path}: ") and "\n" not in line for line in refusals)
