#include "scenes/studies/signature.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "scenes/studies/signature_aspects.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

constexpr double wider = 1.5;      // the picture's half-width over the radius of the sphere
constexpr double outside = 1.001;  // parallel rays begin so many radii away

/// Direction in the object's frame.
struct Aspect {
    double azimuth_deg, elevation_deg;
};

std::vector<Aspect> aspects_above(int count, std::size_t& below) {
    std::vector<Aspect> found;
    for (const Eigen::Vector3d& way : even_directions(count)) {
        if (way.z() < -1e-9) {
            ++below;
            continue;
        }
        const double azimuth =
            std::hypot(way.x(), way.y()) < 1e-9 ? 0.0 : degrees(std::atan2(way.x(), way.y()));
        found.push_back({azimuth, degrees(std::asin(std::min(1.0, std::max(0.0, way.z()))))});
    }
    return found;
}

Observer eye_of(const SignatureInput& input, const StudiedTarget& target, const Aspect& aspect) {
    Observer eye;
    eye.name = input.name;
    eye.width = eye.height = input.pixels;
    const Eigen::Vector3d way =
        direction(target.heading_deg + aspect.azimuth_deg, aspect.elevation_deg);
    double range = outside * target.radius;
    if (input.range > 0.0) {
        range = input.range;
        eye.horizontal_fov_deg = degrees(2.0 * std::atan(wider * target.radius / range));
    } else {
        eye.projection = Projection::orthographic;
        eye.picture_width = 2.0 * wider * target.radius;
    }
    eye.position = target.box.middle + range * way;
    if (aspect.elevation_deg > 90.0 - 1e-6) {  // straight down: its front is up in the picture
        eye.elevation_deg = -90.0;
        eye.azimuth_deg = target.heading_deg;
        return eye;
    }
    return looking_at(eye, target.box.middle);
}

}  // namespace

std::vector<SeenView> signature_views(const Stages& stages,
                                      const std::vector<SignatureInput>& inputs) {
    constexpr std::size_t most = 24;
    std::vector<SeenView> views;
    for (const SignatureInput& input : inputs) {
        std::size_t below = 0;
        const std::vector<Aspect> aspects = aspects_above(input.directions, below);
        const std::size_t some = std::min(most, aspects.size());
        for (const Instant when : input.studied.frames) {
            const StudiedTarget target = studied_target(stages, input.studied, when);
            for (std::size_t k = 0; k < some; ++k) {
                const Aspect& aspect = aspects[k * aspects.size() / some];
                views.push_back({eye_of(input, target, aspect), when, 1});
            }
        }
    }
    return views;
}

SignatureReport signature_of(const Stages& stages, const SignatureInput& input,
                             const TemperatureField& field, Progress& progress) {
    SignatureReport report;
    const std::vector<Aspect> aspects = aspects_above(input.directions, report.below);
    const std::size_t bands = input.bands.size(), all = aspects.size();
    report.rows.resize(input.studied.frames.size() * bands * all);
    progress.stage(StageId::named, "aspects of " + input.studied.object);
    std::atomic<std::size_t> done = 0;
    for (std::size_t i = 0; i < input.studied.frames.size(); ++i) {
        const Instant when = input.studied.frames[i];
        const StudiedTarget target = studied_target(stages, input.studied, when);
        if (input.range > 0.0 && input.range < 5.0 * target.radius) {
            throw InputError(input.studied.where,
                             fmt::format("found range_m {:g}, expected at least five times the "
                                         "radius of the object's bounding sphere, {:.3g} m",
                                         input.range, target.radius));
        }
        const double side = 2.0 * wider * target.radius / input.pixels;  // [m] of a pixel there
        const auto see = [&](std::size_t a) {
            const CloseUp picture = close_up(target, eye_of(input, target, aspects[a]), input.bands,
                                             input.samples, field, when);
            for (std::size_t b = 0; b < bands; ++b) {
                const ObjectFigures seen = picture.figures("radiance." + input.bands[b]);
                SignatureRow& row = report.rows[(i * bands + b) * all + a];
                row = {.when = when,
                       .band = input.bands[b],
                       .aspect_deg = aspects[a].azimuth_deg,
                       .elevation_deg = aspects[a].elevation_deg};
                row.area = seen.covered * side * side;
                // (T52) of docs/theory.md
                row.intensity = (seen.difference + seen.background) * row.area;
                row.contrast = seen.difference * row.area;
                row.background = seen.background;
                if (seen.background_pixels > 0) continue;
                row.contrast = row.background = std::numeric_limits<double>::quiet_NaN();
            }
            progress.done(double(++done) / double(all * input.studied.frames.size()));
        };
        for_each_index(all, see, 1);
    }
    for (const SignatureRow& row : report.rows) {
        report.hidden += row.area > 0.0 ? 0 : 1;
        report.alone += std::isnan(row.contrast) ? 1 : 0;
    }
    return report;
}

}  // namespace diurna
