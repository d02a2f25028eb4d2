#include "scenes/job/run/recommended.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

constexpr double aim = 0.9;           // of the tolerance
constexpr double least_share = 0.05;  // parts below it remain as they are
constexpr double most_sky_rays = 4096.0, most_sun_samples = 256.0, most_finer_edges = 16.0;

/// A part and the setting that reduces it.
struct ReducedPart {
    Recommended setting;
    double square, now, most;  // [K²]; the key's value, and its limit
    bool rays = true;          // otherwise the divisor of edges

    /// The value with which the part is 1/factor of what it is, or a little less: numbers of rays
    /// are powers of two, divisors have one decimal.
    double divided_by(double factor) const {
        const double wanted = now * factor;
        return std::min(most, rays ? std::exp2(std::ceil(std::log2(wanted) - 1e-9))
                                   : std::ceil(10.0 * wanted - 1e-9) / 10.0);
    }
    /// [K²] what is left of it at a value.
    double left_at(double value) const { return square * now / value; }
};

}  // namespace

std::vector<Recommended> recommended_settings(const ErrorParts& parts, const Scene& scene,
                                              double tolerance) {
    const double all = parts.all(), allowed = aim * aim * tolerance * tolerance;
    if (!(tolerance > 0.0) || !(all > allowed)) return {};
    std::vector<ReducedPart> of{{{"scene.sky_rays", 0.0, "rays of the ground"},
                                 parts.ground_rays,
                                 double(scene.sky_rays),
                                 most_sky_rays},
                                {{"scene.object_sky_rays", 0.0, "rays of buildings and objects"},
                                 parts.object_rays,
                                 double(scene.object_sky_rays),
                                 most_sky_rays},
                                {{"scene.sun_samples", 0.0, "rays to the sun"},
                                 parts.sun_rays,
                                 double(scene.sun_samples),
                                 most_sun_samples},
                                {{"scene.finer_edges", 0.0, "size of facets"},
                                 parts.size,
                                 scene.finer_edges,
                                 most_finer_edges,
                                 false}};
    std::erase_if(of, [&](const ReducedPart& part) {
        return part.square < least_share * all || part.now >= part.most;
    });
    std::stable_sort(of.begin(), of.end(), [](const ReducedPart& a, const ReducedPart& b) {
        return a.square > b.square;
    });
    std::vector<Recommended> chosen;
    const auto choose = [&](const ReducedPart& part, double factor) {
        chosen.push_back(part.setting);
        chosen.back().value = part.divided_by(factor);
        chosen.back().share = part.square / all;
        return part.left_at(chosen.back().value);
    };
    if (of.empty()) return {};
    const double others = all - of.front().square;
    if (others < 0.5 * allowed) {
        if (choose(of.front(), of.front().square / (allowed - others)) + others <= allowed) {
            return chosen;
        }
        chosen.clear();
    }
    double small = all;  // of parts that remain as they are
    for (const ReducedPart& part : of) small -= part.square;
    const double factor = (all - small) / std::max(allowed - small, 0.25 * allowed);
    for (const ReducedPart& part : of) choose(part, factor);
    return chosen;
}

std::string in_words(const std::vector<Recommended>& settings) {
    std::vector<std::string> words;
    for (const Recommended& one : settings) {
        words.push_back(fmt::format("{} = {:.4g} ({}, {:.0f} % of the mean square)", one.key,
                                    one.value, one.part, 100.0 * one.share));
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace diurna
