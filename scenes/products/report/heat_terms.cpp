#include "scenes/products/report/heat_terms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "scenes/charts/chart_figure.hpp"
#include "scenes/charts/curves.hpp"
#include "scenes/charts/facet_groups.hpp"
#include "scenes/charts/html.hpp"
#include "scenes/charts/time_axis.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_charts = 24;

struct TermLine {
    const char *name, *colour;
};
/// (term) as a page calls them.
constexpr std::array<TermLine, heat_terms> lines{{{"absorbed sunlight", "#c98a00"},
                                                  {"absorbed longwave", "#d62728"},
                                                  {"released heat", "#7b1fa2"},
                                                  {"emitted longwave", "#1f5fa8"},
                                                  {"sensible heat", "#17a2b8"},
                                                  {"latent heat", "#4c9f38"},
                                                  {"melting", "#7a7a7a"},
                                                  {"conduction", "#8c564b"}}};

/// (term) (instant) [W m⁻²], positive towards the surface.
using TermMeans = std::array<std::vector<double>, heat_terms>;

/// Whose balance is reported: each object, then the parts of those that have several.
std::vector<FacetGroup> reported_groups(const Prepared& prepared) {
    std::vector<FacetGroup> groups = object_groups(prepared);
    for (ObjectParts& object : part_groups(prepared)) {
        for (FacetGroup& part : object.part) {
            groups.push_back({object.object + ": " + part.name, std::move(part.facet)});
        }
    }
    return groups;
}

/// (group); empty where the file has no terms. One term after the other, each as large as the
/// temperatures.
std::vector<TermMeans> read_means(const std::filesystem::path& file, const TemperatureField& field,
                                  const std::vector<FacetGroup>& groups,
                                  const std::vector<float>& area) {
    std::vector<TermMeans> means(groups.size());
    for (std::size_t k = 0; k < heat_terms; ++k) {
        const std::vector<float> watts = load_heat_term(file, static_cast<HeatTerm>(k), field);
        if (watts.empty()) return {};
        const double sign = k < heat_sources ? 1.0 : -1.0;
        for (TermMeans& of : means) of[k].resize(field.instant.size());
        for_each_index(
            field.instant.size(),
            [&](std::size_t i) {
                const std::span<const float> row{watts.data() + i * field.facets, field.facets};
                for (std::size_t g = 0; g < groups.size(); ++g) {
                    means[g][k][i] = sign * area_mean(groups[g], area, row);
                }
            },
            1);
    }
    return means;
}

std::string terms_chart(const std::string& name, const TermMeans& means, const TimeAxis& axis,
                        const std::vector<double>& x) {
    constexpr double least = 0.05;  // [W m⁻²] what is never more is skipped, and reported
    Chart chart{.title = name,
                .x_title = axis.title,
                .y_title = "W/m² towards the surface",
                .x_last = axis.hours,
                .lines = {},
                .height = 340,
                .ticks = axis.ticks};
    std::string absent;
    std::vector<double> sum(x.size(), 0.0);
    for (std::size_t k = 0; k < heat_terms; ++k) {
        double most = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            sum[i] += means[k][i];
            most = std::max(most, std::abs(means[k][i]));
        }
        if (most < least) {
            absent += (absent.empty() ? "" : ", ") + std::string(lines[k].name);
            continue;
        }
        chart.lines.push_back(
            {.name = lines[k].name, .colour = lines[k].colour, .x = x, .y = means[k]});
    }
    double worst = 0.0;
    for (const double left : sum) worst = std::max(worst, std::abs(left));
    return chart_figure(chart) +
           fmt::format("<p class=\"key\">{}The terms add up to zero within {:.1g} W/m².</p>\n",
                       absent.empty() ? "" : "Not shown, below 0.05 W/m²: " + absent + ". ", worst);
}

}  // namespace

std::string heat_terms_of_day(const std::filesystem::path& folder, const Prepared& prepared,
                              const TemperatureField& field) {
    const std::filesystem::path file = folder / "temperatures.nc";
    if (!std::filesystem::exists(file)) return "";  // temperatures were given
    std::vector<FacetGroup> groups = reported_groups(prepared);
    const std::size_t all = groups.size();
    groups.resize(std::min(all, most_charts));
    const std::vector<TermMeans> means =
        read_means(file, field, groups, prepared.world.surfaces().area);
    if (means.empty()) return "";
    const TimeAxis axis =
        time_axis(field.instant.front(), field.instant.back(), prepared.scene.time.utc_offset);
    std::vector<double> x;
    for (const Instant when : field.instant) x.push_back(axis.x(when));
    std::string out =
        "<h2>Heat balance over the day</h2>\n<p class=\"key\">Mean over area, per square metre of "
        "the facets' front sides; positive terms heat the surface. Conduction is the heat flow to "
        "the layers below, with their storage; released heat is produced at the surface itself. "
        "Faces in contact exchange no radiation or convection; conduction through a contact is not "
        "shown.</p>\n";
    for (std::size_t g = 0; g < groups.size(); ++g) {
        out += terms_chart(groups[g].name, means[g], axis, x);
    }
    if (all > groups.size()) {
        out += fmt::format(
            "<p class=\"key\">The first {} of {} objects and parts; temperatures.nc contains all "
            "facets.</p>\n",
            groups.size(), all);
    }
    return out;
}

}  // namespace diurna
