"""Teach it your own boxes: say what the segments of a few frames are, and learn weights from that."""

import tempfile
from pathlib import Path

import numpy as np

import boxwright
from boxwright.evaluation.roles import from_truth_name
from boxwright.labelling import form_text, labelled_entry, read_form
from boxwright.learning import SeenFrame, train
from boxwright.models import load_template
from boxwright.simulation import make_frame

carton = load_template("carton")
frames = []
for seed in (3, 7, 8):
    frame = make_frame("medium", seed, boxes=1, clutter=False)
    cloud = boxwright.Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
    found = boxwright.segment(cloud)
    # A person looks at the picture that `boxwright label` draws and types; here the simulated frame's truth does.
    names = ["", *(from_truth_name(part.name) for part in frame.truth.parts)]
    segment_of = found.perception.labels
    typed = {k: names[np.bincount(frame.labels[segment_of == k]).argmax()] for k in range(len(found.perception))}

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "frame.roles.toml"
        path.write_text(form_text(found.segmentation, carton, "mine", "frame_segments.png", typed), encoding="utf-8")
        labelled = labelled_entry("frame", read_form(path), found.segmentation, segment_of, carton)
    print(f"{len(typed)} segments, labelled: {', '.join(part.name for part in labelled.truth.parts)}")
    frames.append(SeenFrame(f"frame_{seed}", found.perception, labelled.truth, labelled.labels))

learned = train(carton, frames, command="examples/05_label_and_train.py")
largest = sorted(learned.importance, key=learned.importance.__getitem__)[-3:]
print(f"{len(learned.weights)} weights, most important {', '.join(reversed(largest))}")
