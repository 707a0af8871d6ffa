"""The steps of labelling a cloud: make its form, ask for roles, write the labelled frame."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.answers import save_segmentation
from boxwright.cli.failures import tell
from boxwright.cli.label_ask import ask_roles
from boxwright.cli.options import SceneOptions
from boxwright.io.segments import load_segments, read_segment_labels
from boxwright.labelling import Form, LabelledEntry, form_text, labelled_entry, read_form, save_entry
from boxwright.segmentation import Segmented, within
from boxwright.types import Cloud, Segmentation, Truth

FORMS = "forms"
"""Folder of the forms inside the set; what lies deeper than the set's own folder is no frame of it."""

NO_BOX_CATEGORY = "none"
"""As simulated frames without a box are called."""


@dataclass(frozen=True)
class Step:
    """What a run of the command came to for one cloud. `truth` is None while the form waits for roles."""

    status: Literal["waiting", "labelled"]
    form: Path
    segments: int
    truth: Truth | None = None
    without_role: int = 0
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, kw_only=True)
class LabelSteps:
    """How clouds are labelled: into which set, with which template's parts."""

    folder: Path
    template: _core.Template
    category: str | None
    read: Callable[[Path], Cloud]
    scene: SceneOptions
    draw: Callable[[Cloud, Segmented, Path], None] | None

    def next_step(self, path: Path) -> tuple[Step, tuple[Path, ...]]:
        """Makes the form where there is none yet; writes the labelled frame where its roles are filled in.

        Raises ValueError naming file and line of what cannot be used, OSError where a file cannot be read or written.
        """
        cloud, form_path = self._read(path), self.form_path(path)
        if not form_path.exists():
            segmentation, files = self._make_form(path, cloud)
            return Step("waiting", form_path, len(segmentation.segments)), files
        form, segmentation, segment_of = self._load_form(path, cloud)
        if form.is_empty:
            return Step("waiting", form_path, len(segmentation.segments)), (form_path,)
        entry = labelled_entry(path.stem, form, segmentation, segment_of, self.template)
        return self._saved(cloud, entry, form, segmentation)

    def without_box(self, path: Path) -> tuple[Step, tuple[Path, ...]]:
        """Writes the cloud as a labelled frame in which there is nothing. Raises as `next_step`."""
        form_path = self.form_path(path)
        if form_path.exists() and not read_form(form_path).is_empty:
            raise ValueError(f"{form_path}: names roles; leave out --no-box, or remove the form")
        cloud = self._read(path)
        segmentation = self.scene.segment(cloud).segmentation
        truth = Truth(path.stem, self.category or NO_BOX_CATEGORY, None, segmentation.up, (), ())
        entry = LabelledEntry(truth, np.zeros(len(cloud.points), np.uint16), ())
        files = save_entry(self.folder, cloud, entry)
        return Step("labelled", form_path, len(segmentation.segments), truth, len(segmentation.segments)), files

    def ask_all(self, clouds: list[Path]) -> None:
        """Asks for the roles of each cloud in turn and keeps them in its form; a cloud that is refused is passed over.

        `next_step` says why it is refused.
        """
        for path in clouds:
            try:
                cloud = self._read(path)
                if not self.form_path(path).exists():
                    self._make_form(path, cloud)
                form, segmentation, _ = self._load_form(path, cloud)
            except (ValueError, OSError):
                continue
            picture = self.form_path(path).parent / self._picture(path)
            ask_roles(form, segmentation, self.template, picture, self._writer(path, form, segmentation))

    def form_path(self, path: Path) -> Path:
        """Where a cloud's form is."""
        return self.folder / FORMS / path.stem / f"{path.stem}.roles.toml"

    def _picture(self, path: Path) -> str:
        return f"{path.stem}_segments.png"

    def _read(self, path: Path) -> Cloud:
        """The cloud; what lies beyond the region of interest is no reading in the set either."""
        cloud = self.read(path)
        return (
            cloud
            if self.scene.roi is None
            else msgspec.structs.replace(cloud, points=within(cloud.points, self.scene.roi))
        )

    def _make_form(self, path: Path, cloud: Cloud) -> tuple[Segmentation, tuple[Path, ...]]:
        form_path = self.form_path(path)
        segmented = self.scene.segment(cloud)
        for warning in segmented.segmentation.warnings:
            tell(ValueError(f"warning: {warning}"), path)
        files = save_segmentation(segmented, form_path.parent)
        if self.draw is not None:
            files = (*files, form_path.parent / self._picture(path))
            self.draw(cloud, segmented, files[-1])
        self._write_form(path, segmented.segmentation, self.category or self.template.name, {})
        return segmented.segmentation, (form_path, *files)

    def _load_form(self, path: Path, cloud: Cloud) -> tuple[Form, Segmentation, NDArray[np.int32]]:
        """The form with the segments that it was made of: they stay as they were when it was filled in."""
        form_path = self.form_path(path)
        form = read_form(form_path)
        if form.template != self.template.name:
            raise ValueError(
                f"{form_path}: template: is {form.template!r}; give that one as --template, or remove the form"
            )
        segment_of = read_segment_labels(form_path.parent / "labels.npz")
        if not form.points == len(segment_of) == len(cloud.points):
            raise ValueError(
                f"{form_path}: points: is {form.points}, {path} has {len(cloud.points)}; remove the form to begin anew"
            )
        return form, load_segments(form_path.parent / "segments.json"), segment_of

    def _writer(self, path: Path, form: Form, segmentation: Segmentation) -> Callable[[dict[int, str]], None]:
        return lambda roles: self._write_form(path, segmentation, form.category, roles)

    def _write_form(self, path: Path, segmentation: Segmentation, category: str, roles: dict[int, str]) -> None:
        text = form_text(segmentation, self.template, category, self._picture(path), roles)
        self.form_path(path).write_text(text, encoding="utf-8")

    def _saved(
        self, cloud: Cloud, entry: LabelledEntry, form: Form, segmentation: Segmentation
    ) -> tuple[Step, tuple[Path, ...]]:
        files = save_entry(self.folder, cloud, entry)
        with_role = sum(bool(text.strip()) for text in form.roles.values())
        count = len(segmentation.segments)
        return Step("labelled", form.path, count, entry.truth, count - with_role, entry.warnings), files
