#include "scenes/products/export/reshade.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/band.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

constexpr const char* radiance_of = "radiance.";
constexpr double sun_kelvin = 5772.0;
constexpr std::array lights{"sun", "sky", "surroundings"};
constexpr std::array light_planes{"sunlight", "skylight", "surroundings"};

/// The band of a picture's radiance.
Band band_of(const Frame& frame) {
    std::vector<std::string> names;
    for (const Plane& plane : frame.planes) {
        if (plane.name.starts_with(radiance_of)) {
            names.push_back(plane.name.substr(std::string(radiance_of).size()));
        }
    }
    if (names.size() != 1) {
        throw InputError(frame.observer,
                         fmt::format("found {} planes of radiance, expected one", names.size()));
    }
    try {
        return parse_band(names.front());
    } catch (const InputError&) {
        throw InputError(frame.observer,
                         fmt::format("found the band \"{}\", expected a range such as \"8-12\"; "
                                     "the response of a named band is not in the picture",
                                     names.front()));
    }
}

/// Planes of the k-th surface of every pixel.
struct SurfacePlanes {
    Plane *weight, *facet, *temperature, *black, *emissivity, *transmittance;
    std::array<Plane*, 3> light{}, reflectance{}, passed{};
    const Plane *sun_fraction, *cosine_sun, *sky_view, *mirror;
    std::array<const Plane*, 3> others{};  // light that does not change; null: none
};

class Pictured {
 public:
    Pictured(Frame& frame, const std::string& band) : frame_(frame), band_(band) {}
    Plane* find(const std::string& name) const {
        const auto at = std::find_if(frame_.planes.begin(), frame_.planes.end(),
                                     [&](const Plane& plane) { return plane.name == name; });
        return at == frame_.planes.end() ? nullptr : &*at;
    }
    Plane* needed(const std::string& name) const {
        if (Plane* plane = find(name)) return plane;
        throw InputError(frame_.observer, fmt::format("the picture has no plane \"{}\"", name),
                         "render it with surfaces = N in [[observer]] (diurna render)");
    }
    std::vector<SurfacePlanes> surfaces() const {
        std::vector<SurfacePlanes> all;
        needed("weight_1");
        for (int k = 1; find(fmt::format("weight_{}", k)); ++k) {
            const auto plane = [&](const std::string& what) {
                return needed(fmt::format("{}_{}", what, k));
            };
            const auto of_band = [&](const std::string& what) {
                return needed(fmt::format("{}_{}.{}", what, k, band_));
            };
            SurfacePlanes one{.weight = plane("weight"),
                              .facet = plane("facet"),
                              .temperature = plane("temperature"),
                              .black = of_band("black"),
                              .emissivity = of_band("emissivity"),
                              .transmittance = of_band("transmittance"),
                              .sun_fraction = plane("sun_fraction"),
                              .cosine_sun = plane("cosine_sun"),
                              .sky_view = plane("sky_view"),
                              .mirror = find(fmt::format("mirror_{}.{}", k, band_))};
            std::size_t next = 0;
            for (const char* what : {"behind", "mirrored", "air"}) {
                one.others[next++] = find(fmt::format("{}_{}.{}", what, k, band_));
            }
            for (std::size_t i = 0; i < lights.size(); ++i) {
                one.light[i] = of_band(light_planes[i]);
                one.reflectance[i] = of_band(std::string("reflectance_") + lights[i]);
                one.passed[i] = of_band(std::string("transmittance_") + lights[i]);
            }
            all.push_back(one);
        }
        return all;
    }

 private:
    Frame& frame_;
    const std::string& band_;
};

/// Mean of a material's emissivity or reflectance over a band, weighted by a black body.
double band_mean(const Band& band, const Material& material, double kelvin, bool emissivity) {
    double sum = 0.0, all = 0.0;
    for (std::size_t i = 0; i < band.node_um.size(); ++i) {
        const double um = band.node_um[i];
        const double weight = band.weight[i] * planck(um, kelvin);
        const double reflected = material.reflectance.at(um);
        const double passed = material.transmittance.empty() ? 0.0 : material.transmittance.at(um);
        sum += weight * (emissivity ? 1.0 - reflected - passed : reflected);
        all += weight;
    }
    return all > 0.0 ? sum / all : 0.0;
}

