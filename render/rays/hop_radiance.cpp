#include "render/rays/hop_radiance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/matter/directional_optics.hpp"
#include "materials/matter/measured_brdf.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/node_optics.hpp"
#include "render/path/background.hpp"
#include "render/path/direction_angles.hpp"
#include "render/rays/lobe.hpp"
#include "render/rays/sun_glint.hpp"

namespace diurna {

namespace {

/// directional_optics() of the nodes; an index of refraction that does not change with wavelength
/// is evaluated once.
std::vector<DirectionalOptics> optics_of(const Material& material, const Band& band,
                                         double cosine) {
    std::vector<DirectionalOptics> optics;
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    const bool once =
        !glossy || (glossy->index.value.size() <= 2 && glossy->extinction.value.size() <= 2);
    double here = 0.0, normal = 0.0;
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        const double um = band.node_um[n];
        if (n == 0 || !once) {
            here = interface_reflectance(material.finish, um, cosine);
            normal = interface_reflectance(material.finish, um, laboratory_cosine);
        }
        optics.push_back(directional_optics(material, um, cosine, here, normal));
    }
    return optics;
}

/// The diffuse optics' mean over the hemisphere, node by node: midpoints.
std::vector<double> mean_diffuse(const Material& material, const Band& band) {
    constexpr int steps = 100;
    std::vector<double> mean(band.node_um.size(), 0.0);
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        const auto optics = optics_of(material, band, cosine);
        for (std::size_t n = 0; n < mean.size(); ++n) {
            mean[n] += optics[n].diffuse * 2.0 * cosine / steps;
        }
    }
    return mean;
}

/// What one of the microfacets of a rough surface mirrors, (node).
std::vector<double> facing_optics(const Material& material, const Band& band, double cosine) {
    const auto& glossy = std::get<Glossy>(material.finish);
    std::vector<double> mirrored;
    const bool once = glossy.index.value.size() <= 2 && glossy.extinction.value.size() <= 2;
    double normal = 0.0;
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        const double um = band.node_um[n];
        if (n == 0 || !once) {
            normal = interface_reflectance(material.finish, um, laboratory_cosine);
        }
        mirrored.push_back(
            directional_optics(material, um, cosine, smooth_reflectance(glossy, um, cosine), normal)
                .mirrored);
    }
    return mirrored;
}

/// The sum over a rough mirror's lobe (rough_mirror.hpp), (node).
struct LobeSum {
    std::vector<double> reflected, sky, around;
    double open = 1.0;  // open_sky()
    bool sees_facets = false;
};

/// One pixel's hops, one after the other.
class NodeSum {
 public:
    NodeSum(const Hops& hops, std::size_t pixel, std::span<const Plume> plumes, const Band& band,
            const RadianceInput& input, const ScatteredSun* scattered)
        : list_(hops.of(pixel)),
          plumes_(plumes),
          band_(band),
          input_(input),
          scattered_(scattered),
          eye_km_(input.above_sea_km(hops.observer_height)) {}

    double sum() {
        double sum = 0.0;
        for (const Hop& hop : list_) {
            passed_.push_back(past(hop));
            lobe_.emplace_back();
            std::vector<double> light =
                hop.kind == Hop::Kind::sky ? background(hop) : air_and_own(hop);
            if (is_rough(hop)) add_lobe(hop, light);
            if (hop.way == Hop::Way::mirrored && is_rough(mirror_of(hop))) {
                take_expected(hop, light);
            }
            for (std::size_t n = 0; n < light.size(); ++n) {
                sum += double{hop.weight} * band_.weight[n] * passed_.back()[n] * light[n];
            }
        }
        return sum;
    }

 private:
    std::size_t nodes() const { return band_.node_um.size(); }
    const Material& material(const Hop& hop) const {
        return input_.materials[input_.facets.material[hop.what]];
    }
    /// Of the hop before; null: there is none.
    const PathSpectrum* air_before(const Hop& hop) const {
        return hop.before < 0 ? nullptr : &air_[static_cast<std::size_t>(hop.before)];
    }

