#include "render/rays/node_lobe.hpp"

#include <Eigen/Geometry>
#include <variant>

#include "render/light/far_ground.hpp"
#include "render/path/background.hpp"
#include "render/path/direction_angles.hpp"
#include "render/rays/lobe.hpp"
#include "render/rays/node_angles.hpp"

namespace diurna {

bool NodeLobes::is_rough(const SecondaryRay& secondary) const {
    return secondary.kind == SecondaryRay::Kind::facet && !secondary.closed &&
           std::holds_alternative<Glossy>(material(secondary).finish) &&
           std::get<Glossy>(material(secondary).finish).roughness >= least_lobe;
}

Eigen::Vector3d NodeLobes::normal_of(const SecondaryRay& secondary) const {
    Eigen::Vector3d normal = input_.facets.normal[secondary.what].cast<double>();
    if (std::get<Glossy>(material(secondary).finish).waves) normal = Eigen::Vector3d::UnitZ();
    return normal.dot(secondary.direction.cast<double>()) > 0.0 ? Eigen::Vector3d(-normal) : normal;
}

SightLine NodeLobes::line_to(const SecondaryRay& secondary) const {
    return chord(eye_km_, input_.above_sea_km(double{secondary.height}),
                 1e-3 * double{secondary.range});
}

std::vector<double> NodeLobes::background(const Eigen::Vector3d& to, double from_km,
                                          const SightLine& onward) const {
    std::vector<double> light =
        background_at(input_, from_km, zenith_deg_of(to), band_.node_um, onward,
                      far_ground_light(input_, band_.node_um, scattered_));
    if (scattered_ != nullptr) {
        const double azimuth_deg = azimuth_from_sun_deg(to, input_.to_sun);
        const auto sunlit = scattered_backgrounds_at(input_, *scattered_, from_km,
                                                     zenith_deg_of(to), {&azimuth_deg, 1}, onward);
        for (std::size_t n = 0; n < nodes(); ++n) light[n] += sunlit[0][n];
    }
    return light;
}

/// The background in a mirror as it arrives at the eye.
std::vector<double> NodeLobes::in_mirror(const SecondaryRay& mirror,
                                         const Eigen::Vector3d& to) const {
    return background(to, input_.above_sea_km(double{mirror.height}), line_to(mirror));
}

/// What arrives at a mirror from the facets around, their mean, as it arrives at the eye.
std::vector<double> NodeLobes::mean_around(const SecondaryRay& mirror) const {
    const TermsByOrigin terms =
        radiosity_by_origin(input_, mirror.surface(), band_.node_um, 2, scattered_);
    const LightByOrigin& sent = terms[static_cast<std::size_t>(Term::surroundings)];
    const LightByOrigin shares = onward_shares(
        input_, line_to(mirror), input_.above_sea_km(double{mirror.height}), band_.node_um);
    const double seen = 1.0 - double{input_.views.sky[mirror.what]};
    std::vector<double> light(nodes(), 0.0);
    for (std::size_t o = 0; o < origin_count; ++o) {
        for (std::size_t n = 0; n < sent[o].size(); ++n) {
            const double reflectance = material(mirror).reflectance.at(band_.node_um[n]);
            light[n] += shares[o][n] * sent[o][n] / (reflectance * seen);
        }
    }
    return light;
}

NodeLobe NodeLobes::sum(const SecondaryRay& mirror) const {
    const Material& of = material(mirror);
    const Eigen::Vector3d normal = normal_of(mirror);
    const auto sky_view = static_cast<float>(input_.views.sky[mirror.what]);
    NodeLobe lobe;
    lobe.sees_facets = counts_around(sky_view, normal);
    lobe.open = open_sky(sky_view, normal);
    for (auto* row : {&lobe.reflected, &lobe.sky, &lobe.around}) row->assign(nodes(), 0.0);
    const Microfacets surface = microfacets_of(std::get<Glossy>(of.finish));
    Lobe(surface, normal, -mirror.direction.cast<double>())
        .each(lobe.sees_facets, [&](const Lobe::Ray& ray, double share) {
            const auto facing = facing_at_nodes(of, band_, ray.facing);
            const bool below = lobe.sees_facets && ray.direction.z() < 0.0;
            std::vector<double> far(nodes(), 0.0);
            if (!below) far = in_mirror(mirror, ray.direction);
            for (std::size_t n = 0; n < nodes(); ++n) {
                const double part = share * ray.weight * facing[n];
                lobe.reflected[n] += part;
                lobe.sky[n] += part * far[n];
                if (below) lobe.around[n] += part;
            }
        });
    return lobe;
}

void NodeLobes::add(const SecondaryRay& mirror, const NodeLobe& lobe,
                    std::vector<double>& light) const {
    const auto optics = optics_at_nodes(material(mirror), band_, double{mirror.cosine});
    std::vector<double> near(nodes(), 0.0);
    if (lobe.sees_facets || lobe.open < 1.0) near = mean_around(mirror);
    for (std::size_t n = 0; n < nodes(); ++n) {
        const double around =
            lobe.around[n] + (1.0 - lobe.open) * (lobe.reflected[n] - lobe.around[n]);
        light[n] +=
            optics[n].mirrored / lobe.reflected[n] * (lobe.open * lobe.sky[n] + around * near[n]);
    }
}

void NodeLobes::take_expected(const SecondaryRay& mirror, const NodeLobe& lobe,
                              const Eigen::Vector3d& direction, std::vector<double>& light) const {
    const double open = lobe.sees_facets && direction.z() < 0.0 ? 0.0 : lobe.open;
    std::vector<double> near(nodes(), 0.0), far = near;
    if (open < 1.0) near = mean_around(mirror);
    if (open > 0.0) far = in_mirror(mirror, direction);
    for (std::size_t n = 0; n < nodes(); ++n) light[n] -= open * far[n] + (1.0 - open) * near[n];
}

}  // namespace diurna
