"""What became of the variants of a scene."""

import json
from pathlib import Path

from .pictures import read_frame


class Sweep:
    """A sweep's folder. `records`, one of each variant: `variant`, `heat` (whose temperatures it has), `folder`, and the
    values of the sweep's keys; what manifest.json has of them."""

    def __init__(self, folder, told):
        self.folder = Path(folder)
        for name in ("rendered", "kept", "solved", "notes"):
            setattr(self, name, told[name])
        manifest = json.loads((self.folder / "manifest.json").read_text(encoding="utf-8"))
        self.keys = [key for axis in manifest["sweep"]["axes"] for key in axis["keys"]]
        self.records = [
            {"variant": one["name"], "heat": one["heat"], "folder": one["folder"], **one["values"]}
            for one in manifest["variants"]
        ]

    def frame(self):
        """The records as pandas.DataFrame, its index the variants' names."""
        import pandas

        return pandas.DataFrame(self.records).set_index("variant")

    def frame_files(self, variant):
        """Pictures (EXR) of one, by observer, band and instant."""
        if variant not in [record["variant"] for record in self.records]:
            raise KeyError(f"no variant {variant!r}, there are: {', '.join(one['variant'] for one in self.records)}")
        return sorted((self.folder / "variants" / variant / "frames").glob("*.exr"))

    def frames(self, variant, planes=None):
        """Each of them, one after the other."""
        return (read_frame(file, planes) for file in self.frame_files(variant))

    def __len__(self):
        return len(self.records)

    def __repr__(self):
        return f"<diurna.Sweep {self.folder}: {len(self)} variants of {', '.join(self.keys)}>"
