"""What studies find: crossovers, contrast, signatures, ranges, sensitivities, calibrations."""

import json

from .errors import NotConverged
from .tables import as_frame, read_csv


class Study:
    """What one table of a scene has come to, with the numbers of the files of the same name.

    `columns` is NAME.csv, arrays by column name (study["time"]); `summary` is NAME.json; `svg` the figure, which a
    notebook shows; `told` what the program prints; `notes` what is to be known of this one.
    """

    def __init__(self, raw):
        self.name, self.texts, self.told, self.notes = raw["name"], raw["texts"], raw["told"], raw["notes"]
        self.columns = read_csv(self.texts[".csv"])
        self.summary = json.loads(self.texts[".json"])
        self.svg = self.texts[".svg"]
        curves = [text for ending, text in self.texts.items() if ending.startswith("_curve")]
        self.curves = read_csv(curves[0]) if curves else None  # arrays of NAME_curves.csv, where the study has it

    def __getitem__(self, name):
        try:
            return self.columns[name]
        except KeyError:
            raise KeyError(f"no column {name!r}, there are: {', '.join(self.columns)}") from None

    def __len__(self):
        return len(next(iter(self.columns.values())))

    def __repr__(self):
        return self.told.rstrip("\n")

    def frame(self):
        """The columns as pandas.DataFrame, instants in UTC."""
        return as_frame(self.columns)

    def curves_frame(self):
        """The curves, of a crossover by band and instant, of a calibration by instant."""
        if self.curves is None:
            raise ValueError(f"{self.name}: a study of {self.summary['study']} has no curves")
        return as_frame(self.curves, None if "band_um" in self.curves else "time")

    def _repr_svg_(self):
        return self.svg


class Studies(list):
    """Those of one kind, by number or name; `notes` of the scene and its temperatures."""

    def __init__(self, raw, kind=Study):
        super().__init__(kind(one) for one in raw["findings"])
        self.notes = raw["notes"]

    def __getitem__(self, which):
        if not isinstance(which, str):
            return super().__getitem__(which)
        for one in self:
            if one.name == which:
                return one
        raise KeyError(f"no study {which!r}, there are: {', '.join(one.name for one in self)}")

    def __repr__(self):
        return "\n".join(map(repr, self))

    def _repr_html_(self):
        return "\n".join(one.svg for one in self)


class Calibration(Study):
    """Numbers of a column that were found from a measured curve; `values` by key."""

    @property
    def values(self):
        return dict(zip(self["key"], map(float, self["value"])))

    @property
    def settings(self):
        """The numbers as settings of diurna.column."""
        return [f"{key}={value!r}" for key, value in self.values.items()]


def converged(found, raw):
    """Raises NotConverged with what there is."""
    if raw["not_converged"]:
        raise NotConverged(raw["not_converged"], found)
    return found
