#include "thermal/solve/facet_exchange.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>

#include "materials/base/parallel.hpp"
#include "terrain/visibility/interreflection.hpp"

namespace diurna {

namespace {

// Three cache lines of every facet, for each of which the rows of view factors are read once; fewer
// of many facets.
constexpr std::size_t most_runs = 3, most_instants = most_runs * PackedField::run;
constexpr float most_sent_on = 0.99f;

/// Sunlight on all facets at a few instants, (facet, instant of these).
class SunlightAtOnce {
 public:
    SunlightAtOnce(const ExchangingFacets& scene, const SunlitInstants& sun,
                   std::span<const std::size_t> instants)
        : scene_(scene),
          sun_(sun),
          instants_(instants),
          wide_(PackedField::whole_runs(instants.size())) {
        incident_.resize(scene.facets.size() * instants.size());
        spread_albedo();
        light_.resize(sun.sky.tiers);
        for (std::size_t k = 0; k < instants.size(); ++k) {
            const std::size_t first = instants[k] * sun.sky.tiers;
            for (std::size_t tier = 0; tier < sun.sky.tiers; ++tier) {
                light_[tier].put(k, sun.sky.sky[first + tier]);
            }
            for (std::size_t axis = 0; axis < 3; ++axis) {
                to_sun_[axis][k] = float(sun.sky.sky[first].to_sun[Eigen::Index(axis)]);
            }
        }
    }

    /// Sun and sky, and ground below the scene's edge.
    void add_sunlight() {
        const std::size_t n = instants_.size();
        for_each_index(scene_.facets.size(), [&](std::size_t f) {
            const Eigen::Vector3f normal = scene_.facets.normal[f];
            alignas(32) float seen[most_instants], light[most_instants];
            // The fraction counts the facet's own turning away already.
            shares_of(f, seen);
            for (std::size_t k = 0; k < wide_; ++k) {
                seen[k] *= std::max(0.0f, normal.x() * to_sun_[0][k] + normal.y() * to_sun_[1][k] +
                                              normal.z() * to_sun_[2][k]);
            }
            const SkyVector shares = sky_of(scene_.views, scene_.facets, f);
            const OpenSky open{.view = double{scene_.views.sky[f]},
                               .horizon = horizon_view(shares),
                               .shares = shares};
            const std::size_t low = light_.size() == 1 ? 0 : sun_.sky.low[f];
            light_[low].fall(seen, open, wide_, light);
            add_below(f, light_[low], light);
            if (light_.size() > 1) {
                alignas(32) float above[most_instants];
                light_[low + 1].fall(seen, open, wide_, above);
                add_below(f, light_[low + 1], above);
                const float share = sun_.sky.share[f];
                for (std::size_t k = 0; k < wide_; ++k) {
                    light[k] += share * (above[k] - light[k]);
                }
            }
            std::copy_n(light, n, incident_.begin() + std::ptrdiff_t(f * n));
        });
    }

    /// What facets reflect of each other, to the bound.
    void bounce(double bound) {
        const std::size_t n = instants_.size(), counted = scene_.facets.size() - scene_.beside;
        std::vector<float> scale(n), unsent(scene_.facets.size() * wide_),
            counts(scene_.facets.size());
        for (std::size_t k = 0; k < n; ++k) {
            scale[k] = float(1.0 / (bound * double(light_.front().global[k])));
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
            counts[f] = f < counted ? reflect(f, &incident_[f * n], &unsent[f * wide_]) : 0.0f;
        });
        const ViewFactors& seen = scene_.views.others;
        interreflect(SeenRows{.row = seen.row, .source = seen.facet, .factor = seen.factor},
                     {.value = unsent.data(), .stride = wide_, .lanes = wide_, .counts = counts},
                     [&](std::size_t f, const float* arrived, float* out) {
                         for (std::size_t k = 0; k < n; ++k) incident_[f * n + k] += arrived[k];
                         return f < counted ? reflect(f, arrived, out) : 0.0f;
                     });
    }

    /// (facet, instant of these)
    std::span<const float> incident() const { return incident_; }

 private:
    /// The light of a tier's sky at these instants, as SkyLight; zero beyond them. In arrays, so
    /// that a facet's light at all of them is computed in vectors.
    struct TierLight {
        alignas(32) float beam[most_instants] = {}, even[most_instants] = {},
                          horizon[most_instants] = {};
        alignas(32) float uneven[sky_functions][most_instants] = {};
        alignas(32) float global[most_instants] = {};  // [W m⁻²] on the horizontal
        std::array<bool, sky_functions> any{};         // not zero at all instants