    /// What light is left of, past the hops before.
    std::vector<double> past(const Hop& hop) const {
        std::vector<double> passed(nodes(), 1.0);
        if (hop.before < 0) return passed;
        const auto j = static_cast<std::size_t>(hop.before);
        const Hop& before = list_[j];
        if (before.kind == Hop::Kind::plume) {
            for (std::size_t n = 0; n < nodes(); ++n) {
                const double k = plumes_[before.what].absorption_at(band_.node_um[n]);
                passed[n] = passed_[j][n] * std::exp(-k * double{before.chord});
            }
            return passed;
        }
        const auto optics = optics_of(material(before), band_, double{before.cosine});
        if (hop.way == Hop::Way::mirrored && is_rough(before)) {
            const auto facing = facing_optics(
                material(before), band_,
                facing_between(-before.direction.cast<double>(), hop.direction.cast<double>()));
            for (std::size_t n = 0; n < nodes(); ++n) {
                passed[n] = passed_[j][n] * optics[n].mirrored * facing[n] / lobe_[j].reflected[n];
            }
            return passed;
        }
        for (std::size_t n = 0; n < nodes(); ++n) {
            passed[n] = passed_[j][n] * (hop.way == Hop::Way::mirrored ? optics[n].mirrored
                                                                       : optics[n].transmittance);
        }
        return passed;
    }

    SightLine line_to(const Hop& hop) const {
        return chord(eye_km_, input_.above_sea_km(double{hop.height}), 1e-3 * double{hop.range});
    }

    bool is_rough(const Hop& hop) const {
        return hop.kind == Hop::Kind::facet && !hop.closed &&
               std::holds_alternative<Glossy>(material(hop).finish) &&
               std::get<Glossy>(material(hop).finish).roughness >= least_lobe;
    }
    const Hop& mirror_of(const Hop& hop) const {
        return list_[static_cast<std::size_t>(hop.before)];
    }
    Eigen::Vector3d normal_of(const Hop& hop) const {
        Eigen::Vector3d normal = input_.facets.normal[hop.what].cast<double>();
        if (std::get<Glossy>(material(hop).finish).waves) normal = Eigen::Vector3d::UnitZ();
        return normal.dot(hop.direction.cast<double>()) > 0.0 ? Eigen::Vector3d(-normal) : normal;
    }

