#include "scenes/job/input/read_projection.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// The field of view from a focal plane behind a lens.
double read_lens(const Section& section, int width, PictureAngles& angles) {
    const double focal_length = section.number(
        "focal_length_mm",
        "focal length of a pinhole, with pixel_pitch_um, instead of horizontal_fov_deg",
        {0.1, 1e5});
    const double pitch =
        section.number("pixel_pitch_um", "pixel pitch, with focal_length_mm", {0.1, 1e4});
    angles.pixel_pitch_um = pitch;
    const double fov_deg = field_of_view_deg(width, pitch, focal_length);
    if (angles.projection != Projection::pinhole || section.has("horizontal_fov_deg")) {
        section.mistake("focal_length_mm", "applies to pinhole cameras without horizontal_fov_deg");
    } else if (!(fov_deg <= 150.0)) {
        section.mistake(
            "focal_length_mm",
            fmt::format("gives a field of view of {:.1f} degrees, expected at most 150", fov_deg));
    }
    return fov_deg;
}

/// No pixel may look round the back of the sphere, where things are seen again.
void check_sphere(const Section& section, const PictureAngles& angles, double width,
                  double height) {
    const double half = radians(0.5 * angles.horizontal_fov_deg);
    const char* key = section.has("height") ? "height" : "horizontal_fov_deg";
    if (angles.projection == Projection::panorama) {
        const double most = degrees(2.0 * half * height / width);
        if (most <= 180.0 + 1e-9) return;
        section.mistake(
            key,
            fmt::format("the rows of the panorama span {:.0f} degrees, expected at most 180", most),
            fmt::format("height = {:.0f} is pole to pole for this width",
                        std::floor(1e-6 + width * 90.0 / degrees(half))));
        return;
    }
    if (!is_fisheye(angles.projection)) return;
    const double to_corner = std::hypot(1.0, height / width);
    const double edge = fisheye_radius(angles.projection, std::numbers::pi);
    if (fisheye_radius(angles.projection, half) * to_corner <= edge + 1e-9) return;
    section.mistake(
        key,
        "pixels in the corners of the fisheye's picture have directions behind it, expected at "
        "most 180 degrees from its axis",
        fmt::format(
            "horizontal_fov_deg = {:.0f} is the whole sphere for this picture",
            std::floor(1e-6 + 2.0 * degrees(fisheye_angle(angles.projection, edge / to_corner)))));
}

}  // namespace

PictureAngles read_projection(const Section& section, int width, int height) {
    PictureAngles angles;
    std::vector<Choice<Projection>> choices;
    for (const auto& [word, projection] : projection_words) choices.push_back({word, projection});
    angles.projection = section.choice_or("projection", "mapping of directions to the picture",
                                          Projection::pinhole, choices);
    if (angles.projection == Projection::orthographic) {
        angles.picture_width =
            section.number("picture_width_m", "width of the picture", {0.01, 2e5});
        for (const char* key : {"horizontal_fov_deg", "focal_length_mm", "pixel_pitch_um"}) {
            if (section.has(key)) {
                section.mistake(key,
                                "does not apply to orthographic pictures, whose rays are parallel: "
                                "use picture_width_m");
            }
        }
        return angles;
    }
    if (section.has("picture_width_m")) {
        section.mistake("picture_width_m",
                        "applies to orthographic pictures, expected horizontal_fov_deg");
    }
    if (section.has("focal_length_mm")) {
        angles.horizontal_fov_deg = read_lens(section, width, angles);
    } else {
        const bool pinhole = angles.projection == Projection::pinhole;
        angles.horizontal_fov_deg = section.number_or(
            "horizontal_fov_deg", "horizontal field of view; pinhole: default 20, at most 150",
            pinhole ? 20.0 : 180.0, {0.01, pinhole ? 150.0 : 360.0});
        check_sphere(section, angles, width, height);
    }
    return angles;
}

}  // namespace diurna