        void put(std::size_t k, const SkyState& sky) {
            const SkyLight of = sky_light(sky);
            beam[k] = float(of.beam);
            even[k] = float(of.even);
            horizon[k] = float(of.horizon);
            global[k] = float(sky.global_horizontal());
            for (std::size_t j = 0; j < sky_functions; ++j) {
                uneven[j][k] = of.uneven[j];
                any[j] = any[j] || of.uneven[j] != 0.0f;
            }
        }
        /// facet_sunlight() at so many of the instants, whole runs of them.
        void fall(const float* seen, const OpenSky& open, std::size_t wide, float* light) const {
            const float view = float(open.view), ring = float(open.horizon);
            alignas(32) float sky[most_instants];
            for (std::size_t k = 0; k < wide; ++k) {
                sky[k] = even[k] * view + horizon[k] * ring;
            }
            for (std::size_t j = 0; j < sky_functions; ++j) {
                if (!any[j]) continue;
                const float share = open.shares[j];
                for (std::size_t k = 0; k < wide; ++k) sky[k] += uneven[j][k] * share;
            }
            for (std::size_t k = 0; k < wide; ++k) {
                light[k] = beam[k] * seen[k] + std::max(0.0f, sky[k]);
            }
        }
    };

    /// What ground below the scene's edge reflects.
    void add_below(std::size_t f, const TierLight& of, float* light) const {
        const float below = scene_.views.below[f];
        if (!scene_.exchange || below == 0.0f) return;
        for (std::size_t k = 0; k < instants_.size(); ++k) {
            light[k] += below * albedo(f, k) * of.global[k];
        }
    }
    /// A facet's share in the sun at these instants; zero beyond them.
    void shares_of(std::size_t f, float* share) const {
        const std::size_t n = instants_.size();
        std::fill(share + n, share + wide_, 0.0f);
        if (sun_.shares != nullptr && !sun_.shares->empty()) {
            const int first = sun_.shares->slot(sun_.first + instants_.front());
            const int last = sun_.shares->slot(sun_.first + instants_.back());
            const bool whole = (n % PackedField::run == 0 || last + 1 == int(sun_.shares->slots()));
            if (first % int(PackedField::run) == 0 && last == first + int(n) - 1 && whole) {
                for (std::size_t k = 0; k < n; k += PackedField::run) {
                    sun_.shares->get((std::size_t(first) + k) / PackedField::run, f, share + k);
                }
                return;
            }
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
    std::size_t wide_;  // instants rounded up to whole runs: whole vectors, zero beyond
    std::vector<TierLight> light_{};                   // (tier)
    alignas(32) float to_sun_[3][most_instants] = {};  // (axis, instant)
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
        scene.bound * (1.0 - double(greatest_sent_on(
                                 scene.views, std::span(albedo).first(facets - scene.beside))));
    const std::vector<std::size_t> lit = sunlit(sun.sky);
    const std::size_t at_once = PackedField::run * runs_at_once(facets, most_runs);
    for (std::size_t first = 0; first < lit.size(); first += at_once) {
        const std::size_t count = std::min(at_once, lit.size() - first);
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

namespace {

/// The same of `groups` groups of eight instants from `first` on.
template <std::size_t groups>
void arriving_lanes(const FacetViews& view, std::span<const float> leaving, std::size_t facet,
                    std::size_t first, std::span<float> excess) {
    using Lane = Eigen::Array<float, 8, 1>;
    const std::size_t instants = excess.size();
    const auto sent = [&](std::size_t f, std::size_t g) {
        return Eigen::Map<const Lane>(leaving.data() + f * instants + first + 8 * g);
    };
    const float itself = seen_as_itself(view, facet);
    Lane sum[groups];
    for (std::size_t g = 0; g < groups; ++g) sum[g] = itself * sent(facet, g);
    const std::size_t end = view.others.row[facet + 1];
    for (std::size_t k = view.others.row[facet]; k < end; ++k) {
        const float factor = view.others.factor[k];
        const std::size_t from = view.others.facet[k];
        for (std::size_t g = 0; g < groups; ++g) sum[g] += factor * sent(from, g);
    }
    for (std::size_t g = 0; g < groups; ++g) {
        Eigen::Map<Lane>(excess.data() + first + 8 * g) = sum[g];
    }
}

}  // namespace

void arriving_longwave(const FacetViews& view, std::span<const float> leaving, std::size_t facet,
                       std::span<float> excess) {
    const std::size_t instants = excess.size();
    std::size_t first = 0;
    for (; first + 64 <= instants; first += 64) {
        arriving_lanes<8>(view, leaving, facet, first, excess);
    }
    for (; first + 16 <= instants; first += 16) {
        arriving_lanes<2>(view, leaving, facet, first, excess);
    }
    const float itself = seen_as_itself(view, facet);
    for (; first < instants; ++first) {
        float sum = itself * leaving[facet * instants + first];
        for (std::size_t k = view.others.row[facet]; k < view.others.row[facet + 1]; ++k) {
            sum += view.others.factor[k] * leaving[view.others.facet[k] * instants + first];
        }
        excess[first] = sum;
    }
}

}  // namespace diurna
