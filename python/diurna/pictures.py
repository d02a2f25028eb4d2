"""Pictures as arrays that show themselves in notebooks."""

import struct
import zlib

import numpy as np

from . import _core


def grey_png(values, least, most):
    """PNG of 8 bits: `least` black, `most` white; what is not finite is black."""
    scaled = (np.nan_to_num(np.asarray(values, float), nan=least) - least) / max(most - least, 1e-30)
    grey = np.clip(255.0 * scaled + 0.5, 0, 255).astype(np.uint8)
    height, width = grey.shape

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


class Frame:
    """What an observer sees at an instant: planes by name, (row, column), row 0 the upper one.

    `radiance.BAND` [W m-2 sr-1], `apparent_temperature.BAND` [K], truth planes (`temperature`, `range`, `object`, ...);
    `units` has each plane's. Arrays are those the program made, not copies.
    """

    def __init__(self, raw):
        self.planes, self.units = raw["planes"], raw["units"]
        self.instant, self.observer = raw["instant"][0], raw["observer"]
        self.notes, self.attributes = raw["notes"], raw["attributes"]

    def __getitem__(self, name):
        try:
            return self.planes[name]
        except KeyError:
            raise KeyError(f"no plane {name!r}, there are: {', '.join(self.planes)}") from None

    def __repr__(self):
        return f"<diurna.Frame {self.observer} {self.instant}Z: {', '.join(self.planes)}>"

    def _shown(self):
        names = [n for n in self.planes if n.startswith("apparent_temperature")] or list(self.planes)
        return names[0]

    def png(self, plane=None, least=None, most=None):
        """PNG of a plane, by itself the first apparent temperature's, from its 1st to its 99th percentile."""
        values = self[plane or self._shown()]
        finite = values[np.isfinite(values)]
        if finite.size == 0:
            finite = np.zeros(1)
        low, high = np.percentile(finite, [1, 99])
        return grey_png(values, low if least is None else least, high if most is None else most)

    def _repr_png_(self):
        return self.png()


def read_frame(file, planes=None):
    """A picture of a run's folder (EXR); `planes`: only those. Raises diurna.Error."""
    return Frame(_core.frame(file, planes))
