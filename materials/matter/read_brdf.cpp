#include "materials/matter/read_brdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr std::size_t merl_half = 90, merl_difference = 90, merl_azimuth = 180, merl_colours = 3;

/// Scales of red, green and blue in MERL's files.
constexpr std::array<double, merl_colours> merl_scale = {1.0 / 1500.0, 1.15 / 1500.0,
                                                         1.66 / 1500.0};

MeasuredBrdf read_merl(const std::filesystem::path& path) {
    constexpr std::size_t nodes = merl_half * merl_difference * merl_azimuth;
    constexpr std::size_t head = 3 * sizeof(std::int32_t),
                          whole = head + merl_colours * nodes * sizeof(double);
    const std::string bytes = read_text(path);
    std::array<std::int32_t, 3> size{};
    if (bytes.size() >= head) std::memcpy(size.data(), bytes.data(), head);
    if (size != std::array<std::int32_t, 3>{merl_half, merl_difference, merl_azimuth}) {
        throw InputError(path.string(), "is not a MERL BRDF: expected 90, 90 and 180 at its start");
    }
    if (bytes.size() != whole) {
        throw InputError(path.string(), fmt::format("found {} bytes, expected {} for a MERL BRDF",
                                                    bytes.size(), whole));
    }
    MeasuredBrdf table{.axes = MeasuredBrdf::Axes::half_vector,
                       .first = {},
                       .second = {},
                       .third = {},
                       .value = std::vector<float>(nodes, 0.0f)};
    // A value holds for its cell: it stands at the cell's middle.
    for (std::size_t i = 0; i < merl_half; ++i) {
        const double middle = double(i) + 0.5;
        table.first.push_back(middle * middle / double(merl_half));
        table.second.push_back(middle);
    }
    for (std::size_t i = 0; i < merl_azimuth; ++i) table.third.push_back(double(i) + 0.5);
    for (std::size_t colour = 0; colour < merl_colours; ++colour) {
        for (std::size_t i = 0; i < nodes; ++i) {
            double value = 0.0;
            std::memcpy(&value, bytes.data() + head + (colour * nodes + i) * sizeof value,
                        sizeof value);
            if (std::isfinite(value) && value > 0.0) {
                table.value[i] +=
                    static_cast<float>(value * merl_scale[colour] / double{merl_colours});
            }
        }
    }
    return table;
}

std::vector<double> ascending(std::vector<double> all) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

std::size_t node_of(const std::vector<double>& axis, double x) {
    return static_cast<std::size_t>(std::lower_bound(axis.begin(), axis.end(), x) - axis.begin());
}

MeasuredBrdf read_table(const std::filesystem::path& path) {
    const CsvTable csv = read_csv(path);
    const std::array<std::size_t, 4> column = {csv.column("light_deg"), csv.column("eye_deg"),
                                               csv.column("azimuth_deg"), csv.column("brdf_sr")};
    std::array<std::vector<double>, 4> read;
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        for (std::size_t c = 0; c < 4; ++c) {
            const double value = csv.number(row, column[c]);
            const double most = c < 2 ? 90.0 : c == 2 ? 180.0 : 1e6;
            check_within(csv.where(row, column[c]), value, 0.0, most);
            read[c].push_back(value);
        }
    }
    MeasuredBrdf table{.axes = MeasuredBrdf::Axes::directions,
                       .first = ascending(read[0]),
                       .second = ascending(read[1]),
                       .third = ascending(read[2]),
                       .value = {}};
    const std::size_t nodes = table.first.size() * table.second.size() * table.third.size();
    if (nodes < 8 || table.first.size() < 2 || table.second.size() < 2 || table.third.size() < 2) {
        throw InputError(path.string(), "expected at least two angles of light, eye and azimuth");
    }
    table.value.assign(nodes, -1.0f);
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        float& at = table.value[(node_of(table.first, read[0][row]) * table.second.size() +
                                 node_of(table.second, read[1][row])) *
                                    table.third.size() +
                                node_of(table.third, read[2][row])];
        if (at >= 0.0f) throw InputError(csv.where(row, column[0]), "these angles occur twice");
        at = static_cast<float>(read[3][row]);
    }
    const auto gap = std::find(table.value.begin(), table.value.end(), -1.0f);
    if (gap != table.value.end()) {
        const auto i = static_cast<std::size_t>(gap - table.value.begin());
        const std::size_t third = table.third.size(), second = table.second.size();
        throw InputError(path.string(),
                         fmt::format("no row of light {:g}, eye {:g}, azimuth {:g}",
                                     table.first[i / third / second],
                                     table.second[i / third % second], table.third[i % third]));
    }
    return table;
}

Eigen::Vector3d towards(double angle_deg, double azimuth_deg) {
    const double angle = radians(angle_deg), azimuth = radians(azimuth_deg);
    return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
            std::cos(angle)};
}

/// Light and eye may change places (Helmholtz).
void check_reciprocal(const std::filesystem::path& path, const MeasuredBrdf& table) {
    double mean = 0.0;
    for (const float value : table.value) mean += double{value} / double(table.value.size());
    for (double light = 5.0; light < 75.0; light += 10.0) {
        for (double eye = light + 10.0; eye < 80.0; eye += 10.0) {
            for (const double azimuth : {0.0, 60.0, 120.0, 180.0}) {
                const double one = brdf(table, towards(eye, azimuth), towards(light, 0.0));
                const double other = brdf(table, towards(light, azimuth), towards(eye, 0.0));
                if (std::abs(one - other) <= 0.1 * std::max(one, other) + 0.01 * mean) continue;
                throw InputError(
                    path.string(),
                    fmt::format("not reciprocal: {:.4g} per sr for light at {:g}, eye at {:g}, "
                                "azimuth {:g} deg, but {:.4g} with light and eye exchanged",
                                one, light, eye, azimuth, other));
            }
        }
    }
}

void check_energy(const std::filesystem::path& path, const MeasuredBrdf& table) {
    for (double angle = 0.0; angle <= 75.0; angle += 15.0) {
        const double reflected = directional_hemispherical(table, std::cos(radians(angle)));
        if (reflected <= 1.01 && reflected > 0.0) continue;
        throw InputError(
            path.string(),
            fmt::format(
                "reflects {:.4g} of the light at {:g} deg, expected more than 0 and at most 1",
                reflected, angle));
    }
}

}  // namespace

MeasuredBrdf read_brdf(const std::filesystem::path& path) {
    const bool merl = path.extension() == ".binary";
    if (!merl && path.extension() != ".csv") {
        throw InputError(path.string(), "expected a .binary (MERL) or a .csv file");
    }
    MeasuredBrdf table = merl ? read_merl(path) : read_table(path);
    if (!merl) check_reciprocal(path, table);
    check_energy(path, table);
    return table;
}

}  // namespace diurna
