#include "render/rays/walk.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "materials/matter/directional_optics.hpp"
#include "materials/matter/waves.hpp"
#include "render/rays/lobe.hpp"
#include "render/view/view.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

constexpr int most_through = 8, most_mirrored = 2;

double past_whole(double x) { return x - std::floor(x); }

/// A ray in progress.
struct Walker {
    Eigen::Vector3d origin, direction;
    double near = 0.0;    // [m] from the origin: what is nearer is the surface it comes from
    double walked = 0.0;  // [m] before the origin
    std::int32_t before = -1;
    SecondaryRay::Way way = SecondaryRay::Way::direct;
    bool straight = true;
    bool from_lobe = false;  // of a rough mirror, just now
    float weight = 1.0f;
    int through = 0, mirrored = 0;
};

/// A walk from the eye to all its ends.
class Walk {
 public:
    Walk(const SecondaryScene& scene, const EyeRay& from, RandomStream& chance,
         std::vector<SecondaryRay>& out)
        : scene_(scene), from_(from), chance_(chance), out_(out) {}

    std::uint32_t traced() const { return traced_; }

    void follow(Walker walker) {
        for (;;) {
            const Ray ray{.origin = walker.origin.cast<float>(),
                          .near = static_cast<float>(walker.near),
                          .direction = walker.direction.cast<float>()};
            Hit hit;
            scene_.rays.closest({&ray, 1}, {&hit, 1});
            ++traced_;
            const double far = hit.facet == no_facet ? 1e30 : double{hit.range};
            add_plumes(walker, far);
            if (hit.facet == no_facet) {
                if (walker.from_lobe && walker.direction.z() >= 0.0) return;
                add(walker, {.kind = SecondaryRay::Kind::sky}, 0.0);
                return;
            }
            if (hit.copy != no_copy) {  // has no textures
                if (!add_surface(walker, own_surface(hit.facet), hit.copy, far)) return;
                continue;
            }
            const Blend blend = blend_at(walker, hit.facet, far);
            if (ends_on_both(blend)) {
                add_both(walker, blend, far);
                return;
            }
            if (!add_surface(walker, one_of(blend), no_copy, far)) return;
        }
    }

 private:
    /// `along` [m] from where the walker stands.
    void add(Walker& walker, SecondaryRay secondary, double along) {
        secondary.way = walker.way;
        secondary.straight = walker.straight;
        secondary.before = walker.before;
        secondary.weight = walker.weight;
        secondary.range = static_cast<float>(walker.walked + along);
        secondary.height =
            static_cast<float>(level_height(walker.origin + along * walker.direction));
        secondary.direction = walker.direction.cast<float>();
        out_.push_back(secondary);
        walker.before = static_cast<std::int32_t>(out_.size()) - 1;
        walker.way = SecondaryRay::Way::through;
        walker.from_lobe = false;
    }

    void add_plumes(Walker& walker, double far) {
        for (const Chord& chord :
             scene_.plumes.chords(walker.origin, walker.direction, std::min(far, 1e6))) {
            const double from = std::max(chord.from, walker.near);
            if (chord.to <= from) continue;
            SecondaryRay secondary{.kind = SecondaryRay::Kind::plume, .what = chord.plume};
            secondary.chord = static_cast<float>(chord.to - from);
            add(walker, secondary, 0.5 * (from + chord.to));
        }
    }

    Blend blend_at(const Walker& walker, FacetId facet, double far) const {
        if (scene_.textured == nullptr) return {own_surface(facet), own_surface(facet)};
        return scene_.textured->at(facet, walker.origin, walker.direction, far, walker.walked);
    }

    bool lets_on(const Blend& blend) const {
        return scene_.needs_rays(blend.first) || scene_.needs_rays(blend.second);
    }
    bool ends_on_both(const Blend& blend) const {
        return blend.second_share > 0.0f && blend.second_share != 1.0f && !lets_on(blend);
    }
    /// Of a facet that does not end on both.
    SurfaceId one_of(const Blend& blend) {
        if (blend.second_share == 0.0f) return blend.first;
        if (!lets_on(blend)) return blend.second;
        return chance_() < double{blend.second_share} ? blend.second : blend.first;
    }

