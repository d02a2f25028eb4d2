#include "scenes/job/run/recommended.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

constexpr double aim = 0.9;           // of the tolerance
constexpr double least_share = 0.05;  // parts below it remain as they are
constexpr double most_sky_rays = 4096.0, most_sun_samples = 256.0;  // the keys' ranges

/// A part and the setting that reduces it.
struct ReducedPart {
    Recommended setting;
    double square, now, most;  // [K²]; the key's value, and its limit

    bool by_rays() const { return most > 0.0; }
    /// The value with which the part is 1/factor of what it is.
    double divided_by(double factor) const {
        if (!by_rays()) return now / factor;
        // Powers of two: the next one up.
        return std::min(most, std::exp2(std::ceil(std::log2(now * factor) - 1e-9)));
    }
    /// [K²] what is left of it at a value.
    double left_at(double value) const { return square * (by_rays() ? now / value : value / now); }
};

}  // namespace

std::vector<Recommended> recommended_settings(const ErrorParts& parts, const Scene& scene,
                                              double tolerance) {
    const double all = parts.all(), allowed = aim * aim * tolerance * tolerance;
    if (!(tolerance > 0.0) || !(all > allowed)) return {};
    std::vector<ReducedPart> of{
        {{"scene.sky_rays", 0.0, "rays of the ground"},
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
        {{"largest_edge_m", 0.0, "size of facets"}, parts.size, parts.edge, 0.0}};
    std::erase_if(of, [&](const ReducedPart& part) {
        const bool at_limit = part.by_rays() ? part.now >= part.most : !(part.now > 0.0);
        return part.square < least_share * all || at_limit;
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

std::string in_words(const std::vector<Recommended>& settings, const std::string& material) {
    std::vector<std::string> words;
    for (const Recommended& one : settings) {
        const bool edge = one.key == "largest_edge_m";
        words.push_back(fmt::format("{} = {:.4g}{} ({}, {:.0f} % of the mean square)", one.key,
                                    one.value, edge ? " on " + material : "", one.part,
                                    100.0 * one.share));
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace diurna
