#include "render/rays/secondary_radiance.hpp"

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

/// One pixel's secondary rays, one after the other.
class NodeSum {
 public:
    NodeSum(const SecondaryRays& secondary_rays, std::size_t pixel, std::span<const Plume> plumes,
            const Band& band, const RadianceInput& input, const ScatteredSun* scattered)
        : list_(secondary_rays.of(pixel)),
          plumes_(plumes),
          band_(band),
          input_(input),
          scattered_(scattered),
          eye_km_(input.above_sea_km(secondary_rays.observer_height)),
          lobes_(band, input, scattered, eye_km_) {}

    double sum() {
        double sum = 0.0;
        for (const SecondaryRay& secondary : list_) {
            passed_.push_back(past(secondary));
            const bool rough = lobes_.is_rough(secondary);
            lobe_.push_back(rough ? lobes_.sum(secondary) : NodeLobe{});
            std::vector<double> light = secondary.kind == SecondaryRay::Kind::sky
                                            ? background(secondary)
                                            : air_and_own(secondary);
            if (rough) lobes_.add(secondary, lobe_.back(), light);
            if (secondary.way == SecondaryRay::Way::mirrored &&
                lobes_.is_rough(mirror_of(secondary))) {
                lobes_.take_expected(mirror_of(secondary),
                                     lobe_[static_cast<std::size_t>(secondary.before)],
                                     secondary.direction.cast<double>(), light);
            }
            for (std::size_t n = 0; n < light.size(); ++n) {
                sum += double{secondary.weight} * band_.weight[n] * passed_.back()[n] * light[n];
            }
        }
        return sum;
    }

 private:
    std::size_t nodes() const { return band_.node_um.size(); }
    const Material& material(const SecondaryRay& secondary) const {
        return input_.materials[input_.facets.material[secondary.what]];
    }
    /// Of the secondary ray before; null: there is none.
    const PathSpectrum* air_before(const SecondaryRay& secondary) const {
        return secondary.before < 0 ? nullptr : &air_[static_cast<std::size_t>(secondary.before)];
    }

    /// What light is left of, past the secondary rays before.
    std::vector<double> past(const SecondaryRay& secondary) const {
        std::vector<double> passed(nodes(), 1.0);
        if (secondary.before < 0) return passed;
        const auto j = static_cast<std::size_t>(secondary.before);
        const SecondaryRay& before = list_[j];
        if (before.kind == SecondaryRay::Kind::plume) {
            for (std::size_t n = 0; n < nodes(); ++n) {
                const double k = plumes_[before.what].absorption_at(band_.node_um[n]);
                passed[n] = passed_[j][n] * std::exp(-k * double{before.chord});
            }
            return passed;
        }
        const auto optics = optics_at_nodes(material(before), band_, double{before.cosine});
        if (secondary.way == SecondaryRay::Way::mirrored && lobes_.is_rough(before)) {
            const auto facing = facing_at_nodes(material(before), band_,
                                                facing_between(-before.direction.cast<double>(),
                                                               secondary.direction.cast<double>()));
            for (std::size_t n = 0; n < nodes(); ++n) {
                passed[n] = passed_[j][n] * optics[n].mirrored * facing[n] / lobe_[j].reflected[n];
            }
            return passed;
        }
        for (std::size_t n = 0; n < nodes(); ++n) {
            passed[n] = passed_[j][n] * (secondary.way == SecondaryRay::Way::mirrored
                                             ? optics[n].mirrored
                                             : optics[n].transmittance);
        }
        return passed;
    }

    const SecondaryRay& mirror_of(const SecondaryRay& secondary) const {
        return list_[static_cast<std::size_t>(secondary.before)];
    }
    /// Past a mirror: as it arrives at the eye, on one way with that from the mirror on.
    std::vector<double> background(const SecondaryRay& secondary) {
        const double from_km =
            secondary.straight ? eye_km_ : input_.above_sea_km(double{secondary.height});
        SightLine onward;
        if (!secondary.straight) onward = lobes_.line_to(mirror_of(secondary));
        std::vector<double> light =
            lobes_.background(secondary.direction.cast<double>(), from_km, onward);
        const PathSpectrum* before = secondary.straight ? air_before(secondary) : nullptr;
        for (std::size_t n = 0; before && n < nodes(); ++n) light[n] -= before->radiance[n];
        air_.emplace_back();
        return light;
    }

