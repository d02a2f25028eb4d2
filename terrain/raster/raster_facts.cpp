#include "terrain/raster/raster_facts.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/base/error.hpp"
#include "terrain/raster/band_mask.hpp"
#include "terrain/raster/gdal_file.hpp"
#include "terrain/raster/raster_reference.hpp"

namespace diurna {

namespace {

constexpr double most_values = 1e9;
BandFacts facts_of(GDALRasterBand& band, const std::string& where, const QuietGdal& gdal) {
    BandFacts facts{.name = band.GetDescription(),
                    .unit = band.GetUnitType(),
                    .type = GDALGetDataTypeName(band.GetRasterDataType()),
                    .no_data = std::nullopt};
    int declared = 0;
    const double no_data = band.GetNoDataValue(&declared);
    if (declared) facts.no_data = no_data;
    facts.least = std::numeric_limits<double>::infinity();
    facts.most = -facts.least;
    double sum = 0.0;
    std::vector<double> row(static_cast<std::size_t>(band.GetXSize()));
    std::vector<std::uint8_t> valid(row.size());
    BandMask mask(band, where);
    facts.alpha = band.GetColorInterpretation() == GCI_AlphaBand;
    for (int y = 0; y < band.GetYSize(); ++y) {
        if (band.RasterIO(GF_Read, 0, y, band.GetXSize(), 1, row.data(), band.GetXSize(), 1,
                          GDT_Float64, 0, 0) != CE_None) {
            throw InputError(where, "cannot be read" + gdal.because());
        }
        mask.read(0, y, valid);
        for (std::size_t x = 0; x < row.size(); ++x) {
            const double v = row[x];
            if (!std::isfinite(v) || (declared && v == no_data) || valid[x] == 0) continue;
            facts.least = std::min(facts.least, v);
            facts.most = std::max(facts.most, v);
            sum += v;
            ++facts.valid;
        }
    }
    facts.mean = sum / static_cast<double>(facts.valid);
    if (facts.valid == 0) facts.least = facts.most = std::nan("");
    return facts;
}

/// Of netCDF with several variables: "elevation (21x21, 32-bit floating-point)".
std::vector<std::string> variables_of(GDALDataset& data) {
    std::vector<std::string> variables;
    CSLConstList list = data.GetMetadata("SUBDATASETS");
    for (int i = 1;; ++i) {
        const char* name = CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_NAME", i).c_str());
        const char* says = CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_DESC", i).c_str());
        if (name == nullptr) return variables;
        const std::string full = name;
        variables.push_back(full.substr(full.find_last_of(":/") + 1) +
                            (says != nullptr ? fmt::format(": {}", says) : ""));
    }
}

}  // namespace

RasterFacts read_raster_facts(const std::filesystem::path& file,
                              const std::optional<Confines>& confines) {
    const QuietGdal gdal;
    const GdalGate gate(confines ? *confines : confines_of(file));
    const std::string where = file.string();
    const auto data = open_gdal_file(file, GdalUse::facts, gdal, gate);
    RasterFacts facts{.driver = data->GetDriverName(),
                      .columns = data->GetRasterXSize(),
                      .rows = data->GetRasterYSize(),
                      .bands = data->GetRasterCount(),
                      .band = {},
                      .transform = std::nullopt,
                      .crs = "",
                      .unit = "",
                      .variable = variables_of(*data)};
    const double pixels = double(facts.columns) * facts.rows;
    double bytes = 0.0;
    for (GDALRasterBand* band : data->GetBands()) {
        bytes += pixels * GDALGetDataTypeSizeBytes(band->GetRasterDataType());
    }
    constexpr double small = 1e6;  // pictures of one colour may be packed better
    if (pixels * data->GetRasterCount() > most_values || claims_too_much(bytes - small, file)) {
        throw InputError(where, fmt::format("declares {} bands of {} x {}, but has only {} bytes",
                                            data->GetRasterCount(), facts.columns, facts.rows,
                                            std::filesystem::file_size(file)));
    }
    GeoTransform transform{};
    if (data->GetGeoTransform(transform.data()) == CE_None) facts.transform = transform;
    if (const auto crs = raster_reference(*data, file)) {
        facts.crs = crs->GetName() != nullptr ? crs->GetName() : "unnamed";
        if (const char* code = crs->GetAuthorityCode(nullptr)) {
            facts.crs += fmt::format(" ({}:{})", crs->GetAuthorityName(nullptr), code);
        }
        const char* unit = nullptr;
        crs->IsGeographic() ? crs->GetAngularUnits(&unit) : crs->GetLinearUnits(&unit);
        facts.unit = unit != nullptr ? unit : "";
    }
    for (GDALRasterBand* band : data->GetBands()) {
        if (facts.band.size() == most_bands_described) break;
        facts.band.push_back(facts_of(*band, where, gdal));
    }
    gate.check();
    return facts;
}

}  // namespace diurna