/// A changed surface in a band.
class ChangedOptics {
 public:
    ChangedOptics(const Band& band, const SurfaceChange& change) : band_(band), change_(change) {
        if (!change.paint) return;
        constexpr double usual = 288.15, reflected_begins = 3.0;  // [K], [µm]
        const double sky = band.from_um() < reflected_begins ? sun_kelvin : usual;
        paint_ = {band_mean(band, *change.paint, sun_kelvin, false),
                  band_mean(band, *change.paint, sky, false),
                  band_mean(band, *change.paint, sky, false)};
    }
    double emissivity(double now, double kelvin) const {
        if (change_.paint) return band_mean(band_, *change_.paint, kelvin, true);
        return change_.emissivity.value_or(now);
    }
    double reflectance(double now, std::size_t light) const {
        if (change_.paint) return paint_[light];
        if (change_.reflectance) return *change_.reflectance;
        return change_.emissivity ? 1.0 - *change_.emissivity : now;
    }

 private:
    const Band& band_;
    const SurfaceChange& change_;
    std::array<double, 3> paint_{};
};

double attribute(const Frame& frame, const char* name) {
    const auto found = frame.attributes.find(name);
    return found == frame.attributes.end() ? 0.0 : std::atof(found->second.c_str());
}

/// [W m⁻²] From the sun and the sky, in all wavelengths.
struct Falling {
    double beam, diffuse, longwave;
};

/// [K] Of a surface whose emissivity and reflectance change by so much.
double heat_estimate(const Falling& falling, const SurfacePlanes& s, std::size_t p, double kelvin,
                     double emissivity, double more_emissivity, double more_reflectance) {
    constexpr double film = 10.0;  // [W m⁻² K⁻¹]
    const double view = double{s.sky_view->pixel[p]};
    const double black = stefan_boltzmann * std::pow(kelvin, 4);
    const double sunlight =
        falling.beam * double{s.cosine_sun->pixel[p]} * double{s.sun_fraction->pixel[p]} +
        falling.diffuse * view;
    const double gained =
        -more_emissivity * view * (black - falling.longwave) - more_reflectance * sunlight;
    return gained / (film + 4.0 * (emissivity + more_emissivity) * black / kelvin);
}

}  // namespace

