#include "scenes/job/run/check_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>

#include "materials/base/number_of.hpp"
#include "materials/base/random.hpp"
#include "render/view/linear_facets.hpp"
#include "render/view/pixel_heat.hpp"
#include "render/view/pixel_sun.hpp"
#include "scenes/job/run/check_weights.hpp"
#include "scenes/job/run/remembered_sun.hpp"
#include "scenes/job/run/sun_on_surfaces.hpp"
#include "terrain/place/local_time.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/sun_fraction.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_named = 4;  // materials

/// The points' surfaces and all that share a corner with one, and levels of textures there.
std::vector<SurfaceId> about(const World& world, const CheckPoints& points) {
    const FacetSet& facets = world.facets;
    const TextureLevels& levels = world.texture_levels;
    std::vector<std::uint8_t> touched(facets.vertex.size(), 0);
    for (const CheckPoint& point : points.point) {
        const std::size_t f = index(levels.facet_of(point.surface));
        for (const std::uint32_t v : facets.corner[f]) touched[v] = 1;
    }
    std::vector<SurfaceId> near;
    for (std::size_t f = 0; f < world.surfaces().size(); ++f) {
        const auto& corner = facets.corner[index(levels.facet_of(surface_id(f)))];
        if (std::any_of(corner.begin(), corner.end(), [&](auto v) { return touched[v] != 0; })) {
            near.push_back(surface_id(f));
        }
    }
    return near;
}

/// At one instant: (point) [K].
struct AtPoints {
    std::vector<float> warmer;  // by how much a picture shows it warmer than its surface's mean
    std::vector<float> by_sun;  // error of its surface's mean due to the number of rays to the sun
};

/// The points' shares of the sun over the hours before.
std::vector<float> remembered_at(const CheckPoints& points, const PastSun& past,
                                 const Prepared& prepared, std::span<const float> present) {
    constexpr int samples = 2;  // of the disc, for each past sun
    const TextureLevels& levels = prepared.world.texture_levels;
    std::vector<float> share(present.begin(), present.begin() + points.point.size());
    std::vector<float> now(points.patch.size());
    for (std::size_t c = 0; c < past.course.size(); ++c) {
        std::vector<std::uint32_t> chosen;
        for (std::uint32_t k = 0; k < share.size(); ++k) {
            if (past.of_facet[index(levels.facet_of(points.point[k].surface))] != c) continue;
            chosen.push_back(k);
            share[k] = 0.0f;
        }
        for (const Eigen::Vector3d& to_sun : past.course[c]) {
            sun_fraction(points.patch, prepared.rays, to_sun, chosen, now,
                         {.samples = samples, .seed = prepared.scene.seed});
            for (const std::uint32_t k : chosen) share[k] += now[k] / float(PastSun::quantiles);
        }
    }
    return share;
}

AtPoints in_pictures(const SceneStage& stage, const CheckPoints& points,
                     std::span<const SurfaceId> near, Instant when,
                     std::span<const float> temperature) {
    const auto& [prepared, views, store] = stage;
    AtPoints at{.warmer = std::vector<float>(points.point.size(), 0.0f),
                .by_sun = std::vector<float>(points.point.size(), 0.0f)};
    std::vector<float>& warmer = at.warmer;
    const World& world = prepared.world;
    const SunPosition place = sun_over(prepared, when);
    const std::vector<float> fraction =
        sun_on_surfaces(prepared, place, prepared.scene.sun_samples, near);
    const TextureLevels& levels = world.texture_levels;
    const FacetSet& surfaces = world.surfaces();
    const RememberedSun remembered = remembered_sun(prepared, views, fraction, near, when);
    const SunOverFacets sun{prepared.rays,
                            surfaces,
                            fraction,
                            sun_direction(place),
                            remembered.moments(),
                            remembered.empty() ? nullptr : &remembered.past};
    std::vector<SurfaceId> of_point;
    for (const CheckPoint& point : points.point) of_point.push_back(point.surface);
    const std::vector<FacetSlope> slope =
        facet_slopes(CornerFits(surfaces, of_point), {.sun = sun, .temperature = temperature});
    for (std::size_t k = 0; k < warmer.size(); ++k) {
        const CheckPoint& point = points.point[k];
        warmer[k] = slope[k].at(point.place - surfaces.centroid[index(point.surface)]);
    }
    if (fraction.empty()) return at;
    const std::vector<std::uint8_t> crossed = on_surfaces(levels, facets_with_edges(sun, &levels));
    const std::span<const float> mean = sun.past ? std::span(sun.past->share) : fraction;
    const std::vector<float> kelvins = kelvins_of_sun(
        surfaces, crossed, mean, temperature,
        most_kelvins_of_sun(surfaces, prepared.scene.materials, sun.to_sun, temperature));
    const SunExposure on_patch = sun_at(points, prepared, {when});
    const std::vector<float> share =
        sun.past ? remembered_at(points, *sun.past, prepared, on_patch.fraction)
                 : on_patch.fraction;
    for (std::size_t k = 0; k < warmer.size(); ++k) {
        const std::size_t f = index(points.point[k].surface);
        warmer[k] += kelvins[f] * (share[k] - mean[f]);
        const float on_whole = on_patch.fraction[points.point.size() + k];
        at.by_sun[k] = kelvins[f] * (fraction[f] - on_whole);
    }
    return at;
}

