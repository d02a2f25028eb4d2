#include "scenes/job/run/camera_truth.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "materials/base/units.hpp"
#include "render/view/pixel_rays.hpp"
#include "scenes/job/run/sun_on_surfaces.hpp"
#include "terrain/place/local_time.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

std::string truth_text(const std::vector<double>& numbers) {
    std::string text;
    for (const double number : numbers) {
        text += fmt::format("{}{:.9g}", text.empty() ? "" : " ", number + 0.0);
    }
    return text;
}

std::string vector_text(const Eigen::Vector3d& v) { return truth_text({v.x(), v.y(), v.z()}); }

const char* truth_name(Projection projection) {
    for (const ProjectionWord& one : projection_words) {
        if (one.projection == projection) return one.word;
    }
    return "";
}

/// Pixels that a pinhole's picture plane is away.
double focal_pixels(const Observer& observer) {
    return 0.5 * observer.width / std::tan(0.5 * radians(observer.horizontal_fov_deg));
}

/// From the camera's right, up, forward to shares of the picture.
std::optional<Eigen::Matrix4d> camera_to_ndc(const Observer& observer) {
    Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
    if (observer.projection == Projection::pinhole) {
        const double focal = focal_pixels(observer);
        m.row(0) << focal / observer.width, 0.0, 0.5, 0.0;
        m.row(1) << 0.0, -focal / observer.height, 0.5, 0.0;
        m.row(2) << 0.0, 0.0, 0.0, 1.0;  // of the depth its reciprocal
        m.row(3) << 0.0, 0.0, 1.0, 0.0;
        return m;
    }
    if (observer.projection != Projection::orthographic) return std::nullopt;
    const double wide = observer.picture_width;
    m.row(0) << 1.0 / wide, 0.0, 0.0, 0.5;
    m.row(1) << 0.0, -double(observer.width) / (wide * observer.height), 0.0, 0.5;
    m.row(2) << 0.0, 0.0, 1.0, 0.0;
    m.row(3) << 0.0, 0.0, 0.0, 1.0;
    return m;
}

/// The camera's latitude, longitude and height; the last also above the sea.
Geodetic camera_place(const World& world, const Observer& observer, double& altitude) {
    const Geodetic place = to_geodetic(world.site, observer.position);
    altitude = place.height - world.site.height + world.sea_level_height;
    return place;
}

}  // namespace

CameraTags camera_tags(const Prepared& prepared, const Observer& observer, Instant instant) {
    const PixelRays eye = pixel_rays(observer);
    CameraTags tags;
    Eigen::Matrix3d turn;
    turn << eye.right.transpose(), -eye.down.transpose(), eye.axis.transpose();
    tags.world_to_camera.topLeftCorner<3, 3>() = turn;
    tags.world_to_camera.topRightCorner<3, 1>() = -turn * observer.position;
    if (const auto to_ndc = camera_to_ndc(observer)) {
        tags.world_to_ndc = *to_ndc * tags.world_to_camera;
    }
    const double offset = prepared.scene.time.utc_offset;
    tags.cap_date = format_local(instant, offset).substr(0, 19);
    tags.cap_date[4] = tags.cap_date[7] = ':';
    tags.cap_date[10] = ' ';
    tags.utc_offset = 0.0 - offset;
    const Geodetic place = camera_place(prepared.world, observer, tags.altitude);
    tags.longitude = place.longitude_deg;
    tags.latitude = place.latitude_deg;
    tags.exposure = observer.exposure;
    tags.focus = std::numeric_limits<double>::infinity();
    if (eye.flat) tags.window_width = observer.width / focal_pixels(observer);
    return tags;
}

