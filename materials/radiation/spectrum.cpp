#include "materials/radiation/spectrum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"

namespace diurna {

double Spectrum::at(double wavelength) const {
    if (empty() || !(wavelength >= wavelength_um.front() && wavelength <= wavelength_um.back())) {
        return 0.0;
    }
    const auto above = std::upper_bound(wavelength_um.begin(), wavelength_um.end(), wavelength);
    if (above == wavelength_um.end()) return value.back();
    const auto i = static_cast<std::size_t>(above - wavelength_um.begin());
    const double t =
        (wavelength - wavelength_um[i - 1]) / (wavelength_um[i] - wavelength_um[i - 1]);
    return value[i - 1] + t * (value[i] - value[i - 1]);
}

double integral(const Spectrum& s) {
    double sum = 0.0;
    for (std::size_t i = 1; i < s.value.size(); ++i) {
        sum += 0.5 * (s.value[i] + s.value[i - 1]) * (s.wavelength_um[i] - s.wavelength_um[i - 1]);
    }
    return sum;
}

double integral(const Spectrum& s, double from_um, double to_um) {
    double sum = 0.0;
    for (std::size_t i = 1; i < s.value.size(); ++i) {
        const double from = std::max(from_um, s.wavelength_um[i - 1]);
        const double to = std::min(to_um, s.wavelength_um[i]);
        if (to > from) sum += (to - from) * s.at(0.5 * (from + to));
    }
    return sum;
}

double weighted_mean(const Spectrum& s, const Spectrum& weight) {
    if (s.empty() || weight.empty()) return 0.0;
    const double from = std::max(s.wavelength_um.front(), weight.wavelength_um.front());
    const double to = std::min(s.wavelength_um.back(), weight.wavelength_um.back());
    std::vector<double> grid;
    for (const Spectrum* one : {&s, &weight}) {
        for (const double wavelength : one->wavelength_um) {
            if (wavelength >= from && wavelength <= to) grid.push_back(wavelength);
        }
    }
    std::sort(grid.begin(), grid.end());
    double product = 0.0, total = 0.0;
    for (std::size_t i = 1; i < grid.size(); ++i) {
        const double a = grid[i - 1], c = grid[i], b = 0.5 * (a + c);
        const double wa = weight.at(a), wb = weight.at(b), wc = weight.at(c);
        product += (c - a) / 6.0 * (s.at(a) * wa + 4.0 * s.at(b) * wb + s.at(c) * wc);
        total += (c - a) * wb;
    }
    return total > 0.0 ? product / total : 0.0;
}

Spectrum flat_spectrum(double value, double from_um, double to_um) {
    assert(from_um < to_um);
    return {.wavelength_um = {from_um, to_um}, .value = {value, value}};
}

Spectrum read_spectrum(const std::filesystem::path& path, double least, double most) {
    CsvTable table = read_csv(path);
    const std::size_t wavelength = table.column("wavelength_um");
    if (table.header.size() != 2) {
        throw InputError(path.string(), fmt::format("found {} columns, expected 2: wavelength_um "
                                                    "and a value",
                                                    table.header.size()));
    }
    const std::size_t value = 1 - wavelength;
    if (table.rows.size() < 2) {
        throw InputError(path.string(),
                         fmt::format("found {} rows, expected at least 2", table.rows.size()));
    }
    // Spectrometers of the infrared write the longest wavelength first.
    if (table.number(0, wavelength) > table.number(table.rows.size() - 1, wavelength)) {
        std::reverse(table.rows.begin(), table.rows.end());
        std::reverse(table.line.begin(), table.line.end());
    }
    Spectrum s;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double x = table.number(row, wavelength);
        const double y = table.number(row, value);
        if (!(x > 0.0) || (row > 0 && !(x > s.wavelength_um.back()))) {
            throw InputError(
                table.where(row, wavelength),
                fmt::format(
                    "found wavelength {:g} µm, expected positive wavelengths, all ascending "
                    "or all descending",
                    x));
        }
        check_within(table.where(row, value) + ": " + table.header[value], y, least, most);
        s.wavelength_um.push_back(x);
        s.value.push_back(y);
    }
    return s;
}

std::string column_of_spectrum(const std::filesystem::path& path) {
    const CsvTable table = read_csv(path);
    return table.header.size() == 2 ? table.header[1 - table.column("wavelength_um")] : "";
}

}  // namespace diurna
