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
#include "render/rays/node_angles.hpp"
#include "render/rays/node_lobe.hpp"
#include "render/rays/sun_glint.hpp"

namespace diurna {

namespace {

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
          eye_km_(input.above_sea_km(hops.observer_height)),
          lobes_(band, input, scattered, eye_km_) {}

    double sum() {
        double sum = 0.0;
        for (const Hop& hop : list_) {
            passed_.push_back(past(hop));
            const bool rough = lobes_.is_rough(hop);
            lobe_.push_back(rough ? lobes_.sum(hop) : NodeLobe{});
            std::vector<double> light =
                hop.kind == Hop::Kind::sky ? background(hop) : air_and_own(hop);
            if (rough) lobes_.add(hop, lobe_.back(), light);
            if (hop.way == Hop::Way::mirrored && lobes_.is_rough(mirror_of(hop))) {
                lobes_.take_expected(mirror_of(hop), lobe_[static_cast<std::size_t>(hop.before)],
                                     hop.direction.cast<double>(), light);
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
        const auto optics = optics_at_nodes(material(before), band_, double{before.cosine});
        if (hop.way == Hop::Way::mirrored && lobes_.is_rough(before)) {
            const auto facing = facing_at_nodes(
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

    const Hop& mirror_of(const Hop& hop) const {
        return list_[static_cast<std::size_t>(hop.before)];
    }
    /// Past a mirror: as it arrives at the eye, on one way with that from the mirror on.
    std::vector<double> background(const Hop& hop) {
        const double from_km = hop.straight ? eye_km_ : input_.above_sea_km(double{hop.height});
        SightLine onward;
        if (!hop.straight) onward = lobes_.line_to(mirror_of(hop));
        std::vector<double> light =
            lobes_.background(hop.direction.cast<double>(), from_km, onward);
        const PathSpectrum* before = hop.straight ? air_before(hop) : nullptr;
        for (std::size_t n = 0; before && n < nodes(); ++n) light[n] -= before->radiance[n];
        air_.emplace_back();
        return light;
    }

    std::vector<double> air_and_own(const Hop& hop) {
        const SightLine line = lobes_.line_to(hop);
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
        const auto seen = optics_at_nodes(of, band_, double{hop.cosine});
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
        const auto lit = optics_at_nodes(of, band_, normal.dot(input_.to_sun));
        const std::vector<double> mean = mean_diffuse_at_nodes(of, band_);
        const double lobe = measured_lobe(of.finish, normal, eye, input_.to_sun);
        const auto* glossy = std::get_if<Glossy>(&of.finish);
        const double glint = glossy ? sun_glint(microfacets_of(*glossy), normal, eye, input_.to_sun,
                                                double{hop.cosine})
                                    : 0.0;
        const std::vector<double> facing =
            glossy ? facing_at_nodes(of, band_, facing_between(eye, input_.to_sun))
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
    NodeLobes lobes_;
    std::vector<std::vector<double>> passed_;  // (hop)(node)
    std::vector<PathSpectrum> air_;            // (hop) before it
    std::vector<NodeLobe> lobe_;               // (hop) of rough mirrors
};

}  // namespace

double hop_radiance(const Hops& hops, std::size_t pixel, std::span<const Plume> plumes,
                    const Band& band, const RadianceInput& input, const ScatteredSun* scattered) {
    return NodeSum(hops, pixel, plumes, band, input, scattered).sum();
}

}  // namespace diurna
