#include "thermal/solve/facet_exchange.hpp"

#include <algorithm>

#include "materials/base/parallel.hpp"
#include "terrain/visibility/interreflection.hpp"

namespace diurna {

namespace {

constexpr std::size_t instants_at_once = PackedField::run;  // a cache line of every facet
constexpr double sunlight_bound = 1e-4;  // of the global sun, skipped of a facet's light
constexpr float most_sent_on = 0.99f;

/// Sunlight on all facets at a few instants, (facet, instant of these).
class SunlightAtOnce {
 public:
    SunlightAtOnce(const ExchangingFacets& scene, const SunlitInstants& sun,
                   std::span<const std::size_t> instants)
        : scene_(scene), sun_(sun), instants_(instants) {
        incident_.resize(scene.facets.size() * instants.size());
        spread_albedo();
        for (const std::size_t i : instants) {
            for (std::size_t tier = 0; tier < sun.sky.tiers; ++tier) {
                const SkyState& sky = sun.sky.sky[i * sun.sky.tiers + tier];
                const SkyLight light = sky_light(sky);
                light_.push_back({light, sky.global_horizontal()});
            }
        }
    }

    /// Sun and sky, and ground below the scene's edge.
    void add_sunlight() {
        const std::size_t n = instants_.size();
        for_each_index(scene_.facets.size(), [&](std::size_t f) {
            const Eigen::Vector3d normal = scene_.facets.normal[f].cast<double>();
            float share[instants_at_once];
            shares_of(f, share);
            OpenSky open = open_sky(sky_of(scene_.views, scene_.facets, f));
            open.view = double{scene_.views.sky[f]};
            for (std::size_t k = 0; k < n; ++k) {
                const SkyState& sky = sun_.sky.sky[instants_[k] * sun_.sky.tiers];
                // The fraction counts the facet's own turning away already.
                const double seen = std::max(0.0, normal.dot(sky.to_sun)) * double(share[k]);
                const auto of_tier = [&](const Light& of) {
                    double light = facet_sunlight(of.sky, seen, open);
                    if (scene_.exchange) {
                        light += double(scene_.views.below[f]) * albedo(f, k) * of.global;
                    }
                    return light;
                };
                const double light = sun_.sky.at_facet(light_, k, f, of_tier);
                incident_[f * n + k] = float(light);
            }
        });
    }

    /// What facets reflect of each other, to the bound.
    void bounce(double bound) {
        const std::size_t n = instants_.size(), counted = scene_.facets.size() - scene_.beside;
        std::vector<float> scale(n), unsent(incident_.size()), counts(scene_.facets.size());
        for (std::size_t k = 0; k < n; ++k) {
            scale[k] = float(1.0 / (bound * light_[k * sun_.sky.tiers].global));
        }
        // (T32) of docs/theory.md
        const auto reflect = [&](std::size_t f, const float* light, float* out) {
            float most = 0.0f;
            for (std::size_t k = 0; k < n; ++k) {
                out[k] += albedo(f, k) * light[k];
                most = std::max(most, out[k] * scale[k]);
            }
            return most;
        };
        for_each_index(scene_.facets.size(), [&](std::size_t f) {
            counts[f] = f < counted ? reflect(f, &incident_[f * n], &unsent[f * n]) : 0.0f;
        });
        const ViewFactors& seen = scene_.views.others;
        interreflect(SeenRows{.row = seen.row, .source = seen.facet, .factor = seen.factor},
                     {.value = unsent.data(), .stride = n, .lanes = n, .counts = counts},
                     [&](std::size_t f, const float* arrived, float* out) {
                         for (std::size_t k = 0; k < n; ++k) incident_[f * n + k] += arrived[k];
                         return f < counted ? reflect(f, arrived, out) : 0.0f;
                     });
    }

    /// (facet, instant of these)
    std::span<const float> incident() const { return incident_; }

 private:
    /// A facet's share in the sun at these instants.
    void shares_of(std::size_t f, float* share) const {
        const std::size_t n = instants_.size();
        if (sun_.shares != nullptr && !sun_.shares->empty()) {
            for (std::size_t k = 0; k < n; ++k) {
                share[k] = sun_.shares->at(sun_.first + instants_[k], f);
            }
        } else if (sun_.fraction.empty()) {
            std::fill_n(share, n, 1.0f);
        } else {
            for (std::size_t k = 0; k < n; ++k) {
                share[k] = sun_.fraction[instants_[k] * scene_.facets.size() + f];
            }
        }
    }
    /// Of all facets at these instants, if it changes.
    void spread_albedo() {
        if (!scene_.changing) return;
        const std::size_t n = instants_.size();
        const ChangingAlbedo& changing = *scene_.changing;
        changed_.resize(scene_.facets.size() * n);
        for (std::size_t f = 0; f < scene_.facets.size(); ++f) {
            std::fill_n(changed_.begin() + std::ptrdiff_t(f * n), n, scene_.optics.albedo[f]);
        }
        for (std::size_t k = 0; k < n; ++k) {
            const float* const row = &changing.albedo[instants_[k] * changing.facet.size()];
            for (std::size_t place = 0; place < changing.facet.size(); ++place) {
                changed_[changing.facet[place] * n + k] = row[place];
            }
        }
    }
    float albedo(std::size_t f, std::size_t k) const {
        return changed_.empty() ? scene_.optics.albedo[f] : changed_[f * instants_.size() + k];
    }

