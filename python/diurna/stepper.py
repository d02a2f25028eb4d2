"""A scene that a program drives step by step."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core, checks
from .errors import Error
from .pictures import Frame
from .tables import instant_text

if TYPE_CHECKING:
    from .scene import Scene


@dataclass
class Pose:
    """Position and direction of an observer's camera, to be changed and given to Stepper.picture().

    `name`: of the observer. `position_m`: (3) east, north, up of the site [m]. `azimuth_deg`: of the line of sight, clockwise
    from north, -360 to 360; `elevation_deg`: above the horizontal, -90 to 90; `roll_deg`: about the line of sight, -180 to 180.
    `horizontal_fov_deg`: field of view, 0.01 to 360. `width`, `height`: pixels, 1 to 16384.
    """

    name: str
    position_m: npt.NDArray[np.float64]
    azimuth_deg: float
    elevation_deg: float
    roll_deg: float
    horizontal_fov_deg: float
    width: int
    height: int
    _observer: Any = field(repr=False, compare=False, default=None)


def _pose_of(observer: Any) -> Pose:
    return Pose(
        observer.name,
        np.array(observer.position_m, np.float64),
        observer.azimuth_deg,
        observer.elevation_deg,
        observer.roll_deg,
        observer.horizontal_fov_deg,
        observer.width,
        observer.height,
        observer,
    )


def _observer_of(pose: Any) -> Any:
    """The compiled observer with the pose's numbers, each checked."""
    if not isinstance(pose, Pose) or pose._observer is None:
        raise Error([("pose", f"found {checks.described(pose)}", "expected what Stepper.observer() returns")])
    observer = pose._observer
    position = checks.array("pose.position_m", pose.position_m, -1e7, 1e7, "m")
    if position.shape != (3,):
        raise Error([("pose.position_m", f"found shape {position.shape}", "expected east, north, up")])
    observer.position_m = position
    observer.azimuth_deg = checks.number("pose.azimuth_deg", pose.azimuth_deg, -360, 360)
    observer.elevation_deg = checks.number("pose.elevation_deg", pose.elevation_deg, -90, 90)
    observer.roll_deg = checks.number("pose.roll_deg", pose.roll_deg, -180, 180)
    observer.horizontal_fov_deg = checks.number("pose.horizontal_fov_deg", pose.horizontal_fov_deg, 0.01, 360)
    observer.width = checks.whole("pose.width", pose.width, 1, 16384)
    observer.height = checks.whole("pose.height", pose.height, 1, 16384)
    return observer


class Stepper:
    """A scene that a program drives: advance in time, put an object elsewhere, take a picture.

    with scene.stepper() as stepper: ... frees its memory at the end of the block, close() at once. The heat balance takes the
    scene's own steps, whatever instants are requested; temperatures between two steps are interpolated. Objects that are put
    elsewhere need a trajectory in the scene, even one that rests. The same calls give the same numbers on any number of threads.
    """

    def __init__(self, scene: Scene) -> None:
        """scene: checked and built now. Raises diurna.Error."""
        self._stepper: Any = _core.Stepper(*scene._given())

    @property
    def _core(self) -> Any:
        if self._stepper is None:
            raise Error([("stepper", "found one that is closed", "make another by Scene.stepper()")])
        return self._stepper

    def __enter__(self) -> Stepper:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self.close()

    def close(self) -> None:
        """Frees the memory of the scene. Calls after it raise diurna.Error, but for close()."""
        self._stepper = None

    @property
    def now(self) -> str:
        """The instant reached, ISO 8601 in UTC; at first the start of the scene's span."""
        return str(self._core.now())

    @property
    def steps_solved(self) -> int:
        """Steps of the heat balance solved so far, without those before the start."""
        return int(self._core.steps_solved)

    def advance(self, to: checks.Instant) -> None:
        """Solves up to an instant.

        to: text in ISO 8601 with its offset, datetime with tzinfo, or numpy.datetime64 (UTC); from now to the end of the
        span. Raises diurna.Error.
        """
        self._core.advance(instant_text(to, "to"))

    def put(self, name: str, east_m: float, north_m: float, heading_deg: float = 0.0) -> None:
        """Puts an object on the ground at a place.

        name: of an object with a trajectory; east_m, north_m: of the site; heading_deg: of its front, clockwise from north,
        -360 to 360. Raises diurna.Error for another object, and off the elevation raster.
        """
        east, north = checks.number("east_m", east_m), checks.number("north_m", north_m)
        heading = checks.number("heading_deg", heading_deg, -360, 360)
        self._core.put(checks.text("name", name), east, north, heading)

    def pose(self, name: str) -> npt.NDArray[np.float64]:
        """Where an object with a trajectory is: the (4, 4) matrix from its frame (right, front, up; origin in the middle of its
        plan at its lowest point) to east, north, up of the site [m]. Raises diurna.Error."""
        return np.asarray(self._core.pose(checks.text("name", name)), np.float64)

    def temperature(self) -> npt.NDArray[np.float32]:
        """Temperatures now: (facet) [K]."""
        return np.asarray(self._core.temperature(), np.float32)

    def facets(self) -> dict[str, npt.NDArray[Any]]:
        """The facets that temperature() is about.

        `vertex_m` (vertex, 3): east, north, up [m]; `corner` (facet, 3): numbers of vertices; `normal` (facet, 3): unit,
        outward; `area_m2` (facet); `material`, `object` (facet): numbers into material_names and object_names.
        """
        return dict(self._core.facets())

    @property
    def material_names(self) -> list[str]:
        """Names of materials by the numbers of facets()["material"]."""
        return list(self._core.material_names())

    @property
    def object_names(self) -> list[str]:
        """Names of objects by the numbers of facets()["object"]."""
        return list(self._core.object_names())

    def observer(self, name: str) -> Pose:
        """The camera of an observer as in its first picture, to be changed and given to picture(). Raises diurna.Error."""
        return _pose_of(self._observer(name))

    def _observer(self, name: str) -> Any:
        """The compiled observer. Raises diurna.Error with the key `name` for an unknown one."""
        try:
            return self._core.observer(checks.text("name", name))
        except Error as error:
            one = error.mistakes[0]
            raise Error([(one.where, one.problem, one.hint, one.key or "name")]) from None

    def picture(self, name: str, pose: Pose | None = None) -> Frame:
        """What an observer sees now, in its bands.

        name: of an observer of the scene; pose: what observer() returned, changed or not; None: as in its first picture.
        Raises diurna.Error for an unknown observer, for a pose out of range, below the ground or inside an object.
        """
        observer = self._observer(name) if pose is None else _observer_of(pose)
        return Frame(self._core.picture(name, observer))
