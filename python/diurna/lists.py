"""Lists of the names that a scene may use: materials, models, bands, profiles and aerosols of the air."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, Generic, SupportsIndex, TypeVar, overload

from . import _core
from .checks import nearest
from .errors import Error
from .figures import table_html
from .library import library_table
from .optional import imported


class Material(str):
    """A material of the library: its name, which is a text that scenes and columns take, with its figures.

    `description`: what it is. `albedo`, `solar_transmittance`: weighted by the sun at the ground, 0 to 1. `emissivity`:
    hemispherical at 300 K, 0 to 1; `emissivity_3_5_um`, `emissivity_8_12_um`: in these bands, 10 deg from the normal.
    `inertia`: of the top layer [J m-2 K-1 s-1/2]. `roughness_length_m`: of momentum [m].
    """

    description: str
    albedo: float
    solar_transmittance: float
    emissivity: float
    emissivity_3_5_um: float
    emissivity_8_12_um: float
    inertia: float
    roughness_length_m: float

    @property
    def table(self) -> dict[str, Any]:
        """Its keys as the library has them, those of the material it is `like` included: a dictionary for [material]."""
        return library_table(str(self))


class Model(str):
    """An object built by the program: its name, which is a text that `model` of an [[object]] takes.

    `description`: what it is. `upright`: whether it stands upright on a slope, as buildings do.
    """

    description: str
    upright: bool


class BandName(str):
    """A band of wavelengths that has a word for a name, which is a text that `bands` of an observer takes.

    `from_um`, `to_um`: its limits [um]. Any other band is named by its limits, as "8-14".
    """

    from_um: float
    to_um: float


Item = TypeVar("Item", bound=str)


class Names(list[Item], Generic[Item]):
    """A list of names with their figures, by number or by name: materials()["asphalt"]. A notebook shows it as a table."""

    def __init__(self, items: Iterable[Item] = ()) -> None:
        """items: names that carry their figures as attributes."""
        super().__init__(items)

    @overload
    def __getitem__(self, which: SupportsIndex) -> Item: ...
    @overload
    def __getitem__(self, which: slice) -> list[Item]: ...
    @overload
    def __getitem__(self, which: str) -> Item: ...
    def __getitem__(self, which: Any) -> Any:
        """By number, slice or name. Raises diurna.Error with the nearest name for one that is not there."""
        if not isinstance(which, str):
            return super().__getitem__(which)
        for one in self:
            if one == which:
                return one
        raise Error([("name", f"found '{which}', which is not in the list", nearest(which, list(self)))])

    def _rows(self) -> Iterator[dict[str, Any]]:
        return ({"name": str(one), **vars(one)} for one in self)

    def frame(self) -> Any:
        """The names and their figures as a pandas.DataFrame, names as its index. Needs pandas."""
        return imported("pandas").DataFrame(list(self._rows())).set_index("name")

    def _repr_html_(self) -> str:
        rows = list(self._rows())
        return table_html(rows[0], [list(row.values()) for row in rows], most=200) if rows else "<p>none</p>"


def _names(kind: type[Item], rows: list[dict[str, Any]]) -> Names[Item]:
    names = []
    for row in rows:
        one = kind(row["name"])
        vars(one).update({key: value for key, value in row.items() if key != "name"})
        names.append(one)
    return Names(names)


def materials() -> Names[Material]:
    """The materials of the library, in its order: names with albedo, emissivity and the other figures of diurna.Material.

    The names are those of scene and column files. Raises diurna.Error if the library cannot be read.
    """
    return _names(Material, _core.materials())


def models() -> Names[Model]:
    """The objects built by the program, for `model` of an [[object]]: names with what they are."""
    return _names(Model, _core.models())


def bands() -> Names[BandName]:
    """The bands that have a word for a name ("lwir"), with their limits [um]; any other is named by its limits, "8-14"."""
    return _names(BandName, _core.bands())


def profiles() -> list[str]:
    """The profiles of the air that `atmosphere.profile` and diurna.path() take."""
    return list(_core.profiles())


def aerosols() -> list[str]:
    """The aerosols that `atmosphere.aerosol` and diurna.path() take."""
    return list(_core.aerosols())