    const ExchangingFacets& scene_;
    const SunlitInstants& sun_;
    std::span<const std::size_t> instants_;
    struct Light {
        SkyLight sky;
        double global;  // [W m⁻²] on the horizontal
    };
    std::vector<Light> light_;  // (instant, tier)
    std::vector<float> incident_;
    std::vector<float> changed_;  // (facet, instant) albedo; empty: FacetOptics'
};

/// (facet) The greatest albedo at any instant.
std::vector<float> greatest_albedo(const ExchangingFacets& scene) {
    std::vector<float> greatest = scene.optics.albedo;
    if (!scene.changing) return greatest;
    const std::vector<std::uint32_t>& facet = scene.changing->facet;
    for (std::size_t n = 0; n < scene.changing->albedo.size(); ++n) {
        float& most = greatest[facet[n % facet.size()]];
        most = std::max(most, scene.changing->albedo[n]);
    }
    return greatest;
}

}  // namespace

float greatest_sent_on(const FacetViews& views, std::span<const float> reflectance) {
    float greatest = 0.0f;
    for (std::size_t f = 0; f < reflectance.size(); ++f) {
        greatest = std::max(greatest, reflectance[f] * (1.0f - views.sky[f]));
    }
    return std::min(greatest, most_sent_on);
}

FacetOptics facet_optics(const FacetSet& facets, const MaterialLibrary& materials) {
    FacetOptics optics;
    optics.albedo.reserve(facets.size());
    optics.emissivity.reserve(facets.size());
    for (const MaterialId id : facets.material) {
        // Others see so much less of a pane, by what goes through, and that bright.
        const ThermalSurface& surface = materials[id].thermal;
        const double stops = materials[id].see_through ? 1.0 - surface.solar_transmittance : 1.0;
        optics.albedo.push_back(float(stops > 0.0 ? surface.albedo / stops : 0.0));
        optics.emissivity.push_back(float(materials[id].thermal.emissivity));
    }
    return optics;
}

std::vector<std::size_t> sunlit(const SkyOverFacets& sky) {
    std::vector<std::size_t> lit;
    for (std::size_t i = 0; i < sky.instants(); ++i) {
        if (sky.sky[i * sky.tiers].global_horizontal() > 0.0) lit.push_back(i);
    }
    return lit;
}

void incident_sunlight(
    const ExchangingFacets& scene, const SunlitInstants& sun,
    const std::function<void(std::span<const std::size_t>, std::span<const float>)>& put) {
    const std::size_t facets = scene.facets.size();
    const bool bounces = scene.exchange && !scene.views.others.facet.empty();
    const std::vector<float> albedo = greatest_albedo(scene);
    const double bound =
        sunlight_bound * (1.0 - double(greatest_sent_on(
                                    scene.views, std::span(albedo).first(facets - scene.beside))));
    const std::vector<std::size_t> lit = sunlit(sun.sky);
    for (std::size_t first = 0; first < lit.size(); first += instants_at_once) {
        const std::size_t count = std::min(instants_at_once, lit.size() - first);
        const std::span<const std::size_t> instants = std::span(lit).subspan(first, count);
        SunlightAtOnce light(scene, sun, instants);
        light.add_sunlight();
        if (bounces) light.bounce(bound);
        put(instants, light.incident());
    }
}

void incident_sunlight(const ExchangingFacets& scene, const SunlitInstants& sun,
                       std::span<float> incident) {
    std::fill(incident.begin(), incident.end(), 0.0f);
    const std::size_t facets = scene.facets.size();
    incident_sunlight(
        scene, sun, [&](std::span<const std::size_t> instants, std::span<const float> light) {
            for_each_index(facets, [&](std::size_t f) {
                for (std::size_t k = 0; k < instants.size(); ++k) {
                    incident[instants[k] * facets + f] = light[f * instants.size() + k];
                }
            });
        });
}

void arriving_longwave(const FacetViews& view, std::span<const float> leaving, std::size_t facet,
                       std::span<float> excess) {
    const std::size_t instants = excess.size();
    const auto add = [&](std::size_t from, float factor, bool first) {
        const float* sent = leaving.data() + from * instants;
        if (first) {
            for (std::size_t i = 0; i < instants; ++i) excess[i] = factor * sent[i];
        } else {
            for (std::size_t i = 0; i < instants; ++i) excess[i] += factor * sent[i];
        }
    };
    add(facet, seen_as_itself(view, facet), true);
    for (auto k = view.others.row[facet]; k < view.others.row[facet + 1]; ++k) {
        add(view.others.facet[k], view.others.factor[k], false);
    }
}

}  // namespace diurna
