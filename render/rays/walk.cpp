#include "render/rays/walk.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "materials/matter/microfacet.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

constexpr int most_through = 8, most_mirrored = 2;

/// A ray on its way.
struct Walker {
    Eigen::Vector3d origin, direction;
    double near = 0.0;    // [m] from the origin: what is nearer is the surface it comes from
    double walked = 0.0;  // [m] before the origin
    std::int32_t before = -1;
    Hop::Way way = Hop::Way::direct;
    bool straight = true;
    int through = 0, mirrored = 0;
};

/// A direction of the mirrored lobe about `normal` for a ray that arrives along `direction`.
Eigen::Vector3d mirrored(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal,
                         double roughness, RandomStream& chance) {
    const Eigen::Vector3d plain = direction - 2.0 * direction.dot(normal) * normal;
    if (roughness < 1e-3) return plain;
    const Eigen::Vector3d aside =
        std::abs(normal.z()) < 0.9 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d x = aside.cross(normal).normalized(), y = normal.cross(x);
    Eigen::Vector3d eye(-direction.dot(x), -direction.dot(y), -direction.dot(normal));
    eye.z() = std::max(eye.z(), 1e-3);
    eye.normalize();
    const Microfacets surface{.roughness = roughness};
    constexpr std::size_t candidates = 4;
    std::array<Eigen::Vector3d, candidates> half;
    std::array<double, candidates> weight{};
    double total = 0.0;
    for (std::size_t i = 0; i < candidates; ++i) {
        const double u = chance(), v = chance();
        half[i] = surface.normal(eye, u, v);
        weight[i] = surface.weight(eye, half[i]);
        total += weight[i];
    }
    double pick = chance() * total;
    if (!(total > 0.0)) return plain;
    std::size_t i = 0;
    while (i + 1 < candidates && pick >= weight[i]) pick -= weight[i++];
    const Eigen::Vector3d out = 2.0 * eye.dot(half[i]) * half[i] - eye;
    return (out.x() * x + out.y() * y + out.z() * normal).normalized();
}

/// Follows one ray to its ends.
void follow(const HopScene& place, Walker walker, float weight, RandomStream& chance,
            std::vector<Hop>& out) {
    const auto add = [&](Hop hop, double along) {
        hop.way = walker.way;
        hop.straight = walker.straight;
        hop.before = walker.before;
        hop.weight = weight;
        hop.range = static_cast<float>(walker.walked + along);
        hop.height = static_cast<float>(level_height(walker.origin + along * walker.direction));
        hop.direction = walker.direction.cast<float>();
        out.push_back(hop);
        walker.before = static_cast<std::int32_t>(out.size()) - 1;
        walker.way = Hop::Way::through;
    };
    const auto end_twice = [&](const Blend& blend, double far) {
        Hop hop{.kind = Hop::Kind::facet};
        hop.cosine = static_cast<float>(
            std::abs(place.facets.normal[index(blend.first)].cast<double>().dot(walker.direction)));
        const std::int32_t before = walker.before;
        const Hop::Way way = walker.way;
        for (const bool second : {false, true}) {
            hop.what = static_cast<std::uint32_t>(index(second ? blend.second : blend.first));
            walker.before = before;
            walker.way = way;
            add(hop, far);
            out.back().weight *= second ? blend.second_share : 1.0f - blend.second_share;
        }
    };
    for (;;) {
        const Ray ray{.origin = walker.origin.cast<float>(),
                      .near = static_cast<float>(walker.near),
                      .direction = walker.direction.cast<float>()};
        Hit hit;
        place.scene.closest({&ray, 1}, {&hit, 1});
        const double far = hit.facet == no_facet ? 1e30 : double{hit.range};
        for (const Chord& chord :
             place.plumes.chords(walker.origin, walker.direction, std::min(far, 1e6))) {
            const double from = std::max(chord.from, walker.near);
            if (chord.to <= from) continue;
            Hop hop{.kind = Hop::Kind::plume, .what = chord.plume};
            hop.chord = static_cast<float>(chord.to - from);
            add(hop, 0.5 * (from + chord.to));
        }
        if (hit.facet == no_facet) {
            Hop hop{.kind = Hop::Kind::sky};
            add(hop, 0.0);
            return;
        }
        Blend blend{hit.facet, hit.facet};
        if (place.texture_levels != nullptr) {
            const double walked = walker.walked + far;
            blend = blend_at(*place.texture_levels, hit.facet, place.observer,
                             place.sample_angle * (far > 0.0 ? walked / far : 1.0), walker.origin,
                             walker.direction, far);
        }
        std::size_t f = index(blend.first);
        if (blend.second_share > 0.0f) {
            const auto& [a, b, share] = blend;
            const auto goes_on = [&](FacetId facet) {
                return place.materials[place.facets.material[index(facet)]].needs_rays();
            };
            if (goes_on(a) || goes_on(b)) {
                if (chance() < double{share}) f = index(b);
            } else if (share == 1.0f) {
                f = index(b);
            } else {
                end_twice(blend, far);
                return;
            }
        }
        const Material& material = place.materials[place.facets.material[f]];
        Eigen::Vector3d normal = place.facets.normal[f].cast<double>();
        if (normal.dot(walker.direction) > 0.0) normal = -normal;
        Hop hop{.kind = Hop::Kind::facet, .what = static_cast<std::uint32_t>(f)};
        hop.cosine = static_cast<float>(-normal.dot(walker.direction));
        const auto* glossy = std::get_if<Glossy>(&material.finish);
        hop.closed = (material.see_through && walker.through >= most_through) ||
                     (glossy && walker.mirrored >= most_mirrored);
        add(hop, far);
        if (hop.closed || !material.needs_rays()) return;
        const double step = std::max(1e-3, 2e-6 * (far + walker.origin.norm()));
        if (glossy) {
            Walker other = walker;
            other.origin = walker.origin + far * walker.direction;
            other.direction = mirrored(walker.direction, normal, glossy->roughness, chance);
            other.near = step;
            other.walked = walker.walked + far;
            other.way = Hop::Way::mirrored;
            other.straight = false;
            other.mirrored = walker.mirrored + 1;
            other.before = walker.before;
            follow(place, other, weight, chance, out);
        }
        if (!material.see_through) return;
        walker.near = far + step;
        ++walker.through;
    }
}

}  // namespace

void walk(const HopScene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
          float weight, RandomStream& chance, std::vector<Hop>& out) {
    follow(scene, {.origin = origin, .direction = direction}, weight, chance, out);
}

}  // namespace diurna