/// Squares [K²], weighted by pixels.
struct Sum {
    double squares = 0.0, pixels = 0.0;
    std::size_t points = 0;

    void add(double square, double weight) {
        squares += weight * square;
        pixels += weight;
    }
    double rms() const { return pixels > 0.0 ? std::sqrt(squares / pixels) : 0.0; }
};

/// [K] 2.5th and 97.5th percentile of the rms where points are drawn again with replacement.
std::pair<double, double> interval(const std::vector<Sum>& of_point, std::uint64_t seed) {
    constexpr std::size_t draws = 400;
    RandomStream random{hashed(seed)};
    std::vector<double> rms;
    for (std::size_t draw = 0; draw < draws; ++draw) {
        Sum sum;
        for (std::size_t k = 0; k < of_point.size(); ++k) {
            const Sum& drawn = of_point[std::size_t(random() * double(of_point.size()))];
            sum.squares += drawn.squares;
            sum.pixels += drawn.pixels;
        }
        rms.push_back(sum.rms());
    }
    std::sort(rms.begin(), rms.end());
    return {rms[draws / 40], rms[draws - 1 - draws / 40]};
}

/// What a facet's error of rays r explains of the error e at places on it, by regression: a picture
/// averages around corners, so only a share of r is left there.
struct Explained {
    std::vector<double> cross;  // (point) sums over instants of e r [K²], weighted by pixels
    double own = 0.0;           // sum of r² [K²], likewise

    explicit Explained(std::size_t points) : cross(points, 0.0) {}
    void add(std::size_t point, double e, double r, double weight) {
        cross[point] += weight * e * r;
        own += weight * r * r;
    }
    /// [K²] Sum over the places; 0 where e and r do not go together by twice the standard error of
    /// their covariance (places are independent, a place's instants are not).
    double squares() const {
        double sum = 0.0, squares = 0.0;
        for (const double of_point : cross) {
            sum += of_point;
            squares += of_point * of_point;
        }
        return sum > 2.0 * std::sqrt(squares) ? sum * sum / own : 0.0;
    }
};

/// The value that a hundredth of the pixels exceeds; (value, pixels).
double percentile_99(std::vector<std::pair<double, double>> off) {
    std::sort(off.begin(), off.end());
    double all = 0.0, below = 0.0;
    for (const auto& [value, pixels] : off) all += pixels;
    for (const auto& [value, pixels] : off) {
        below += pixels;
        if (below >= 0.99 * all) return value;
    }
    return 0.0;
}

}  // namespace

