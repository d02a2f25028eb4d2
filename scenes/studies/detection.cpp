#include "scenes/studies/detection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "render/detection/ranges.hpp"
#include "render/detection/resolvable.hpp"
#include "render/detection/task_metric.hpp"
#include "scenes/job/run/sun_on_surfaces.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/studies/air_on_line.hpp"
#include "scenes/studies/contrast_on_line.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

constexpr double wider_detection =
    1.5;  // the picture's half-width over the radius of the target's sphere
constexpr int close_pixels = 192, close_samples = 16;
constexpr int steps = 60;  // of ranges, evenly by ratio

/// The instrument's observer, turned to the target and near enough to fill the picture with it.
Observer close_eye(const Observer& pose, const StudiedTarget& target) {
    Observer eye;
    eye.name = pose.name;
    eye.position = pose.position;
    eye.width = eye.height = close_pixels;
    const double range = (target.box.middle - pose.position).norm();
    eye.horizontal_fov_deg = degrees(2.0 * std::atan(wider_detection * target.radius / range));
    return looking_at(eye, target.box.middle);
}

SeenTarget seen_target(const StudiedTarget& target, const Observer& pose, const std::string& band,
                       const DetectionInput& input, const TemperatureField& field, Instant when,
                       double utc_offset) {
    const Eigen::Vector3d way = pose.position - target.box.middle;
    SeenTarget seen{.when = when, .range = way.norm()};
    if (seen.range < 5.0 * target.radius) {
        throw InputError(
            input.studied.where,
            fmt::format("the instrument's observer is {:.3g} m away, expected at least five times "
                        "the radius of the object's bounding sphere, {:.3g} m",
                        seen.range, target.radius));
    }
    seen.elevation_deg = degrees(std::asin(way.z() / seen.range));
    const CloseUp picture =
        close_up(target, close_eye(pose, target), {band}, close_samples, field, when);
    const ObjectFigures figures = picture.figures("apparent_temperature." + band);
    if (!figures.known()) {
        throw InputError(
            input.studied.where,
            fmt::format("nothing of \"{}\" is visible to the instrument's observer at {}",
                        input.studied.object, format_local(when, utc_offset)));
    }
    const double side = 2.0 * wider_detection * target.radius / close_pixels;
    seen.area = figures.covered * side * side;
    seen.least_width = figures.least_width * side;
    seen.difference = figures.difference;
    seen.contrast = figures.rss();
    seen.background = figures.background;
    seen.spread = figures.spread;
    return seen;
}

std::size_t observer_number(const Scene& scene, const DetectionInput& input) {
    std::size_t o = 0;
    while (scene.observers[o].name != scene.instruments[input.instrument].observer) ++o;
    return o;
}

/// Number of the observer's pose at an instant.
std::size_t frame_at(const Sequence& sequence, Instant when, const DetectionInput& input,
                     const Scene& scene) {
    if (!sequence.goes) return 0;
    const auto at = std::find(sequence.frame.begin(), sequence.frame.end(), when);
    if (at == sequence.frame.end()) {
        throw InputError(input.studied.where,
                         fmt::format("observer {} moves and has no picture at {}",
                                     scene.observers[observer_number(scene, input)].name,
                                     format_local(when, scene.time.utc_offset)),
                         "remove frames: the observer's own instants are used");
    }
    return static_cast<std::size_t>(at - sequence.frame.begin());
}

}  // namespace

std::vector<SeenView> detection_views(const Stages& stages,
                                      const std::vector<DetectionInput>& inputs) {
    const Prepared& prepared = stages.scene();
    std::vector<SeenView> views;
    for (const DetectionInput& input : inputs) {
        const Sequence& sequence = prepared.sequences[observer_number(prepared.scene, input)];
        for (const Instant when : input.studied.frames) {
            const Observer& pose = sequence.at(frame_at(sequence, when, input, prepared.scene));
            const StudiedTarget target = studied_target(stages, input.studied, when);
            views.push_back({close_eye(pose, target), when, 1});
        }
    }
    return views;
}