    std::vector<double> air_and_own(const SecondaryRay& secondary) {
        const SightLine line = lobes_.line_to(secondary);
        PathSpectrum path = path_at_nodes(input_.atmosphere, line, band_.node_um);
        if (scattered_ != nullptr && secondary.straight) {
            const Eigen::Vector3d to = secondary.direction.cast<double>();
            const auto sunlit =
                scattered_->path(line, zenith_deg_of(to), azimuth_from_sun_deg(to, input_.to_sun));
            for (std::size_t n = 0; n < nodes(); ++n) path.radiance[n] += sunlit[n];
        }
        const PathSpectrum* before = air_before(secondary);
        const LightByOrigin shares = onward_shares(
            input_, line, input_.above_sea_km(double{secondary.height}), band_.node_um);
        const LightByOrigin sent = own(secondary);
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

    /// What the secondary ray sends along the ray that arrives, except for what it mirrors and lets
    /// through.
    LightByOrigin own(const SecondaryRay& secondary) const {
        if (secondary.kind == SecondaryRay::Kind::plume) {
            std::vector<double> glow(nodes());
            const Plume& plume = plumes_[secondary.what];
            for (std::size_t n = 0; n < nodes(); ++n) {
                const double depth =
                    plume.absorption_at(band_.node_um[n]) * double{secondary.chord};
                glow[n] = -std::expm1(-depth) * planck(band_.node_um[n], plume.temperature);
            }
            return from_surface(std::move(glow));
        }
        const TermsByOrigin terms =
            radiosity_by_origin(input_, secondary.surface(), band_.node_um, 2, scattered_);
        if (!secondary.closed && material(secondary).needs_rays())
            return directional(secondary, terms);
        LightByOrigin sent;
        for (std::vector<double>& light : sent) light.assign(nodes(), 0.0);
        for (const LightByOrigin& term : terms) {
            for (std::size_t o = 0; o < origin_count; ++o) {
                for (std::size_t n = 0; n < term[o].size(); ++n) sent[o][n] += term[o][n];
            }
        }
        return sent;
    }

    LightByOrigin directional(const SecondaryRay& secondary, const TermsByOrigin& terms) const {
        const Material& of = material(secondary);
        const double temperature = input_.temperature[secondary.what];
        const auto seen = optics_at_nodes(of, band_, double{secondary.cosine});
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
        add_sunlight(secondary, seen, from(sent, Origin::sunlight));
        return sent;
    }

    void add_sunlight(const SecondaryRay& secondary, std::span<const DirectionalOptics> seen,
                      std::vector<double>& sent) const {
        const SurfaceId facet = secondary.surface();
        const double sunlight = sunlight_on(input_, facet);
        if (!(sunlight > 0.0)) return;
        const Material& of = material(secondary);
        const Eigen::Vector3d normal = input_.facets.normal[secondary.what].cast<double>();
        const Eigen::Vector3d eye = -secondary.direction.cast<double>();
        const IncidentLight light =
            incident_light(input_, input_.height_km(facet), band_.node_um, scattered_);
        const auto lit = optics_at_nodes(of, band_, normal.dot(input_.to_sun));
        const std::vector<double> mean = mean_diffuse_at_nodes(of, band_);
        const double lobe = measured_lobe(of.finish, normal, eye, input_.to_sun);
        const auto* glossy = std::get_if<Glossy>(&of.finish);
        const double glint = glossy ? sun_glint(microfacets_of(*glossy), normal, eye, input_.to_sun,
                                                double{secondary.cosine})
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

    std::span<const SecondaryRay> list_;
    std::span<const Plume> plumes_;
    const Band& band_;
    const RadianceInput& input_;
    const ScatteredSun* scattered_;
    double eye_km_;
    NodeLobes lobes_;
    std::vector<std::vector<double>> passed_;  // (secondary ray)(node)
    std::vector<PathSpectrum> air_;            // (secondary ray) before it
    std::vector<NodeLobe> lobe_;               // (secondary ray) of rough mirrors
};

}  // namespace

double secondary_radiance(const SecondaryRays& secondary_rays, std::size_t pixel,
                          std::span<const Plume> plumes, const Band& band,
                          const RadianceInput& input, const ScatteredSun* scattered) {
    return NodeSum(secondary_rays, pixel, plumes, band, input, scattered).sum();
}

}  // namespace diurna