ReshadedFrame reshade(const Frame& given, const ChangedFacets& facets,
                      const SurfaceChange& change) {
    ReshadedFrame found{.frame = given};
    Frame& frame = found.frame;
    const Band band = band_of(frame);
    std::erase_if(frame.planes, [&](const Plane& plane) {
        for (const char* term : {"emitted.", "reflected_sun.", "reflected_sky.",
                                 "reflected_surroundings.", "transmitted.", "sigma."}) {
            if (plane.name.starts_with(term)) return true;
        }
        return false;
    });
    const Pictured planes(frame, band.name);
    const std::vector<SurfacePlanes> surfaces = planes.surfaces();
    const ChangedOptics optics(band, change);
    Plane& radiance = *planes.needed(radiance_of + band.name);
    Plane& apparent = *planes.needed("apparent_temperature." + band.name);
    const Plane& unlisted = *planes.needed("unlisted");
    const Plane* const path = given.find("path." + band.name);
    const Plane* const rest = given.find("rest." + band.name);
    Plane* const centre_kelvin = planes.find("temperature");
    const Plane* const centre = planes.find("facet");
    const Falling falling{attribute(frame, "sun.direct_normal_W_m2"),
                          attribute(frame, "sun.diffuse_horizontal_W_m2"),
                          attribute(frame, "sky.longwave_down_W_m2")};
    const auto is_of_object = [&](float facet) {
        return facet >= 0.0f && std::size_t(facet) < facets.of_object.size() &&
               facets.of_object[std::size_t(facet)] != 0;
    };
    const auto warmer_of = [&](float facet) {
        double warmer = is_of_object(facet) ? change.warmer : 0.0;
        if (facet >= 0.0f && std::size_t(facet) < facets.warmer.size()) {
            warmer += double{facets.warmer[std::size_t(facet)]};
        }
        return warmer;
    };
    double estimated = 0.0, covered = 0.0;
    for (std::size_t p = 0; p < frame.pixels(); ++p) {
        double more = 0.0, sum = path ? double{path->pixel[p]} : 0.0, share = 0.0;
        if (rest) sum += double{rest->pixel[p]};
        bool mirrors = false;
        for (std::size_t k = 0; k < surfaces.size(); ++k) {
            const SurfacePlanes& s = surfaces[k];
            const double weight = double{s.weight->pixel[p]};
            if (!(weight > 0.0)) continue;
            const float facet = s.facet->pixel[p];
            for (const Plane* other : s.others) {
                if (other) sum += weight * double{other->pixel[p]};
            }
            if (facet < 0.0f) continue;
            const double kelvin = double{s.temperature->pixel[p]};
            const double emissivity = double{s.emissivity->pixel[p]};
            const double warm = kelvin + warmer_of(facet);
            const double black = double{s.black->pixel[p]};
            const double passed = double{s.transmittance->pixel[p]};
            const bool ours = is_of_object(facet);
            const double then = ours ? optics.emissivity(emissivity, warm) : emissivity;
            const double glow =
                warm == kelvin ? black
                               : black * band_radiance(band, warm) / band_radiance(band, kelvin);
            sum += weight * passed * emissivity * black;
            more += weight * passed * (then * glow - emissivity * black);
            double whiter = 0.0;
            for (std::size_t i = 0; i < lights.size(); ++i) {
                const double light = double{s.light[i]->pixel[p]} * double{s.passed[i]->pixel[p]};
                const double now = double{s.reflectance[i]->pixel[p]};
                sum += weight * now * light;
                if (!ours) continue;
                // Without light the picture's mean reflectance is 0 and says nothing.
                const double next = light > 0.0 ? optics.reflectance(now, i) : now;
                more += weight * (next - now) * light;
                if (i == 0) whiter = next - now;
                s.reflectance[i]->pixel[p] = float(next);
            }
            s.temperature->pixel[p] = float(warm);
            s.black->pixel[p] = float(glow);
            if (!ours) continue;
            mirrors = mirrors || (s.mirror && s.mirror->pixel[p] > 0.0f);
            s.emissivity->pixel[p] = float(then);
            estimated += weight * heat_estimate(falling, s, p, kelvin, emissivity,
                                                then - emissivity, whiter);
            covered += weight;
            share += weight;
        }
        const double before = double{radiance.pixel[p]};
        const double kelvin = brightness_temperature(band, before);
        if (more != 0.0) {
            radiance.pixel[p] = float(std::max(0.0, before + more));
            apparent.pixel[p] = float(brightness_temperature(band, double{radiance.pixel[p]}));
        }
        if (centre_kelvin && centre && centre->pixel[p] >= 0.0f) {
            centre_kelvin->pixel[p] += float(warmer_of(centre->pixel[p]));
        }
        if (!(share > 0.0)) continue;
        ++found.pixels;
        found.mirrors += mirrors ? 1 : 0;
        const double moved = double{apparent.pixel[p]} - kelvin;
        found.change += moved * moved;
        if (unlisted.pixel[p] > 1e-5f) {
            ++found.unlisted;
        } else if (path) {
            const double off = (sum - before) / band_radiance_derivative(band, kelvin);
            found.sum_rms += off * off;
            found.sum_worst = std::max(found.sum_worst, std::abs(off));
            ++found.summed;
        }
    }
    if (found.pixels > 0) found.change = std::sqrt(found.change / double(found.pixels));
    if (found.summed > 0) found.sum_rms = std::sqrt(found.sum_rms / double(found.summed));
    if (covered > 0.0) found.heat_estimate = estimated / covered;
    return found;
}

}  // namespace diurna
