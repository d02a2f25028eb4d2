#include "render/rays/secondary_tables.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "materials/air/sight_line.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/waves.hpp"
#include "render/light/node_spectra.hpp"
#include "render/path/direction_angles.hpp"
#include "render/rays/lobe.hpp"

namespace diurna {

namespace {

PathExtent extent_of(const SecondaryRays& secondary_rays, const RadianceInput& input) {
    float near = 1e30f, far = 0.0f, low = 1e30f, high = -1e30f;
    for (const SecondaryRay& secondary : secondary_rays.secondary) {
        if (secondary.kind == SecondaryRay::Kind::sky) continue;
        near = std::min(near, secondary.range);
        far = std::max(far, secondary.range);
        low = std::min(low, secondary.height);
        high = std::max(high, secondary.height);
    }
    if (far == 0.0f) near = low = high = 0.0f;  // nothing but sky
    return {.observer_height_km = input.above_sea_km(secondary_rays.observer_height),
            .least_range_km = std::max(1e-6, 1e-3 * double(near)),
            .most_range_km = std::max(1e-3, 1e-3 * double(far)),
            .least_height_km = input.above_sea_km(double(low)),
            .most_height_km = input.above_sea_km(double(high))};
}

bool contains(const PathExtent& whole, const PathExtent& part) {
    constexpr double slack = 1e-6;
    return whole.observer_height_km == part.observer_height_km &&
           whole.least_range_km <= part.least_range_km + slack &&
           whole.most_range_km + slack >= part.most_range_km &&
           whole.least_height_km <= part.least_height_km + slack &&
           whole.most_height_km + slack >= part.most_height_km;
}

/// The air before the secondary rays: the whole picture's where that reaches as far.
AirLanes air_of(const SecondaryTables& tables) {
    const PathExtent extent = extent_of(tables.secondary_rays, tables.input);
    const PathTable* whole = tables.options.path;
    if (whole && contains(whole->grid().extent, extent)) {
        return AirLanes(*whole, tables.band, tables.lanes);
    }
    return AirLanes(PathTable(tables.input, extent, tables.band, tables.options.tolerance),
                    tables.band, tables.lanes);
}

std::vector<std::uint32_t> targets_of(const SecondaryRays& secondary_rays,
                                      std::span<const SurfaceId> facets) {
    std::vector<std::uint32_t> target;
    for (const SecondaryRay& secondary : secondary_rays.secondary) {
        const auto at = std::lower_bound(facets.begin(), facets.end(), secondary.surface());
        target.push_back(static_cast<std::uint32_t>(at - facets.begin()));
    }
    return target;
}

std::vector<float> sums(const BandLight& of, std::span<const double> spectrum) {
    return channel_sums(of.band, of.channels, spectrum);
}

/// Absorption of a plume, its mean in each channel.
std::vector<float> absorption_of(const BandLight& of, const Plume& plume) {
    std::vector<double> k;
    for (const double um : of.band.node_um) k.push_back(plume.absorption_at(um));
    std::vector<float> mean = sums(of, k);
    const std::vector<float> width = sums(of, std::vector<double>(k.size(), 1.0));
    for (std::size_t c = 0; c < of.channels.size(); ++c) {
        mean[c] /= width[c] > 0.0f ? width[c] : 1.0f;
    }
    return mean;
}

}  // namespace

SecondaryTables::SecondaryTables(const SecondaryRays& secondary_rays_of,
                                 std::span<const Plume> plumes, const SceneLight& light_of,
                                 std::size_t first_of, const SecondaryOptions& options_of)
    : secondary_rays(secondary_rays_of),
      light(light_of),
      lit(light.lit),
      input(light.input),
      options(options_of),
      first(first_of),
      facet(surfaces_of(secondary_rays)),
      target(targets_of(secondary_rays, facet)),
      band(light.band),
      lanes(band),
      facet_lanes(light, first, facet.size(), lanes, options.by_term),
      air(air_of(*this)) {
    fill_materials();
    fill_plumes(plumes);
    fill_backgrounds();
    fill_scattered_paths(extent_of(secondary_rays, input));
}

void SecondaryTables::fill_materials() {
    for (std::size_t h = 0; h < sun.size(); ++h) {
        sun[h] = lanes.side_by_side(
            [&](std::size_t b) { return sums(band[b], band[b].incident[h].sun); });
        sun_and_aureole[h] = lanes.side_by_side([&](std::size_t b) {
            return sums(band[b], from(band[b].incident[h].sun_by_origin(), Origin::sunlight));
        });
    }
    angle.resize(input.materials.size());
    room.resize(input.materials.size());
    std::vector<bool> met(input.materials.size(), false);
    for (const SurfaceId f : facet) met[index(input.facets.material[index(f)])] = true;
    for (std::size_t m = 0; m < input.materials.size(); ++m) {
        const Material& of = input.materials[MaterialId{static_cast<std::uint16_t>(m)}];
        if (!met[m] || !of.needs_rays()) continue;
        angle[m] = AngleTable(under_wind(of, input.wind_speed), band, lanes,
                              double{light.state.extent.middle()});
        if (band.empty() || band[0].optics[m].room.empty()) continue;
        room[m] = lanes.side_by_side(
            [&](std::size_t b) { return sums(band[b], band[b].optics[m].room); });
    }
}

void SecondaryTables::fill_plumes(std::span<const Plume> plumes) {
    for (const Plume& plume : plumes) {
        absorption.push_back(
            lanes.side_by_side([&](std::size_t b) { return absorption_of(band[b], plume); }));
        glow.push_back(lanes.side_by_side([&](std::size_t b) {
            return sums(band[b], black_body(band[b].band, plume.temperature));
        }));
    }
}

bool SecondaryTables::is_rough_mirror(const SecondaryRay& secondary) const {
    return secondary.kind == SecondaryRay::Kind::facet && !secondary.closed &&
           std::holds_alternative<Glossy>(material(secondary).finish) &&
           roughness_under(material(secondary).finish, input.wind_speed) >= least_lobe;
}

/// Whether a secondary ray is sky in a mirror, or a mirror that shows it all over its lobe.
bool SecondaryTables::shows_sky(const SecondaryRay& secondary) const {
    return (secondary.kind == SecondaryRay::Kind::sky && !secondary.straight) ||
           is_rough_mirror(secondary);
}

/// Height from which mirrors see the sky, its mean [km].
double SecondaryTables::mirror_height_km() const {
    double sum = 0.0, count = 0.0;
    for (const SecondaryRay& secondary : secondary_rays.secondary) {
        if (!shows_sky(secondary)) continue;
        sum += input.above_sea_km(double{secondary.height});
        count += 1.0;
    }
    return count > 0.0 ? sum / count : input.ground_height_km;
}

/// Ranges [m] of the mirrors that show the sky, the nearest and the farthest.
std::array<double, 2> SecondaryTables::mirror_ranges() const {
    std::array<double, 2> ranges = {1e30, 0.0};
    for (std::size_t k = 0; k < secondary_rays.pixel.size(); ++k) {
        const std::span<const SecondaryRay> list = secondary_rays.of(k);
        for (const SecondaryRay& secondary : list) {
            if (!shows_sky(secondary)) continue;
            const SecondaryRay& mirror = secondary.kind == SecondaryRay::Kind::sky
                                             ? list[static_cast<std::size_t>(secondary.before)]
                                             : secondary;
            ranges = {std::min(ranges[0], double{mirror.range}),
                      std::max(ranges[1], double{mirror.range})};
        }
    }
    return ranges;
}

/// A lobe goes anywhere above its surface; that of water, which is level, upward, and of water seen
/// at a grazing angle to where it is looked along: what is farther aside counts as at 60°.
void SecondaryTables::include_lobe(const SecondaryRay& secondary,
                                   BackgroundChannels::Extent& extent) const {
    const Eigen::Vector3d along = secondary.direction.cast<double>(), up = Eigen::Vector3d::UnitZ();
    extent.least_zenith_deg = 0.0;
    const bool level = std::get<Glossy>(material(secondary).finish).waves;
    if (level && secondary.cosine < 0.25f) {
        for (const double aside : {-radians(60.0), 0.0, radians(60.0)}) {
            const Eigen::AngleAxisd turn(aside, up);
            extent.include(turn * Eigen::Vector3d(along.x(), along.y(), 0.0).normalized(),
                           input.to_sun);
        }
        return;
    }
    extent.include(level ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : Eigen::Vector3d(-up),
                   input.to_sun);
    extent.least_azimuth_deg = 0.0;
    extent.most_azimuth_deg = 180.0;
}

void SecondaryTables::fill_backgrounds() {
    BackgroundChannels::Extent straight, in_mirrors;
    for (const SecondaryRay& secondary : secondary_rays.secondary) {
        if (is_rough_mirror(secondary)) include_lobe(secondary, in_mirrors);
        if (secondary.kind != SecondaryRay::Kind::sky) continue;
        (secondary.straight ? straight : in_mirrors)
            .include(secondary.direction.cast<double>(), input.to_sun);
    }
    const double eye_km = input.above_sea_km(secondary_rays.observer_height);
    if (straight.any()) {
        for (const BandLight& one : band) from_eye.emplace_back(input, one, eye_km, straight);
    }
    if (in_mirrors.any()) fill_mirrored(in_mirrors);
}

void SecondaryTables::fill_mirrored(const BackgroundChannels::Extent& extent) {
    const auto [near, far] = mirror_ranges();
    const double spread = far / near;
    // What is joined changes slowly with range: within a tenth of it by 0.1 % of the sky.
    const std::size_t ranges = spread < 1.1 ? 1 : spread < 1.4 ? 2 : spread < 2.0 ? 3 : most_few;
    mirrored.root_low = ranges > 1 ? std::cbrt(near) : 0.5 * (std::cbrt(near) + std::cbrt(far));
    if (ranges > 1) mirrored.root_step = (std::cbrt(far) - std::cbrt(near)) / double(ranges - 1);
    const double eye_km = input.above_sea_km(secondary_rays.observer_height);
    const double mirror_km = mirror_height_km();
    for (std::size_t k = 0; k < ranges; ++k) {
        const double root = mirrored.root_low + mirrored.root_step * double(k);
        const SightLine to_mirror = chord(eye_km, mirror_km, 1e-3 * root * root * root);
        auto& tables = mirrored.at.emplace_back();
        for (const BandLight& one : band) {
            BackgroundChannels& table =
                tables.emplace_back(input, one, mirror_km, extent, to_mirror);
            std::vector<double> tau =
                path_at_nodes(input.atmosphere, to_mirror, channel_um(one.band, one.channels))
                    .transmittance;
            tau.resize(one.channels.padded(), 0.0);
            std::vector<float> undimmed;
            for (const double t : tau) undimmed.push_back(t > 1e-30 ? float(1.0 / t) : 0.0f);
            table.scale(undimmed);
        }
    }
}

void SecondaryTables::fill_scattered_paths(const PathExtent& extent) {
    ScatteredPath::Angles angles{180.0, 0.0};
    for (const SecondaryRay& secondary : secondary_rays.secondary) {
        const double from_sun = angle_between_deg(secondary.direction.cast<double>(), input.to_sun);
        angles.least_deg = std::min(angles.least_deg, from_sun);
        angles.most_deg = std::max(angles.most_deg, from_sun);
    }
    scattered_path.resize(band.size());
    for (std::size_t b = 0; b < band.size(); ++b) {
        if (!band[b].scattered) continue;
        scattered_path[b].emplace(*band[b].scattered, band[b].band, extent, angles);
    }
}

void SecondaryTables::background_towards(const Eigen::Vector3d& direction,
                                         std::span<float> out) const {
    const BackgroundChannels::Place at = from_eye[0].place(direction);
    std::fill(out.begin(), out.end(), 0.0f);
    for (std::size_t b = 0; b < band.size(); ++b) {
        from_eye[b].add(at, 1.0f, out.subspan(lanes.first[b], band[b].channels.padded()));
    }
}

void SecondaryTables::mirrored_background(const Eigen::Vector3d& direction, float range,
                                          std::span<float> out) const {
    const std::size_t ranges = mirrored.at.size(), near = std::min<std::size_t>(ranges, 3);
    const double root = std::cbrt(double{range});
    const double place = (root - mirrored.root_low) / mirrored.root_step;
    // Of the ranges three about the mirror's.
    const double last = double(ranges - near);
    const auto start = static_cast<std::size_t>(std::clamp(std::round(place) - 1.0, 0.0, last));
    std::array<float, most_few> weight{1.0f};
    if (ranges > 1)
        weight = product_weights_of_few(static_cast<float>(place - double(start)), near);
    const BackgroundChannels::Place at = mirrored.at[0][0].place(direction);
    std::fill(out.begin(), out.end(), 0.0f);
    for (std::size_t k = 0; k < near; ++k) {
        for (std::size_t b = 0; b < band.size(); ++b) {
            mirrored.at[start + k][b].add(at, weight[k],
                                          out.subspan(lanes.first[b], band[b].channels.padded()));
        }
    }
}

}  // namespace diurna
