#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scenes/job/warnings/scene_warnings.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/class_raster.hpp"

namespace diurna {

namespace {

constexpr double no_share = 1e-3, nearly_all = 0.99;  // of the ground
constexpr std::size_t most_classes_listed = 6;

/// The ground's facets with a land cover's class at each, and their plan areas.
struct ClassesOnGround {
    std::vector<std::int32_t> of_facet;
    std::map<std::int32_t, double> unmapped{};  // share of the ground, of classes left over
    double covered = 0.0;                       // share of the ground with a class
};

std::string percent(double share) {
    return share >= 0.995 ? "100 %" : fmt::format("{:.2g} %", 100.0 * share);
}

/// "10 (50 %), 20 (4 %) and 3 more", the largest first.
std::string listed_classes(const std::map<std::int32_t, double>& share) {
    std::vector<std::pair<double, std::int32_t>> order;
    for (const auto& [number, part] : share) order.emplace_back(-part, number);
    std::sort(order.begin(), order.end());
    std::string text;
    for (std::size_t i = 0; i < std::min(order.size(), most_classes_listed); ++i) {
        text +=
            fmt::format("{}{} ({})", i == 0 ? "" : ", ", order[i].second, percent(-order[i].first));
    }
    if (order.size() > most_classes_listed) {
        text += fmt::format(" and {} more", order.size() - most_classes_listed);
    }
    return text;
}

/// Keys of a table whose class is nowhere on the ground.
std::string keys_not_found(const LandCoverInput& input, const ClassesOnGround& classes) {
    std::vector<std::int32_t> found = classes.of_facet;
    std::sort(found.begin(), found.end());
    std::string text;
    for (const auto& [number, material] : input.material) {
        if (std::binary_search(found.begin(), found.end(), number)) continue;
        text += (text.empty() ? "" : ", ") + std::to_string(number);
    }
    return text;
}

/// Classes that are not in the table and lie nearly always between two others: numbers that an
/// interpolation between classes makes. Of large rasters some rows.
std::map<std::int32_t, double> mixed_classes(const ClassRaster& raster,
                                             const LandCoverInput& input) {
    constexpr double cells_read = 2e6, mostly = 0.9;
    struct Count {
        double cells = 0.0, between = 0.0;
    };
    std::map<std::int32_t, Count> count;
    const auto at = [&](int row, int column) {
        return raster.value[std::size_t(row) * std::size_t(raster.columns) + std::size_t(column)];
    };
    const double cells = double(raster.columns) * raster.rows;
    const int stride = std::max(1, static_cast<int>(cells / cells_read));
    for (int row = 1; row + 1 < raster.rows; row += stride) {
        for (int column = 1; column + 1 < raster.columns; ++column) {
            const std::int32_t c = at(row, column);
            if (c == no_class || input.material.contains(c)) continue;
            const auto between = [&](std::int32_t a, std::int32_t b) {
                return a != b && a != no_class && b != no_class && std::min(a, b) <= c &&
                       c <= std::max(a, b);
            };
            Count& of_class = count[c];
            ++of_class.cells;
            of_class.between += between(at(row, column - 1), at(row, column + 1)) ||
                                between(at(row - 1, column), at(row + 1, column));
        }
    }
    std::map<std::int32_t, double> mixed;
    for (const auto& [number, of_class] : count) {
        if (of_class.between >= mostly * of_class.cells) mixed[number] = of_class.cells;
    }
    return mixed;
}

Mistake cover_warning(const LandCoverInput& input, const ClassesOnGround& classes) {
    std::string problem = fmt::format("covers {} of the ground", percent(classes.covered));
    if (!classes.unmapped.empty()) {
        problem += "; classes without a material: " + listed_classes(classes.unmapped);
    }
    if (const std::string keys = keys_not_found(input, classes); !keys.empty()) {
        problem += "; classes of its table that are not on the ground: " + keys;
    }
    problem += "; the rules and terrain.material are used there";
    return {input.file.string(), problem,
            classes.covered < no_share
                ? "check its CRS, site.latitude_deg and site.longitude_deg"
                : "check the class numbers in terrain.land_cover.material and the raster's extent"};
}

}  // namespace

std::vector<Mistake> land_cover_warnings(const Prepared& prepared) {
    constexpr std::size_t many_mixed = 4;
    const std::vector<LandCoverInput>& inputs = prepared.scene.terrain.land_cover;
    if (inputs.empty()) return {};
    const FacetSet& facets = prepared.world.facets;
    std::vector<Geodetic> place;
    std::vector<double> share;
    double whole = 0.0;
    for (std::size_t f = 0; f < prepared.world.ground_facets; ++f) {
        place.push_back(to_geodetic(prepared.world.site, facets.centroid[f].cast<double>()));
        share.push_back(double{facets.area[f]} * double{facets.normal[f].z()});
        whole += share.back();
    }
    std::vector<Mistake> warnings;
    std::vector<ClassesOnGround> all;
    std::vector<std::uint8_t> has_material(place.size()), has_class(place.size());
    for (const LandCoverInput& input : inputs) {
        const ClassRaster raster = read_class_raster(input.file, prepared.scene.confines);
        if (const auto mixed = mixed_classes(raster, input); mixed.size() >= many_mixed) {
            warnings.push_back(
                {input.file.string(),
                 fmt::format("{} classes from {} to {} lie only between other classes and are not "
                             "in its table: class numbers were interpolated",
                             mixed.size(), mixed.begin()->first, mixed.rbegin()->first),
                 "resample classes with gdalwarp -r near or -r mode"});
        }
        ClassesOnGround& classes = all.emplace_back(classes_at(raster, place));
        for (std::size_t f = 0; f < place.size(); ++f) {
            if (classes.of_facet[f] == no_class) continue;
            classes.covered += share[f] / whole;
            has_class[f] = 1;
            has_material[f] |= std::uint8_t{input.material.contains(classes.of_facet[f])};
        }
    }
    double bare = 0.0;  // ground without a class of any table
    for (std::size_t f = 0; f < place.size(); ++f) bare += has_class[f] ? 0.0 : share[f] / whole;
    for (std::size_t i = 0; i < all.size(); ++i) {
        double unmapped = 0.0;
        for (std::size_t f = 0; f < place.size(); ++f) {
            if (all[i].of_facet[f] == no_class || has_material[f] != 0) continue;
            all[i].unmapped[all[i].of_facet[f]] += share[f] / whole;
            unmapped += share[f] / whole;
        }
        const bool lacks_ground =
            all[i].covered < no_share || (all[i].covered < nearly_all && bare > 1.0 - nearly_all);
        if (lacks_ground || unmapped > no_share)
            warnings.push_back(cover_warning(inputs[i], all[i]));
    }
    return warnings;
}

}  // namespace diurna
