#include "materials/radiation/band.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/quadrature.hpp"

namespace diurna {

namespace {

/// Planck's law varies as exp(−c₂/λT): over a piece of 0.01 µm⁻¹ λ² by the same factor at every
/// wavelength, at most e^0.6 at 250 K, which three points integrate to 1e-8. Towards the visible
/// only bodies above 1000 K shine, so pieces need not be shorter than 6 nm.
double longest_planck_piece(double wavelength_um) {
    return std::clamp(0.01 * wavelength_um * wavelength_um, 0.006, 0.25);
}

}  // namespace

double Band::width_um() const { return std::accumulate(weight.begin(), weight.end(), 0.0); }

Band response_band(std::string name, Spectrum response, std::span<const double> breakpoints_um,
                   int points_per_piece, double longest_piece_um) {
    assert(points_per_piece >= 1 && longest_piece_um > 0.0);
    if (response.value.size() < 2 || response.wavelength_um.front() < 0.2 ||
        response.wavelength_um.back() > 100.0) {
        throw InputError("band " + name, "a response needs at least two wavelengths in 0.2 to 100");
    }
    if (!(integral(response) > 0.0)) {
        throw InputError("band " + name, "the response is zero everywhere");
    }
    std::vector<double> edges = response.wavelength_um;
    for (const double edge : breakpoints_um) {
        if (edge > edges.front() && edge < response.wavelength_um.back()) edges.push_back(edge);
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());

    const Quadrature rule = gauss_legendre(points_per_piece);
    Band band{
        .name = std::move(name), .response = std::move(response), .node_um = {}, .weight = {}};
    for (std::size_t i = 1; i < edges.size(); ++i) {
        const double from = edges[i - 1], width = edges[i] - from;
        const double longest = std::min(longest_piece_um, longest_planck_piece(from));
        const int parts = std::max(1, static_cast<int>(std::ceil(width / longest - 1e-9)));
        for (int part = 0; part < parts; ++part) {
            const double half = 0.5 * width / parts;
            const double middle = from + half * (2 * part + 1);
            for (std::size_t k = 0; k < rule.size(); ++k) {
                const double node = middle + half * rule.node[k];
                band.node_um.push_back(node);
                band.weight.push_back(half * rule.weight[k] * band.response.at(node));
            }
        }
    }
    return band;
}

Band flat_band(std::string name, double from_um, double to_um,
               std::span<const double> breakpoints_um, int points_per_piece) {
    if (!(from_um >= 0.2 && to_um <= 100.0 && from_um < to_um)) {
        throw InputError("band " + name, fmt::format("found {:g} to {:g} µm, expected an ascending "
                                                     "range in 0.2 to 100",
                                                     from_um, to_um));
    }
    return response_band(std::move(name), flat_spectrum(1.0, from_um, to_um), breakpoints_um,
                         points_per_piece);
}

Spectrum read_response(const std::filesystem::path& path) {
    const CsvTable table = read_csv(path);
    const bool in_nm = table.has("wavelength_nm");
    const std::size_t wavelength = table.column(in_nm ? "wavelength_nm" : "wavelength_um");
    const std::size_t value = table.column("response");
    if (table.header.size() != 2) {
        throw InputError(path.string(),
                         fmt::format("found {} columns, expected 2: wavelength_um and response",
                                     table.header.size()));
    }
    Spectrum curve;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double um = table.number(row, wavelength) * (in_nm ? 1e-3 : 1.0);
        const double response = table.number(row, value);
        if (!(um >= 0.2 && um <= 100.0)) {
            throw InputError(
                table.where(row, wavelength), fmt::format("found {:g} µm, expected 0.2 to 100", um),
                um > 100.0 && !in_nm ? "for nanometres name the column wavelength_nm" : "");
        }
        if (row > 0 && !(um > curve.wavelength_um.back())) {
            throw InputError(table.where(row, wavelength),
                             fmt::format("found {:g} µm after {:g}, expected ascending wavelengths",
                                         um, curve.wavelength_um.back()));
        }
        if (!(response >= 0.0 && response <= 1.0)) {
            throw InputError(table.where(row, value),
                             fmt::format("found a response of {:g}, expected 0 to 1", response),
                             response > 1.0 ? "divide the responses by their maximum" : "");
        }
        curve.wavelength_um.push_back(um);
        curve.value.push_back(response);
    }
    std::size_t first = 0, last = curve.value.size();
    while (first + 1 < last && curve.value[first] == 0.0 && curve.value[first + 1] == 0.0) ++first;
    while (last > first + 1 && curve.value[last - 1] == 0.0 && curve.value[last - 2] == 0.0) --last;
    if (last - first < 2 || !(integral(curve) > 0.0)) {
        throw InputError(
            path.string(),
            "the response is zero everywhere, expected at least two points above zero");
    }
    const auto part = [&](std::vector<double>& all) {
        all = std::vector<double>(all.begin() + std::ptrdiff_t(first),
                                  all.begin() + std::ptrdiff_t(last));
    };
    part(curve.wavelength_um);
    part(curve.value);
    return curve;
}

std::vector<Band> channel_bands(double from_um, double to_um, int count,
                                std::span<const double> breakpoints_um) {
    assert(count > 0);
    std::vector<Band> bands;
    const double width = (to_um - from_um) / count;
    for (int i = 0; i < count; ++i) {
        const double low = from_um + width * i, high = i + 1 < count ? low + width : to_um;
        bands.push_back(
            flat_band(fmt::format("{:.6g}um", 0.5 * (low + high)), low, high, breakpoints_um));
    }
    return bands;
}

double band_sum_nodes(const Band& band, std::span<const double> per_node) {
    assert(per_node.size() == band.weight.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < per_node.size(); ++i) sum += band.weight[i] * per_node[i];
    return sum;
}

double band_mean_nodes(const Band& band, std::span<const double> per_node) {
    return band_sum_nodes(band, per_node) / band.width_um();
}

Band parse_band(const std::string& text, std::span<const double> breakpoints_um) {
    const std::size_t cut = text.find_first_of(":-");
    double from = 0.0, to = 0.0;
    if (cut == std::string::npos || !parse_number(std::string_view(text).substr(0, cut), from) ||
        !parse_number(std::string_view(text).substr(cut + 1), to)) {
        throw InputError("band", fmt::format("found '{}', expected FROM:TO in µm, such as 8:12",
                                             text.substr(0, 40)));
    }
    return flat_band(fmt::format("{}-{}", text.substr(0, cut), text.substr(cut + 1)), from, to,
                     breakpoints_um);
}

}  // namespace diurna