std::vector<DetectionCurve> detection_of(const Stages& stages, const DetectionInput& input,
                                         const TemperatureField& field, Progress& progress) {
    const Prepared& prepared = stages.scene();
    const Scene& scene = prepared.scene;
    const InstrumentInput& instrument = scene.instruments[input.instrument];
    const std::size_t o = observer_number(scene, input);
    const ObserverInput& observer = scene.observers[o];
    const Sequence& sequence = prepared.sequences[o];
    const Band band = named_band(scene.bands, instrument.band, bin_edges_um());
    const Imager imager =
        imager_of(instrument.instrument, band,
                  focal_length_of(observer, instrument.instrument.detector.pitch));
    const SystemThreshold threshold = system_threshold(imager, input.viewing);
    progress.stage(StageId::named, "pictures of " + input.studied.object);
    std::vector<DetectionCurve> curves(input.studied.frames.size());
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const Instant when = input.studied.frames[i];
        const std::size_t frame = frame_at(sequence, when, input, scene);
        const StudiedTarget target = studied_target(stages, input.studied, when);
        DetectionCurve& curve = curves[i];
        curve.target = seen_target(target, sequence.at(frame), instrument.band, input, field, when,
                                   scene.time.utc_offset);
        const Atmosphere air = light_at(prepared, when).air;
        const double height = height_above_sea(prepared.world, target.box.middle);
        const AirOnLine on_line(air, band, height, curve.target.elevation_deg,
                                std::max(input.range[1], curve.target.range));
        curve.target.transmittance = on_line(curve.target.range);
        const SunPosition sun = sun_over(prepared, when);
        const SeenContrast seen{.range = curve.target.range,
                                .target = curve.target.background + curve.target.difference,
                                .background = curve.target.background,
                                .spread = curve.target.spread};
        const Eigen::Vector3d to_target = target.box.middle - sequence.at(frame).position;
        const ContrastOnLine line(
            air, band,
            {.target_height = height,
             .elevation_deg = curve.target.elevation_deg,
             .sun = {.zenith_deg = 90.0 - sun.elevation_deg, .distance_au = sun.distance_au},
             .azimuth_from_sun_deg =
                 degrees(std::atan2(to_target.x(), to_target.y())) - sun.azimuth_deg},
            seen);
        const ContrastOverRange contrast(line, seen, std::max(input.range[1], seen.range));
        const double root = std::sqrt(curve.target.area);
        const double across = input.across ? curve.target.least_width : root;
        const auto cycles = [&](double range) {
            return resolved_cycles(contrast(range), across, range, imager);
        };
        const auto metric = [&](double range) {
            return task_metric(contrast(range), root, range, threshold, input.viewing);
        };
        for (int k = 0; k <= steps; ++k) {
            const double range =
                input.range[0] * std::pow(input.range[1] / input.range[0], double(k) / steps);
            curve.range.push_back(range);
            curve.transmittance.push_back(on_line(range));
            curve.contrast.push_back(contrast(range));
            for (std::size_t t = 0; t < 3; ++t) {
                curve.johnson[t].push_back(johnson_probability(cycles(range), input.n50[t]));
                curve.metric[t].push_back(ttp_probability(metric(range), input.v50[t]));
            }
        }
        for (std::size_t t = 0; t < 3; ++t) {
            for (const double p : input.probabilities) {
                curve.johnson_range[t].push_back(farthest_range(
                    cycles, input.n50[t] * johnson_ratio(p), input.range[0], input.range[1]));
                curve.metric_range[t].push_back(farthest_range(metric, input.v50[t] * ttp_ratio(p),
                                                               input.range[0], input.range[1]));
            }
        }
        progress.done(double(i + 1) / double(curves.size()));
    }
    return curves;
}

std::vector<std::string> detection_notes(const Scene& scene, const DetectionInput& input) {
    const InstrumentInput& instrument = scene.instruments[input.instrument];
    std::vector<std::string> notes;
    for (const ObserverInput& observer : scene.observers) {
        if (observer.name != instrument.observer) continue;
        const Band band = named_band(scene.bands, instrument.band);
        const Imager imager =
            imager_of(instrument.instrument, band,
                      focal_length_of(observer, instrument.instrument.detector.pitch));
        notes.push_back(
            fmt::format("{}: pixels of {:.4g} mrad, MTF {:.3f} at the Nyquist frequency ({:.3g} "
                        "cycles/mrad), above which no signal is counted; NETD {:.3g} mK for a "
                        "background of 300 K; {:g} frames per second",
                        instrument.instrument.name, imager.pixel, imager.mtf_right(imager.finest()),
                        imager.finest(), 1e3 * imager.netd, imager.frame_rate));
    }
    notes.push_back(fmt::format(
        "display: {:g} cd/m2, magnification {:.3g}, mean luminance for {:g} K of scene contrast",
        input.viewing.luminance, input.viewing.magnification, input.viewing.scene_contrast));
    notes.emplace_back(
        "only temporal noise is included: residual fixed-pattern noise, clutter and search are "
        "omitted; turbulence is that of the instrument's own range");
    notes.emplace_back(
        "absolute ranges are not validated: no published example gives all of its inputs; the "
        "formulas are tested against printed tables and closed forms");
    return notes;
}

}  // namespace diurna