Facts camera_facts(const World& world, const Observer& observer) {
    const PixelRays eye = pixel_rays(observer);
    double altitude = 0.0;
    const Geodetic place = camera_place(world, observer, altitude);
    Eigen::Matrix3d axes;
    axes << eye.right, eye.down, eye.axis;
    Eigen::Quaterniond turn(axes);
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    Facts facts{
        {"camera.position_m", vector_text(observer.position)},
        {"camera.geodetic", truth_text({place.latitude_deg, place.longitude_deg, place.height})},
        {"camera.quaternion", truth_text({turn.w(), turn.x(), turn.y(), turn.z()})},
        {"camera.pointing_deg",
         truth_text({observer.azimuth_deg, observer.elevation_deg, observer.roll_deg})},
        {"camera.projection", truth_name(observer.projection)}};
    if (observer.exposure > 0.0) facts["camera.exposure_s"] = truth_text({observer.exposure});
    if (observer.row_time > 0.0) facts["camera.row_time_s"] = truth_text({observer.row_time});
    const double aspect = double(observer.height) / observer.width;
    const double fov = observer.horizontal_fov_deg;
    if (observer.projection == Projection::orthographic) {
        facts["camera.picture_m"] =
            truth_text({observer.picture_width, observer.picture_width * aspect});
    } else if (eye.flat) {
        const double focal = focal_pixels(observer);
        facts["camera.field_of_view_deg"] =
            truth_text({fov, 2.0 * degrees(std::atan(0.5 * observer.height / focal))});
        facts["camera.intrinsics_pixels"] =
            truth_text({focal, focal, 0.5 * observer.width, 0.5 * observer.height});
    } else if (is_fisheye(observer.projection)) {
        const double up = aspect * fisheye_radius(observer.projection, 0.5 * radians(fov));
        facts["camera.field_of_view_deg"] =
            truth_text({fov, 2.0 * degrees(fisheye_angle(observer.projection, up))});
    } else {
        facts["camera.field_of_view_deg"] = truth_text({fov, fov * aspect});
    }
    return facts;
}

Facts instant_facts(const Prepared& prepared, Instant instant) {
    const Scene& scene = prepared.scene;
    const double offset = scene.time.utc_offset;
    const SunPosition sun = sun_over(prepared, instant);
    const Forcing weather = prepared.weather.at(instant);
    const LightOfInstant light = light_at(prepared, instant);
    Facts facts{{"time.utc", format_instant(instant)},
                {"time.local", format_local(instant, offset)},
                {"time.utc_offset_s", truth_text({offset})},
                {"sun.azimuth_deg", truth_text({sun.azimuth_deg})},
                {"sun.elevation_deg", truth_text({sun.elevation_deg})},
                {"sun.direction", vector_text(sun_direction(sun))},
                {"sun.direct_normal_W_m2", truth_text({light.sums.sun_direct})},
                {"sun.diffuse_horizontal_W_m2", truth_text({light.sums.sun_diffuse})},
                {"sky.longwave_down_W_m2", truth_text({light.sums.thermal})},
                {"air.temperature_K", truth_text({weather.air.temperature})},
                {"air.pressure_Pa", truth_text({weather.air.pressure})},
                {"air.vapour_pressure_Pa", truth_text({weather.air.vapour_pressure})},
                {"air.wind_m_s", truth_text({weather.wind_speed})}};
    if (const auto* model = std::get_if<BandModel>(&light.air)) {
        const CloudLayer& cloud = model->cloud;
        const LightScale& scale = model->scale;
        facts["sky.cloud_cover"] = truth_text({cloud.fraction});
        if (cloud.fraction > 0.0 || cloud.over_sun() > 0.0) {
            facts["sky.cloud_base_m"] = truth_text({1000.0 * scene.air.cloud_base_km});
            facts["sky.cloud_top_m"] =
                truth_text({1000.0 * (scene.air.cloud_base_km + cloud.depth_km)});
            facts["sky.cloud_emissivity"] = truth_text({cloud.emissivity});
            facts["sky.cloud_over_sun"] = truth_text({cloud.over_sun(), cloud.optical_depth});
        }
        facts["sky.scale"] =
            truth_text({scale.beam, scale.diffuse, scale.sky_column, scale.sky_heat});
    }
    if (!scene.air.vacuum && !scene.air.table) {
        facts["air.visibility_m"] = truth_text({1000.0 * scene.air.visibility_km});
    }
    return facts;
}

}  // namespace diurna
