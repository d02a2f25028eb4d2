#include "scenes/job/world/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "materials/base/random.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/microfacet.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/visibility/lifted_facet.hpp"

namespace diurna {

namespace {

constexpr double film = 8.3;              // [W m⁻² K⁻¹]
constexpr double of_sky = 150.0;          // [W/m²]
constexpr double of_kinds = 100.0;        // [W/m²]
constexpr double of_wind = 13.0;          // [K]
constexpr double seconds_apart = 1800.0;  // of suns
constexpr double day_s = 86400.0;

/// Across a clear day's beam [W/m²].
double clear_beam(double elevation_deg) {
    const double mass = 1.0 / (std::sin(radians(elevation_deg)) +
                               0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
    return 1353.0 * std::pow(0.7, std::pow(mass, 0.678));
}

/// The first, the middle and the last day of a span, or the whole of a shorter one.
std::vector<Instant> instants_of(const TimeInput& time) {
    std::vector<Instant> all;
    const auto add_day = [&](double from) {
        for (double s = 0.0; s < std::min(day_s, time.duration); s += seconds_apart) {
            all.push_back(later(time.start, from + s));
        }
    };
    add_day(0.0);
    if (time.duration > 2.5 * day_s) add_day(0.5 * (time.duration - day_s));
    if (time.duration > 1.5 * day_s) add_day(time.duration - day_s);
    return all;
}

}  // namespace

SurroundingsSampler::SurroundingsSampler(const World& world, const Scene& scene, std::size_t first,
                                         std::size_t count, const Stance& stance)
    : world_(world) {
    const FacetSet& facets = world.facets;
    double area = 0.0;
    for (std::size_t f = first; f < first + count; ++f) area += facets.area[f];
    double passed = 0.0;
    std::size_t next = 0;
    for (std::size_t f = first; f < first + count; ++f) {
        passed += facets.area[f];
        for (; next < probes && (double(next) + 0.5) / probes * area <= passed; ++next) {
            RandomStream chance{hashed(next)};
            const double u = chance(), v = chance();
            const Material& material = scene.materials[facets.material[f]];
            probe_.push_back(
                {f, u, v, facets.normal[f].cast<double>(), 1.0 - material.thermal.albedo});
        }
    }
    // Clockwise from north is against the sense of a turn about the vertical.
    const Eigen::AngleAxisd to_north(radians(stance.heading_deg), Eigen::Vector3d::UnitZ());
    const Eigen::Matrix3d to_level = stance.to_level();
    for (const Probe& probe : probe_) north_.push_back(to_north * (to_level * probe.normal));
    for (const Instant instant : instants_of(scene.time)) {
        const SunPosition sun = sun_position(world.site, instant);
        if (sun.elevation_deg <= 0.0) continue;
        sun_.push_back({sun_direction(sun), clear_beam(sun.elevation_deg)});
    }
    std::map<std::string, std::uint8_t> known;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        const Material& material = scene.materials[MaterialId{static_cast<std::uint16_t>(m)}];
        const auto number = static_cast<std::uint8_t>(1 + known.size() % 255);
        kind_.push_back(known.try_emplace(material.kind(), number).first->second);
    }
}

Surroundings SurroundingsSampler::at(const RayScene& scene, const Eigen::Isometry3d& pose,
                                     const Stance& stance, float wind) const {
    Surroundings found{
        .heading_deg = stance.heading_deg, .to_level = stance.to_level(), .wind = wind};
    found.beam.assign(sun_.size() * probe_.size(), 0);
    found.around.assign(probe_.size() * rays, 0);
    std::vector<Ray> to_sun, all_round;
    std::vector<std::size_t> place;
    for (std::size_t p = 0; p < probe_.size(); ++p) {
        const Probe& probe = probe_[p];
        const LiftedFacet lifted(world_.facets, probe.facet, pose);
        const Eigen::Vector3f from = lifted.at(probe.u, probe.v);
        for (std::size_t s = 0; s < sun_.size(); ++s) {
            if (lifted.normal.dot(sun_[s].to) <= 0.0) continue;
            to_sun.push_back({.origin = from, .direction = sun_[s].to.cast<float>()});
            place.push_back(s * probe_.size() + p);
        }
        // A spiral over the hemisphere, by the cosine, that turns with the object.
        const auto [x, y] = tangents(probe.normal);
        for (std::size_t r = 0; r < rays; ++r) {
            const double share = (double(r) + 0.5) / double(rays);
            const double turn = 2.0 * std::numbers::pi * golden_section * double(r);
            const Eigen::Vector3d own =
                std::sqrt(share) * (std::cos(turn) * x + std::sin(turn) * y) +
                std::sqrt(1.0 - share) * probe.normal;
            all_round.push_back({.origin = from, .direction = (pose.linear() * own).cast<float>()});
        }
    }
    std::vector<float> share(to_sun.size());
    scene.beam(to_sun, share);
    for (std::size_t i = 0; i < share.size(); ++i) {
        found.beam[place[i]] = static_cast<std::uint8_t>(std::lround(255.0f * share[i]));
    }
    std::vector<Hit> hit(all_round.size());
    scene.closest(all_round, hit);
    for (std::size_t i = 0; i < hit.size(); ++i) {
        if (hit[i].facet == no_facet) continue;
        found.around[i] = kind_[index(world_.facets.material[index(hit[i].facet)])];
    }
    return found;
}

SurroundingsSampler::Apart SurroundingsSampler::apart(const Surroundings& a, const Surroundings& b,
                                                      double most) const {
    const Apart too_far{std::numeric_limits<double>::infinity(), 0.0};
    const double turned = std::remainder(a.heading_deg - b.heading_deg, 360.0);
    if (std::abs(turned) > furthest_heading_deg) return too_far;
    const double by_wind = of_wind * std::abs(double{a.wind} - double{b.wind});
    if (by_wind > most) return too_far;
    std::vector<double> steady(probe_.size());  // [W/m²] a − b
    double sum = 0.0;
    for (std::size_t p = 0; p < probe_.size(); ++p) {
        double flux = 0.0;
        for (std::size_t r = p * rays; r < (p + 1) * rays; ++r) {
            if (a.around[r] == b.around[r]) continue;
            const bool sky = a.around[r] == 0 || b.around[r] == 0;
            const double sign = a.around[r] == 0 ? -1.0 : 1.0;
            flux += sign * (sky ? of_sky : of_kinds) / double(rays);
        }
        steady[p] = flux;
        sum += std::abs(flux);
    }
    const double number = double(probe_.size());
    Apart apart{by_wind + sum / (film * number), by_wind};
    if (apart.mean > most) return too_far;
    // Each normal as the copy is turned, from that of the first place.
    const auto turn_of = [](const Surroundings& s) {
        const double angle = radians(s.heading_deg);
        return std::pair{std::cos(angle), std::sin(angle)};
    };
    const auto [cos_a, sin_a] = turn_of(a);
    const auto [cos_b, sin_b] = turn_of(b);
    for (std::size_t s = 0; s < sun_.size(); ++s) {
        // The sun as the object has it, level and heading north.
        const Eigen::Vector3d to_a = a.to_level * sun_[s].to, to_b = b.to_level * sun_[s].to;
        const Eigen::Vector3d in_a(cos_a * to_a.x() - sin_a * to_a.y(),
                                   sin_a * to_a.x() + cos_a * to_a.y(), to_a.z());
        const Eigen::Vector3d in_b(cos_b * to_b.x() - sin_b * to_b.y(),
                                   sin_b * to_b.x() + cos_b * to_b.y(), to_b.z());
        const auto* of_a = a.beam.data() + s * probe_.size();
        const auto* of_b = b.beam.data() + s * probe_.size();
        double all = 0.0;
        for (std::size_t p = 0; p < probe_.size(); ++p) {
            const Eigen::Vector3d& n = north_[p];
            const double more = (of_a[p] / 255.0) * std::max(0.0, n.dot(in_a)) -
                                (of_b[p] / 255.0) * std::max(0.0, n.dot(in_b));
            const double kelvin =
                std::abs(steady[p] + probe_[p].absorptance * sun_[s].beam * more) / film;
            all += kelvin;
            apart.worst = std::max(apart.worst, by_wind + kelvin);
        }
        apart.mean = std::max(apart.mean, by_wind + all / number);
        if (apart.mean > most) return too_far;
    }
    return apart;
}

}  // namespace diurna
