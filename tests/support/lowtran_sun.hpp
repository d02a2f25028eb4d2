#pragma once

#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/files.hpp"
#include "tests/support/lowtran_rows.hpp"

/// LOWTRAN7's scattered sunlight and its repetition here.
namespace lowtran {

/// A little-endian float array of two dimensions (numpy's format, version 1).
struct Array {
    std::size_t rows = 0, columns = 0;
    std::vector<float> value;
    const float* row(std::size_t i) const { return value.data() + i * columns; }
};
inline Array read_npy(const std::filesystem::path& file) {
    const std::string text = read_text(file);
    Array array;
    const std::size_t header =
        10 + static_cast<unsigned char>(text[8]) + 256u * static_cast<unsigned char>(text[9]);
    const std::size_t shape = text.find("'shape': (") + 10;
    array.rows = std::stoul(text.substr(shape));
    const std::size_t comma = text.find(',', shape);
    array.columns = text[comma + 1] == ')' ? 1 : std::stoul(text.substr(comma + 1));
    array.value.resize(array.rows * array.columns);
    std::memcpy(array.value.data(), text.data() + header, array.value.size() * sizeof(float));
    return array;
}

struct SunRow {
    std::string profile, aerosol;
    double h1_km, view_zenith_deg, sun_zenith_deg, azimuth_deg, albedo;
    std::size_t index;  // in the arrays
};
inline std::vector<SunRow> sun_rows(const std::filesystem::path& file) {
    const CsvTable t = read_csv(file);
    std::vector<SunRow> rows;
    for (std::size_t i = 0; i < t.rows.size(); ++i) {
        const auto of = [&](const char* name) { return t.number(i, t.column(name)); };
        rows.push_back({.profile = t.rows[i][t.column("model")],
                        .aerosol = t.rows[i][t.column("aerosol")],
                        .h1_km = of("h1_km"),
                        .view_zenith_deg = of("view_zenith_deg"),
                        .sun_zenith_deg = of("sun_zenith_deg"),
                        .azimuth_deg = of("rel_az_deg"),
                        .albedo = of("albedo"),
                        .index = i});
    }
    return rows;
}

/// ∫ over a band of values per cm⁻¹ on the 20 cm⁻¹ grid from 2000 cm⁻¹ on, in W m⁻² sr⁻¹.
inline double integral(const float* per_cm, std::size_t count, const Range& range) {
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        const double nu = 2000.0 + 20.0 * double(k);
        if (nu >= 1e4 / range.to_um && nu <= 1e4 / range.from_um) sum += 20.0 * per_cm[k];
    }
    return 1e4 * sum;
}

/// Errors per range of scattered radiance; `which` are the ranges asked for.
inline std::map<std::string, Errors> compare_sun(const std::filesystem::path& folder,
                                                 const std::string& kind,
                                                 const std::vector<Range>& which,
                                                 bool print = false) {
    const Array total = read_npy(folder / (kind + "_total_f4.npy"));
    std::map<std::string, Errors> errors;
    for (const Range& range : which) {
        const Band band = range.band();
        std::map<std::string, SunField> fields;
        for (const SunRow& row : sun_rows(folder / (kind + "_index.csv"))) {
            const BandModel air = model_of(row.profile, row.aerosol);
            const std::string key = row.profile + row.aerosol + std::to_string(row.sun_zenith_deg);
            // Day 94: 4 April, 1.0004 AU.
            const auto field = fields
                                   .try_emplace(key, air,
                                                SunLight{.zenith_deg = row.sun_zenith_deg,
                                                         .distance_au = 1.0004,
                                                         .ground_albedo = row.albedo},
                                                band.node_um)
                                   .first;
            const double expected = integral(total.row(row.index), total.columns, range);
            const double found = band_sum_nodes(
                band, field->second.sky(row.h1_km, row.view_zenith_deg, row.azimuth_deg));
            errors[range.name].add(found, expected);
            if (print) {
                fmt::print("{} {} {} h {} view {} sun {} az {}: {:.4g} / {:.4g} = {:.3f}\n",
                           range.name, row.profile, row.aerosol, row.h1_km, row.view_zenith_deg,
                           row.sun_zenith_deg, row.azimuth_deg, found, expected, found / expected);
            }
        }
    }
    return errors;
}

}  // namespace lowtran
