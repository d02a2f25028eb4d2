#include "render/rays/walk.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "materials/matter/microfacet.hpp"
#include "render/view/view.hpp"
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

/// A walk from the eye to all its ends.
class Walk {
 public:
    Walk(const HopScene& scene, float weight, RandomStream& chance, std::vector<Hop>& out)
        : scene_(scene), weight_(weight), chance_(chance), out_(out) {}

    void follow(Walker walker) {
        for (;;) {
            const Ray ray{.origin = walker.origin.cast<float>(),
                          .near = static_cast<float>(walker.near),
                          .direction = walker.direction.cast<float>()};
            Hit hit;
            scene_.rays.closest({&ray, 1}, {&hit, 1});
            const double far = hit.facet == no_facet ? 1e30 : double{hit.range};
            add_plumes(walker, far);
            if (hit.facet == no_facet) {
                add(walker, {.kind = Hop::Kind::sky}, 0.0);
                return;
            }
            const Blend blend = blend_at(walker, hit.facet, far);
            if (ends_on_both(blend)) {
                add_both(walker, blend, far);
                return;
            }
            if (!add_facet(walker, one_of(blend), far)) return;
        }
    }

 private:
    /// `along` [m] from where the walker stands.
    void add(Walker& walker, Hop hop, double along) {
        hop.way = walker.way;
        hop.straight = walker.straight;
        hop.before = walker.before;
        hop.weight = weight_;
        hop.range = static_cast<float>(walker.walked + along);
        hop.height = static_cast<float>(level_height(walker.origin + along * walker.direction));
        hop.direction = walker.direction.cast<float>();
        out_.push_back(hop);
        walker.before = static_cast<std::int32_t>(out_.size()) - 1;
        walker.way = Hop::Way::through;
    }

    void add_plumes(Walker& walker, double far) {
        for (const Chord& chord :
             scene_.plumes.chords(walker.origin, walker.direction, std::min(far, 1e6))) {
            const double from = std::max(chord.from, walker.near);
            if (chord.to <= from) continue;
            Hop hop{.kind = Hop::Kind::plume, .what = chord.plume};
            hop.chord = static_cast<float>(chord.to - from);
            add(walker, hop, 0.5 * (from + chord.to));
        }
    }

    Blend blend_at(const Walker& walker, FacetId facet, double far) const {
        if (scene_.textured == nullptr) return {facet, facet};
        return scene_.textured->at(facet, walker.origin, walker.direction, far, walker.walked);
    }

    bool lets_on(const Blend& blend) const {
        return scene_.needs_rays(blend.first) || scene_.needs_rays(blend.second);
    }
    bool ends_on_both(const Blend& blend) const {
        return blend.second_share > 0.0f && blend.second_share != 1.0f && !lets_on(blend);
    }
    /// Of a facet that does not end on both.
    FacetId one_of(const Blend& blend) {
        if (blend.second_share == 0.0f) return blend.first;
        if (!lets_on(blend)) return blend.second;
        return chance_() < double{blend.second_share} ? blend.second : blend.first;
    }

    void add_both(const Walker& walker, const Blend& blend, double far) {
        const Eigen::Vector3d normal = scene_.facets.normal[index(blend.first)].cast<double>();
        for (const bool second : {false, true}) {
            Hop hop{.kind = Hop::Kind::facet};
            hop.what = static_cast<std::uint32_t>(index(second ? blend.second : blend.first));
            hop.cosine = static_cast<float>(std::abs(normal.dot(walker.direction)));
            Walker ends = walker;
            add(ends, hop, far);
            out_.back().weight *= second ? blend.second_share : 1.0f - blend.second_share;
        }
    }

    /// Returns whether the walker goes on through it; what it mirrors is followed here.
    bool add_facet(Walker& walker, FacetId facet, double far) {
        const Material& material = scene_.material(facet);
        Eigen::Vector3d normal = scene_.facets.normal[index(facet)].cast<double>();
        if (normal.dot(walker.direction) > 0.0) normal = -normal;
        const auto* glossy = std::get_if<Glossy>(&material.finish);
        Hop hop{.kind = Hop::Kind::facet, .what = static_cast<std::uint32_t>(index(facet))};
        hop.cosine = static_cast<float>(-normal.dot(walker.direction));
        hop.closed = (material.see_through && walker.through >= most_through) ||
                     (glossy && walker.mirrored >= most_mirrored);
        add(walker, hop, far);
        if (hop.closed || !material.needs_rays()) return false;
        const double step = std::max(1e-3, 2e-6 * (far + walker.origin.norm()));
        if (glossy) {
            Walker other = walker;
            other.origin = walker.origin + far * walker.direction;
            other.direction = mirrored(walker.direction, normal, glossy->roughness, chance_);
            other.near = step;
            other.walked = walker.walked + far;
            other.way = Hop::Way::mirrored;
            other.straight = false;
            other.mirrored = walker.mirrored + 1;
            follow(other);
        }
        walker.near = far + step;
        ++walker.through;
        return material.see_through;
    }

    const HopScene& scene_;
    float weight_;
    RandomStream& chance_;
    std::vector<Hop>& out_;
};

}  // namespace

void walk(const HopScene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
          float weight, RandomStream& chance, std::vector<Hop>& out) {
    Walk(scene, weight, chance, out).follow({.origin = origin, .direction = direction});
}

}  // namespace diurna
