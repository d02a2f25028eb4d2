"""Results of a sweep: the variants of a scene."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from . import checks
from .figures import table_html
from .optional import imported
from .pictures import Frame, read_frame


class Sweep:
    """The folder of a sweep.

    `folder`: its path. `records`: a dictionary for each variant: `variant` (its name), `heat` (the variant whose temperatures
    it shares), `folder`, and the values of the sweep's keys. `keys`: these keys. `rendered`, `kept`, `solved`: numbers of
    variants rendered now, of variants kept from an earlier run, and of heat balances solved. `notes`: approximations.
    """

    def __init__(self, folder: checks.File, raw: dict[str, Any]) -> None:
        """folder: with its manifest.json; raw: as the compiled module returns it."""
        self.folder: Path = Path(folder)
        self.rendered: int = raw["rendered"]
        self.kept: int = raw["kept"]
        self.solved: int = raw["solved"]
        self.notes: list[str] = raw["notes"]
        manifest = json.loads((self.folder / "manifest.json").read_text(encoding="utf-8"))
        self.keys: list[str] = [key for axis in manifest["sweep"]["axes"] for key in axis["keys"]]
        self.records: list[dict[str, Any]] = [
            {"variant": one["name"], "heat": one["heat"], "folder": one["folder"], **one["values"]}
            for one in manifest["variants"]
        ]

    def frame(self) -> Any:
        """The records as a pandas.DataFrame, names of the variants as its index. Needs pandas."""
        return imported("pandas").DataFrame(self.records).set_index("variant")

    def frame_files(self, variant: str) -> list[Path]:
        """Pictures (EXR) of one variant, sorted by observer, band and instant. Raises KeyError for an unknown variant."""
        if variant not in [record["variant"] for record in self.records]:
            known = ", ".join(one["variant"] for one in self.records)
            raise KeyError(f"no variant {variant!r}, expected one of: {known}")
        return sorted((self.folder / "variants" / variant / "frames").glob("*.exr"))

    def frames(self, variant: str, planes: Sequence[str] | None = None) -> Iterator[Frame]:
        """Pictures of one variant, read one after the other; planes: names of those to read, None: all."""
        return (read_frame(file, planes) for file in self.frame_files(variant))

    def __len__(self) -> int:
        """Number of variants."""
        return len(self.records)

    def __repr__(self) -> str:
        return f"<diurna.Sweep {self.folder}: {len(self)} variants of {', '.join(self.keys)}>"

    def _repr_html_(self) -> str:
        header = ["variant", *self.keys]
        return table_html(header, [[record[name] for name in header] for record in self.records])
