"""Labels from people: a form for each cloud's segments, and the labelled frame that a filled form comes to."""

from boxwright.labelling.entry import LabelledEntry, labelled_entry, save_entry
from boxwright.labelling.form import Form, describe, form_text, read_form
from boxwright.labelling.roles import Role, part_names, read_role

__all__ = [
    "Form",
    "LabelledEntry",
    "Role",
    "describe",
    "form_text",
    "labelled_entry",
    "part_names",
    "read_form",
    "read_role",
    "save_entry",
]
