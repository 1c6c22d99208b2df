"""What a timeline holds, as one number: equal recorded runs give equal digests."""

import hashlib

import h5py

from vasc.timeline import Timeline

WITHOUT = ("provenance",)
"""Groups that tell when and where a run was made."""


def content_digest(path):
    """Give the SHA-256 of the names, types, shapes and bytes of all committed rows."""
    with Timeline(path) as timeline:
        n_rows = {"frames": timeline.n_frames}
        n_rows |= {name: timeline.n_rows(name) for name in timeline.opened.file if has_rows(name)}
        n_places = timeline.n_places if timeline.motion.name == "EXPLICIT" else {}
        n_rows |= {f"motion/{name}": number for name, number in n_places.items()}
        digest = hashlib.sha256()
        datasets = {}
        timeline.opened.file.visititems(
            lambda name, item: (
                datasets.update({name: item}) if isinstance(item, h5py.Dataset) else None
            )
        )
        for name in sorted(datasets):
            group = name.partition("/")[0]
            if group in WITHOUT:
                continue
            rows = datasets[name][()]
            committed = n_rows.get(name, n_rows.get(group))
            rows = rows if committed is None else rows[:committed]
            digest.update(f"{name} {rows.dtype.str} {rows.shape}\n".encode())
            digest.update(rows.tobytes())
    return digest.hexdigest()


def has_rows(name):
    """Tell whether a group is a table, whose rows are counted."""
    from vasc.timeline.layout import TABLES

    return name in TABLES