    /// The background in a mirror as it arrives at the eye.
    std::vector<double> in_mirror(const Hop& mirror, const Eigen::Vector3d& to) const {
        return towards(to, input_.above_sea_km(double{mirror.height}), line_to(mirror));
    }
    /// What arrives at a mirror from the facets around, their mean, as it arrives at the eye.
    std::vector<double> mean_around(const Hop& mirror) const {
        const TermsByOrigin terms =
            radiosity_by_origin(input_, FacetId{mirror.what}, band_.node_um, 2, scattered_);
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

    void add_lobe(const Hop& hop, std::vector<double>& light) {
        LobeSum& lobe = lobe_.back();
        lobe.sees_facets = counts_around(float(input_.views.sky[hop.what]), normal_of(hop));
        for (auto* row : {&lobe.reflected, &lobe.sky, &lobe.around}) row->assign(nodes(), 0.0);
        const Microfacets surface = microfacets_of(std::get<Glossy>(material(hop).finish));
        Lobe(surface, normal_of(hop), -hop.direction.cast<double>())
            .each(lobe.sees_facets, [&](const Lobe::Ray& ray, double share) {
                const auto facing = facing_optics(material(hop), band_, ray.facing);
                const bool below = lobe.sees_facets && ray.direction.z() < 0.0;
                std::vector<double> far(nodes(), 0.0);
                if (!below) far = in_mirror(hop, ray.direction);
                for (std::size_t n = 0; n < nodes(); ++n) {
                    const double part = share * ray.weight * facing[n];
                    lobe.reflected[n] += part;
                    lobe.sky[n] += part * far[n];
                    if (below) lobe.around[n] += part;
                }
            });
        const auto optics = optics_of(material(hop), band_, double{hop.cosine});
        lobe.open = open_sky(float(input_.views.sky[hop.what]), normal_of(hop));
        std::vector<double> near(nodes(), 0.0);
        if (lobe.sees_facets || lobe.open < 1.0) near = mean_around(hop);
        for (std::size_t n = 0; n < nodes(); ++n) {
            const double around =
                lobe.around[n] + (1.0 - lobe.open) * (lobe.reflected[n] - lobe.around[n]);
            light[n] += optics[n].mirrored / lobe.reflected[n] *
                        (lobe.open * lobe.sky[n] + around * near[n]);
        }
    }

    void take_expected(const Hop& hop, std::vector<double>& light) const {
        const Hop& mirror = mirror_of(hop);
        const LobeSum& lobe = lobe_[static_cast<std::size_t>(hop.before)];
        const bool around = lobe.sees_facets && hop.direction.z() < 0.0f;
        const double open = around ? 0.0 : lobe.open;
        std::vector<double> near(nodes(), 0.0), far = near;
        if (open < 1.0) near = mean_around(mirror);
        if (open > 0.0) far = in_mirror(mirror, hop.direction.cast<double>());
        for (std::size_t n = 0; n < nodes(); ++n) {
            light[n] -= open * far[n] + (1.0 - open) * near[n];
        }
    }

    /// Past a mirror: as it arrives at the eye, on one way with that from the mirror on.
    std::vector<double> background(const Hop& hop) {
        const double from_km = hop.straight ? eye_km_ : input_.above_sea_km(double{hop.height});
        SightLine onward;
        if (!hop.straight) onward = line_to(mirror_of(hop));
        std::vector<double> light = towards(hop.direction.cast<double>(), from_km, onward);
        const PathSpectrum* before = hop.straight ? air_before(hop) : nullptr;
        for (std::size_t n = 0; before && n < nodes(); ++n) light[n] -= before->radiance[n];
        air_.emplace_back();
        return light;
    }

    std::vector<double> towards(const Eigen::Vector3d& to, double from_km,
                                const SightLine& onward) const {
        std::vector<double> light =
            background_at(input_, from_km, zenith_deg_of(to), band_.node_um, onward);
        if (scattered_ != nullptr) {
            const double azimuth_deg = azimuth_from_sun_deg(to, input_.to_sun);
            const auto sunlit = scattered_backgrounds_at(
                input_, *scattered_, from_km, zenith_deg_of(to), {&azimuth_deg, 1}, onward);
            for (std::size_t n = 0; n < nodes(); ++n) light[n] += sunlit[0][n];
        }
        return light;
    }

    std::vector<double> air_and_own(const Hop& hop) {
        const SightLine line = line_to(hop);
        PathSpectrum path = path_at_nodes(input_.atmosphere, line, band_.node_um);
        if (scattered_ != nullptr && hop.straight) {
            const Eigen::Vector3d to = hop.direction.cast<double>();
            const auto sunlit =
                scattered_->path(line, zenith_deg_of(to), azimuth_from_sun_deg(to, input_.to_sun));
            for (std::size_t n = 0; n < nodes(); ++n) path.radiance[n] += sunlit[n];
        }
        const PathSpectrum* before = air_before(hop);
        const LightByOrigin shares =
            onward_shares(input_, line, input_.above_sea_km(double{hop.height}), band_.node_um);
        const LightByOrigin sent = own(hop);
        std::vector<double> light = path.radiance;
        for (std::size_t n = 0; n < nodes(); ++n) {
            if (before) light[n] -= before->radiance[n];
            for (std::size_t o = 0; o < origin_count; ++o) {
                if (!sent[o].empty()) light[n] += shares[o][n] * sent[o][n];
            }
        }
        air_.push_back(std::move(path));
        return light;
    }

    /// What the hop sends along the ray that arrives, but for what it mirrors and lets through.
    LightByOrigin own(const Hop& hop) const {
        if (hop.kind == Hop::Kind::plume) {
            std::vector<double> glow(nodes());
            const Plume& plume = plumes_[hop.what];
            for (std::size_t n = 0; n < nodes(); ++n) {
                const double depth = plume.absorption_at(band_.node_um[n]) * double{hop.chord};
                glow[n] = -std::expm1(-depth) * planck(band_.node_um[n], plume.temperature);
            }
            return from_surface(std::move(glow));
        }
        const TermsByOrigin terms =
            radiosity_by_origin(input_, FacetId{hop.what}, band_.node_um, 2, scattered_);
        if (!hop.closed && material(hop).needs_rays()) return directional(hop, terms);
        LightByOrigin sent;
        for (std::vector<double>& light : sent) light.assign(nodes(), 0.0);
        for (const LightByOrigin& term : terms) {
            for (std::size_t o = 0; o < origin_count; ++o) {
                for (std::size_t n = 0; n < term[o].size(); ++n) sent[o][n] += term[o][n];
            }
        }
        return sent;
    }

    LightByOrigin directional(const Hop& hop, const TermsByOrigin& terms) const {
        const Material& of = material(hop);
        const double temperature = input_.temperature[hop.what];
        const auto seen = optics_of(of, band_, double{hop.cosine});
        LightByOrigin sent;
        for (std::vector<double>& light : sent) light.assign(nodes(), 0.0);
        for (std::size_t n = 0; n < nodes(); ++n) {
            const double um = band_.node_um[n], reflectance = of.reflectance.at(um);
            for (const Term t : {Term::sky, Term::surroundings}) {
                const LightByOrigin& term = terms[static_cast<std::size_t>(t)];
                for (std::size_t o = 0; o < origin_count; ++o) {
                    if (term[o].empty() || reflectance <= 0.0) continue;
                    sent[o][n] += seen[n].diffuse / reflectance * term[o][n];
                }
            }
            double& surface = from(sent, Origin::surface)[n];
            surface += seen[n].emissivity * planck(um, temperature);
            if (!of.see_through) {
                surface += seen[n].transmittance * planck(um, temperature_behind(of, temperature));
            }
        }
        add_sunlight(hop, seen, from(sent, Origin::sunlight));
        return sent;
    }

    void add_sunlight(const Hop& hop, std::span<const DirectionalOptics> seen,
                      std::vector<double>& sent) const {
        const FacetId facet{hop.what};
        const double sunlight = sunlight_on(input_, facet);
        if (!(sunlight > 0.0)) return;
        const Material& of = material(hop);
        const Eigen::Vector3d normal = input_.facets.normal[hop.what].cast<double>();
        const Eigen::Vector3d eye = -hop.direction.cast<double>();
        const IncidentLight light =
            incident_light(input_, input_.height_km(facet), band_.node_um, scattered_);
        const auto lit = optics_of(of, band_, normal.dot(input_.to_sun));
        const std::vector<double> mean = mean_diffuse(of, band_);
        const double lobe = measured_lobe(of.finish, normal, eye, input_.to_sun);
        const auto* glossy = std::get_if<Glossy>(&of.finish);
        const double glint = glossy ? sun_glint(microfacets_of(*glossy), normal, eye, input_.to_sun,
                                                double{hop.cosine})
                                    : 0.0;
        const std::vector<double> facing =
            glossy ? facing_optics(of, band_, facing_between(eye, input_.to_sun))
                   : std::vector<double>(nodes(), 0.0);
        for (std::size_t n = 0; n < nodes(); ++n) {
            if (mean[n] > 0.0) {
                sent[n] += lobe * seen[n].diffuse * lit[n].diffuse / mean[n] * sunlight *
                           light.from_sun(n);
            }
            sent[n] += facing[n] * glint * sunlight * light.sun[n];
        }
    }

    std::span<const Hop> list_;
    std::span<const Plume> plumes_;
    const Band& band_;
    const RadianceInput& input_;
    const ScatteredSun* scattered_;
    double eye_km_;
    std::vector<std::vector<double>> passed_;  // (hop)(node)
    std::vector<PathSpectrum> air_;            // (hop) before it
    std::vector<LobeSum> lobe_;                // (hop) of rough mirrors
};

}  // namespace

double hop_radiance(const Hops& hops, std::size_t pixel, std::span<const Plume> plumes,
                    const Band& band, const RadianceInput& input, const ScatteredSun* scattered) {
    return NodeSum(hops, pixel, plumes, band, input, scattered).sum();
}

}  // namespace diurna
