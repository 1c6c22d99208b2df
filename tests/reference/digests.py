"""What a timeline holds, as one number: equal recorded runs give equal digests."""

import hashlib

import h5py

from vasc.timeline import Timeline
from vasc.timeline.layout import TABLES, Motion


def content_digest(path, without=("provenance",)):
    """Give the SHA-256 of the names, types, shapes and bytes of all committed rows.

    ``without`` names groups and datasets that are left out: by default those that tell when and
    where a run was made.
    """
    digest = hashlib.sha256()
    with Timeline(path) as timeline:
        n_rows = {"frames": timeline.n_frames}
        n_rows |= {name: timeline.n_rows(name) for name in TABLES}
        if timeline.motion == Motion.EXPLICIT:
            n_rows |= {f"motion/{name}": number for name, number in timeline.n_places.items()}
        datasets = {}

        def collect(name, item):
            if isinstance(item, h5py.Dataset):
                datasets[name] = item

        timeline.opened.file.visititems(collect)
        for name in sorted(datasets):
            group = name.partition("/")[0]
            if {name, group} & set(without):
                continue
            committed = n_rows.get(name, n_rows.get(group))
            rows = datasets[name][()]
            rows = rows if committed is None else rows[:committed]
            digest.update(f"{name} {rows.dtype.str} {rows.shape}\n".encode())
            digest.update(rows.tobytes())
    return digest.hexdigest()