    void add_both(const Walker& walker, const Blend& blend, double far) {
        const Eigen::Vector3d normal = scene_.facets.normal[index(blend.first)].cast<double>();
        for (const bool second : {false, true}) {
            SecondaryRay secondary{.kind = SecondaryRay::Kind::facet};
            secondary.what = number(second ? blend.second : blend.first);
            secondary.cosine = static_cast<float>(std::abs(normal.dot(walker.direction)));
            Walker ends = walker;
            add(ends, secondary, far);
            out_.back().weight *= second ? blend.second_share : 1.0f - blend.second_share;
        }
    }

    /// Returns whether the walker goes on through it; what it mirrors is followed here.
    bool add_surface(Walker& walker, SurfaceId surface, std::uint32_t copy, double far) {
        const Material& material = scene_.material(surface);
        const auto* glossy = std::get_if<Glossy>(&material.finish);
        Eigen::Vector3d normal =
            scene_.rays.copies().turned(copy, scene_.facets.normal[index(surface)].cast<double>());
        if (glossy && glossy->waves) normal = Eigen::Vector3d::UnitZ();  // water lies level
        if (normal.dot(walker.direction) > 0.0) normal = -normal;
        SecondaryRay secondary{.kind = SecondaryRay::Kind::facet, .what = number(surface)};
        secondary.cosine = static_cast<float>(-normal.dot(walker.direction));
        secondary.closed = (material.see_through && walker.through >= most_through) ||
                           (glossy && walker.mirrored >= most_mirrored);
        add(walker, secondary, far);
        if (secondary.closed || !material.needs_rays()) return false;
        const double step = std::max(1e-3, 2e-6 * (far + walker.origin.norm()));
        if (glossy) mirror(walker, *glossy, normal, far, step);
        walker.near = far + step;
        ++walker.through;
        return material.see_through;
    }

    void mirror(const Walker& walker, const Glossy& glossy, const Eigen::Vector3d& normal,
                double far, double step) {
        Walker other = walker;
        other.origin = walker.origin + far * walker.direction;
        other.near = step;
        other.walked = walker.walked + far;
        other.way = SecondaryRay::Way::mirrored;
        other.straight = false;
        other.mirrored = walker.mirrored + 1;
        const double roughness = roughness_under(glossy, scene_.wind_speed);
        if (roughness < least_lobe) {
            other.direction = walker.direction - 2.0 * walker.direction.dot(normal) * normal;
            follow(other);
            return;
        }
        Microfacets surface = microfacets_of(glossy);
        surface.roughness = roughness;
        into_lobe(other, Lobe(surface, normal, -walker.direction));
    }

    void into_lobe(const Walker& walker, const Lobe& lobe) {
        const LobeRays& place = from_.lobe;
        const bool placed = walker.mirrored == 1 && place.first[0] >= 0.0;
        const int rays = walker.mirrored == 1 ? place.count : 1;
        for (int i = 0; i < rays; ++i) {
            const double u = placed ? past_whole(place.first[0] + i * place.step[0]) : chance_();
            const double v = placed ? past_whole(place.first[1] + i * place.step[1]) : chance_();
            const Lobe::Ray ray = lobe.ray(u, v);
            if (!(ray.weight > 0.0)) continue;
            Walker other = walker;
            other.direction = ray.direction;
            other.weight *= static_cast<float>(ray.weight / rays);
            other.from_lobe = true;
            follow(other);
        }
    }

    const SecondaryScene& scene_;
    const EyeRay& from_;
    RandomStream& chance_;
    std::vector<SecondaryRay>& out_;
    std::uint32_t traced_ = 0;
};

}  // namespace

std::uint32_t walk(const SecondaryScene& scene, const EyeRay& ray, RandomStream& chance,
                   std::vector<SecondaryRay>& out) {
    Walk walk(scene, ray, chance, out);
    walk.follow({.origin = ray.origin, .direction = ray.direction, .weight = ray.weight});
    return walk.traced();
}

}  // namespace diurna