CheckError check_error(const Stages& stages, const CheckPoints& points,
                       const TemperatureField& field, std::span<const float> patches) {
    CheckError error;
    const Prepared& prepared = stages.scene();
    const std::size_t count = points.point.size();
    if (count == 0 || field.instant.empty()) return error;
    const CheckWeights weights = check_weights(prepared, points, field.instant);
    const std::vector<SurfaceId> near = about(prepared.world, points);
    const FacetSet& surfaces = prepared.world.surfaces();
    std::vector<std::pair<double, double>> off;  // [K], pixels
    std::map<std::uint32_t, Sum> observers;
    std::map<std::string, Sum> materials;
    std::vector<Sum> of_point(count);
    Sum sum;
    Explained of_ground(count), of_objects(count), of_sun(count);
    for (std::size_t a = 0; a < weights.instant.size(); ++a) {
        const std::size_t i = weights.instant[a];
        const std::span<const float> kelvin = field.at(i);
        const AtPoints shown = in_pictures(stages.at_instant(field.instant[i]), points, near,
                                           field.instant[i], kelvin);
        for (std::size_t k = 0; k < count; ++k) {
            const CheckPoint& point = points.point[k];
            const double pixels = weights.pixels(a, point);
            if (pixels == 0.0) continue;
            const std::size_t f = index(point.surface);
            const double apparent = double{weights.apparent[k]};
            const float* const patch = patches.data() + 2 * i * count;
            const double e =
                apparent * (double{kelvin[f]} + double{shown.warmer[k]} - double{patch[k]});
            const double all_rays = apparent * (double{kelvin[f]} - double{patch[count + k]});
            const double sun = std::clamp(apparent * double{shown.by_sun[k]}, -std::abs(all_rays),
                                          std::abs(all_rays));
            Explained& sky = prepared.world.on_ground(point.surface) ? of_ground : of_objects;
            sky.add(k, e, all_rays - sun, pixels);
            of_sun.add(k, e, sun, pixels);
            off.emplace_back(std::abs(e), pixels);
            const std::string& material = prepared.scene.materials[surfaces.material[f]].kind();
            for (Sum* to : {&sum, &of_point[k], &observers[point.observer], &materials[material]}) {
                to->add(e * e, pixels);
            }
            if (std::abs(e) <= error.worst) continue;
            error.worst = std::abs(e);
            error.worst_at =
                fmt::format("facet {} of {} at {}", f, material,
                            format_local(field.instant[i], prepared.scene.time.utc_offset));
        }
    }
    for (const CheckPoint& point : points.point) {
        const std::size_t f = index(point.surface);
        ++observers[point.observer].points;
        ++materials[prepared.scene.materials[surfaces.material[f]].kind()].points;
    }
    error.rms = sum.rms();
    const double rays = of_ground.squares() + of_objects.squares() + of_sun.squares();
    error.parts = {.ground_rays = of_ground.squares() / sum.pixels,
                   .object_rays = of_objects.squares() / sum.pixels,
                   .sun_rays = of_sun.squares() / sum.pixels,
                   .size = std::max(0.0, sum.squares - rays) / sum.pixels};
    error.by_rays = std::sqrt(rays / sum.pixels);
    std::tie(error.low, error.high) = interval(of_point, prepared.scene.seed);
    error.percentile_99 = percentile_99(std::move(off));
    for (const auto& [o, of] : observers) {
        error.observer.push_back({prepared.scene.observers[o].name, of.rms(), of.points});
    }
    for (const auto& [name, of] : materials) {
        if (sum.squares > 0.0) {
            error.share.push_back({name, of.squares / sum.squares, of.points});
        }
    }
    std::stable_sort(error.share.begin(), error.share.end(),
                     [](const auto& a, const auto& b) { return a.rms > b.rms; });
    error.set = recommended_settings(error.parts, prepared.scene, prepared.scene.tolerance);
    return error;
}

std::string in_words(const CheckError& error, const CheckPoints& points, double tolerance) {
    const std::string unchecked =
        points.skipped == 0
            ? ""
            : fmt::format(
                  "; {} on panes, nets, sheets, targets, copies or moving objects {} not checked",
                  number_of(points.skipped, "place"), points.skipped == 1 ? "is" : "are");
    if (points.point.empty()) {
        return fmt::format("{} no picture beyond 3 µm shows ground or a plain object{}",
                           check_begins, unchecked);
    }
    std::vector<std::string> observers, materials;
    for (const CheckError::Of& of : error.observer) {
        observers.push_back(fmt::format("{} {:.2f} K", of.name, of.rms));
    }
    for (const CheckError::Of& of : error.share) {
        if (of.rms < 0.05 || materials.size() == most_named) break;
        materials.push_back(fmt::format("{} {:.0f} %", of.name, 100.0 * of.rms));
    }
    std::string line = fmt::format(
        "{} apparent temperatures in pictures differ by {:.2f} K rms (95 % interval {:.2f} to "
        "{:.2f}) from "
        "{} places solved with sun, sky and surroundings of their own; {:.2f} K of it comes from "
        "the number of rays; 99th percentile {:.2f} K, largest {:.1f} K ({}); by observer: {}; "
        "share of the mean square: {}",
        check_begins, error.rms, error.low, error.high, points.point.size(), error.by_rays,
        error.percentile_99, error.worst, error.worst_at, fmt::join(observers, ", "),
        fmt::join(materials, ", "));
    line += unchecked;
    if (tolerance > 0.0 && error.low > tolerance) {
        line += fmt::format("; this is more than tolerance_K = {:g}", tolerance);
        if (!error.set.empty()) {
            line += fmt::format("; to meet it, set {}", in_words(error.set));
        }
    }
    return line;
}

}  // namespace diurna
