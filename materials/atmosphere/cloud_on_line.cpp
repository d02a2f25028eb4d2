#include "materials/atmosphere/cloud_on_line.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

constexpr double flattest_cosine = 0.02;

/// A part of a segment, by shares of it.
void add_part(const SightLine& line, std::size_t segment, double from, double to, SightLine& part) {
    part.height_km.push_back(line.height_within(segment, 0.5 * (from + to)));
    part.length_km.push_back(line.length_km[segment] * (to - from));
    if (part.edge_km.empty()) part.edge_km.push_back(line.height_within(segment, from));
    part.edge_km.push_back(line.height_within(segment, to));
}

bool has_cloud(const CloudLayer& cloud) { return cloud.fraction > 0.0 || cloud.over_sun() > 0.0; }

}  // namespace

bool below_cloud(const BandModel& model, double height_km) {
    return !has_cloud(model.cloud) || height_km < model.cloud.top_km();
}

std::optional<CloudCrossing> cloud_crossing(const BandModel& model, const SightLine& line,
                                            std::size_t begin) {
    const CloudLayer& cloud = model.cloud;
    if (!has_cloud(cloud) || line.size() == 0) return std::nullopt;
    const double base = cloud.base_km, top = cloud.top_km();
    const double start = line.height_within(0, 0.0);
    const bool within = begin == 0 && start >= base && start < top;
    // One height for where a segment ends and the next begins, so that no crossing falls between.
    const auto edge = [&](std::size_t i) {
        if (!line.edge_km.empty()) return line.edge_km[i];
        return i == 0 ? start : line.height_within(i - 1, 1.0);
    };
    for (std::size_t i = begin; i < line.size(); ++i) {
        const double near = edge(i), far = edge(i + 1);
        const double up_at = within ? top : base, down_at = within ? base : top;
        double at = 0.0;
        if (near < up_at && far >= up_at) {
            at = up_at;
        } else if (near >= down_at && far < down_at) {
            at = down_at;
        } else {
            continue;
        }
        CloudCrossing crossing{.segment = i, .share = (at - near) / (far - near), .height_km = at};
        crossing.cosine =
            std::clamp(std::abs(far - near) / line.length_km[i], flattest_cosine, 1.0);
        crossing.temperature = cloud.temperature > 0.0
                                   ? cloud.temperature
                                   : pressure_and_temperature_at(model.profile, at).second;
        return crossing;
    }
    return std::nullopt;
}

SightLine line_before(const SightLine& line, const CloudCrossing& crossing) {
    SightLine part = line.first(crossing.segment);
    if (line.edge_km.empty()) part.edge_km.clear();
    if (crossing.share > 0.0) {
        if (part.edge_km.empty() && part.size() > 0) {  // ends unknown: they are found
            part.edge_km.push_back(line.height_within(0, 0.0));
            for (std::size_t i = 0; i < part.size(); ++i) {
                part.edge_km.push_back(line.height_within(i, 1.0));
            }
        }
        add_part(line, crossing.segment, 0.0, crossing.share, part);
    }
    return part;
}

SightLine line_behind(const SightLine& line, const CloudCrossing& crossing) {
    SightLine part;
    if (crossing.share < 1.0) add_part(line, crossing.segment, crossing.share, 1.0, part);
    for (std::size_t i = crossing.segment + 1; i < line.size(); ++i) {
        add_part(line, i, 0.0, 1.0, part);
    }
    return part;
}

double hidden_share(const CloudLayer& cloud, const CloudCrossing& crossing, double wavelength_um) {
    if (wavelength_um >= drops_scatter_um) return cloud.fraction * cloud.emissivity;
    return cloud.over_sun() * -std::expm1(-cloud.optical_depth / crossing.cosine);
}

std::vector<double> through_clouds(const BandModel& model, const SightLine& line,
                                   std::span<const double> node_um) {
    std::vector<double> through(node_um.size(), 1.0);
    auto crossing = cloud_crossing(model, line);
    while (crossing) {
        for (std::size_t i = 0; i < node_um.size(); ++i) {
            through[i] *= 1.0 - hidden_share(model.cloud, *crossing, node_um[i]);
        }
        crossing = cloud_crossing(model, line, crossing->segment + 1);
    }
    return through;
}

}  // namespace diurna
