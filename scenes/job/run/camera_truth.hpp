#pragma once

#include <map>
#include <string>

#include "render/picture/camera_tags.hpp"
#include "scenes/job/plan/prepared.hpp"

/// Position, time, light and air of a picture: for EXR, manifest and labels.
namespace diurna {

CameraTags camera_tags(const Prepared& prepared, const Observer& observer, Instant instant);

/// Facts by name as text, numbers separated by blanks with nine digits.
using Facts = std::map<std::string, std::string>;

/// Facts of a camera, the same at every instant:
///
///     camera.position_m             east, north, up of the site
///     camera.geodetic               latitude, longitude [°], height above the ellipsoid [m]
///     camera.quaternion             w, x, y, z: turns the camera's right, down, forward to east,
///                                   north, up
///     camera.pointing_deg           azimuth, elevation, roll
///     camera.projection             pinhole, equidistant, ... (render/view/observer.hpp)
///     camera.field_of_view_deg      horizontal, vertical; of an orthographic one its
///     camera.picture_m              width and height
///     camera.intrinsics_pixels      pinhole: fx, fy, cx, cy
Facts camera_facts(const World& world, const Observer& observer);

/// Facts of an instant:
///
///     time.utc, time.local, time.utc_offset_s   ISO 8601; the scene's clock ahead of UTC
///     sun.azimuth_deg, .elevation_deg, .direction   as seen through the air; east, north, up
///     sun.direct_normal_W_m2, .diffuse_horizontal_W_m2   sunlight on open ground, of the picture
///                                   as of the heat balance (scenes/job/world/instant_lights.hpp)
///     sky.longwave_down_W_m2        likewise
///     sky.cloud_cover               0 to 1; with cloud its base and top [m] above the ground, its
///     sky.cloud_base_m, _top_m      thermal emissivity, and the part of the sky whose sunlight it
///     sky.cloud_emissivity          takes with the optical depth it has there
///     sky.cloud_over_sun
///     sky.scale                     ratio of measured light to the scene's air: beam, diffuse,
///                                   emitting column, heat (LightScale); 1 1 1 1: unscaled
///     air.temperature_K, .pressure_Pa, .vapour_pressure_Pa, .wind_m_s   from the weather
///     air.visibility_m              if the air is modelled
Facts instant_facts(const Prepared& prepared, Instant instant);

}  // namespace diurna
