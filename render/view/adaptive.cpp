#include "render/view/adaptive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"
#include "render/view/add_view.hpp"
#include "render/view/cast_view.hpp"

namespace diurna {

namespace {

/// Variance of what a pixel's samples show in the worst appearance, if there were `samples`.
double variance(const View& view, std::size_t pixel, std::span<const Appearance> appearances,
                double samples, const SeenInPixels& seen = {}) {
    double worst = 0.0;
    for (const Appearance& appearance : appearances) {
        double sum = 0.0, squares = 0.0;
        const auto add = [&](double weight, double value) {
            sum += weight * value;
            squares += weight * value * value;
        };
        // From the sky's value, so that large numbers' differences stay exact.
        const double base = seen.sky.empty() ? double{appearance.sky} : double{seen.sky[pixel]};
        for (std::uint32_t k = view.row[pixel]; k < view.row[pixel + 1]; ++k) {
            const Sighting& s = view.sighting[k];
            const double more = seen.warmer.empty() ? 0.0 : double{seen.warmer[k]};
            add(double{s.weight},
                double{appearance.facet[index(view.surface[s.target])]} - base + more);
        }
        worst = std::max(worst, squares - sum * sum);
    }
    return worst * samples / std::max(1.0, samples - 1.0);
}

/// Means over the 3 × 3 pixels around each, or as many as there are.
std::vector<double> smoothed(const View& view, const std::vector<double>& values) {
    std::vector<double> mean(values.size());
    for_each_index(values.size(), [&](std::size_t p) {
        const int x = static_cast<int>(p) % view.width, y = static_cast<int>(p) / view.width;
        double sum = 0.0;
        int count = 0;
        for (int j = std::max(0, y - 1); j <= std::min(view.height - 1, y + 1); ++j) {
            for (int i = std::max(0, x - 1); i <= std::min(view.width - 1, x + 1); ++i, ++count) {
                sum += values[static_cast<std::size_t>(j) * std::size_t(view.width) +
                              static_cast<std::size_t>(i)];
            }
        }
        mean[p] = sum / count;
    });
    return mean;
}

/// Extra samples of a level: 0, 16, 48, 112 ...
int extra(int level) { return 16 * ((1 << level) - 1); }

/// As many samples of one round leave the error of these, of which each round is weighted by n^3/2.
float in_one_round(int first, int second) {
    return float(std::pow(std::pow(first, 1.5) + std::pow(second, 1.5), 2.0 / 3.0));
}

/// A of a pixel alone: see variance_of_one().
double own_variance_of_one(const View& view, std::size_t pixel,
                           std::span<const Appearance> appearances, double samples,
                           const SeenInPixels& seen = {}) {
    const double sights =
        double(view.row[pixel + 1] - view.row[pixel]) + (view.sky[pixel] > 0.0f ? 1.0 : 0.0);
    if (sights < 2.0) return 0.0;
    return std::max(0.0, variance(view, pixel, appearances, samples, seen)) *
           std::sqrt(sights - 1.0);
}

}  // namespace

std::vector<float> thermal_appearance(const FacetSet& facets, const FacetViews& views,
                                      const MaterialLibrary& materials,
                                      std::span<const float> temperature, const Band& band) {
    std::vector<float> reflectance(materials.size());
    for (std::size_t m = 0; m < reflectance.size(); ++m) {
        const Spectrum& of = materials[MaterialId{static_cast<std::uint16_t>(m)}].reflectance;
        double sum = 0.0, weight = 0.0;
        for (std::size_t n = 0; n < band.node_um.size(); ++n) {
            sum += band.weight[n] * of.at(band.node_um[n]);
            weight += band.weight[n];
        }
        reflectance[m] = static_cast<float>(sum / weight);
    }
    constexpr float sky = 250.0f;
    std::vector<float> appearance(facets.size());
    for_each_index(facets.size(), [&](std::size_t f) {
        const float open = reflectance[index(facets.material[f])] * float(views.sky[f]);
        appearance[f] = temperature[f] + open * (sky - temperature[f]);
    });
    return appearance;
}

std::vector<double> variance_of_one(const View& view, std::span<const Appearance> appearances,
                                    int samples) {
    std::vector<double> own(view.pixels());
    for_each_index(own.size(), [&](std::size_t p) {
        own[p] = own_variance_of_one(view, p, appearances, samples);
    });
    const std::vector<double> around = smoothed(view, own);
    for (std::size_t p = 0; p < own.size(); ++p) own[p] = 0.5 * (own[p] + around[p]);
    return own;
}

double sampling_error(const View& view, const Appearance& appearance, const SeenInPixels& seen) {
    if (view.samples.empty()) return 0.0;
    std::vector<double> of_mean(view.pixels());
    for_each_index(of_mean.size(), [&](std::size_t p) {
        const double samples = double{view.samples[p]};
        of_mean[p] = own_variance_of_one(view, p, {&appearance, 1}, samples, seen) /
                     (samples * std::sqrt(samples));
    });
    double sum = 0.0;
    for (const double of : of_mean) sum += of;
    return std::sqrt(sum / double(std::max<std::size_t>(1, of_mean.size())));
}

std::vector<int> samples_wanted(std::span<const double> of_one, const AdaptiveOptions& options) {
    std::vector<double> need(of_one.size());
    double mean = 0.0;
    for (std::size_t p = 0; p < need.size(); ++p) {
        need[p] = std::pow(of_one[p], 0.4);
        mean += need[p] / double(need.size());
    }
    const double scale = std::pow(mean / (options.tolerance * options.tolerance), 2.0 / 3.0);
    std::vector<int> wanted(need.size());
    for (std::size_t p = 0; p < need.size(); ++p) {
        int level = 0;
        // The middle of two levels by ratio.
        while (options.from + extra(level + 1) <= options.to &&
               need[p] * scale > std::sqrt(double(options.from + extra(level)) *
                                           double(options.from + extra(level + 1)))) {
            ++level;
        }
        wanted[p] = options.from + extra(level);
    }
    return wanted;
}

View cast_adaptive_view(const RayScene& scene, const FacetSet& facets, const Observer& observer,
                        std::span<const Appearance> appearances, const AdaptiveOptions& options,
                        const ViewOptions& view_options, std::optional<View> first) {
    const std::string where = "observer " + observer.name;
    if (options.from < 2 || options.to < options.from || options.to > 4096 ||
        !(options.tolerance > 0.0)) {
        throw InputError(where,
                         fmt::format("adaptive from {} to {} samples, tolerance {:g} K: expected 2 "
                                     "<= from <= to <= 4096 and a tolerance above 0",
                                     options.from, options.to, options.tolerance));
    }
    for (const Appearance& appearance : appearances) {
        if (appearance.facet.size() != facets.size()) {
            throw InputError(where, fmt::format("an appearance has {} entries for {} facets",
                                                appearance.facet.size(), facets.size()));
        }
    }
    ViewOptions round = view_options;
    round.samples = options.from;
    View view = first ? std::move(*first) : cast_view(scene, facets, observer, round);
    const std::vector<double> of_one = variance_of_one(view, appearances, options.from);
    const std::vector<int> wanted = samples_wanted(of_one, options);
    view.samples.resize(view.pixels());
    for (std::size_t p = 0; p < wanted.size(); ++p) {
        view.samples[p] = in_one_round(options.from, wanted[p] - options.from);
    }
    for (int level = 1; options.from + extra(level) <= options.to; ++level) {
        std::vector<std::uint8_t> asked(view.pixels());
        std::vector<float> share(view.pixels(), 0.0f);
        const float of_more = static_cast<float>(
            1.0 / (1.0 + std::pow(double(options.from) / double(extra(level)), 1.5)));
        bool any = false;
        for (std::size_t p = 0; p < asked.size(); ++p) {
            asked[p] = wanted[p] == options.from + extra(level);
            if (asked[p]) share[p] = of_more;
            any = any || asked[p];
        }
        if (!any) continue;
        round.samples = extra(level);
        round.seed = view_options.seed + golden_step * std::uint64_t(level);
        round.asked = asked;
        add_view(view, cast_view(scene, facets, observer, round), share);
    }
    return view;
}

}  // namespace diurna
