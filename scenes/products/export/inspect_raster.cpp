#include <fmt/format.h>

#include "materials/base/confines.hpp"
#include "materials/base/error.hpp"
#include "scenes/products/export/inspect.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/height_unit.hpp"
#include "terrain/raster/raster_facts.hpp"
#include "terrain/raster/read_dem.hpp"

namespace diurna {

namespace {

/// What only elevation has. Throws InputError where it is none.
void add_elevation(const std::filesystem::path& file, const Confines& confines, Found& found) {
    const Dem dem = read_dem(file, {.voids = VoidPolicy::leave, .confines = confines});
    const Geodetic centre = dem_centre(dem);
    const Eigen::Vector2d posting = post_spacing(dem);
    found.kind = "elevation raster";
    found.fact.push_back({"posting_m", {posting.x(), posting.y()}});
    found.fact.push_back({"centre_latitude_deg", {centre.latitude_deg}});
    found.fact.push_back({"centre_longitude_deg", {centre.longitude_deg}});
    found.fact.push_back({"centre_height_m", {centre.height}});
    found.fact.push_back({"voids", {static_cast<long long>(dem.voids)}});
    if (!dem.warnings.empty()) {
        found.fact.push_back({"warnings", {}});
        for (const Mistake& one : dem.warnings) found.fact.back().value.push_back(one.line());
    }
    if (!dem.notes.empty()) {
        found.fact.push_back({"notes", {dem.notes.begin(), dem.notes.end()}});
    }
    found.next = fmt::format("diurna new FOLDER --dem {}", file.string());
}

/// Whether the file does not say that it holds another thing, as our own do.
bool may_be_elevation(const RasterFacts& facts) {
    if (facts.band.empty()) return true;  // variables of netCDF, one of which may be
    const BandFacts& band = facts.band.front();
    const bool one = facts.band.size() == 1 || (facts.band.size() == 2 && facts.band[1].alpha);
    return one && !facts.crs.empty() && band.unit != "K" && band.name != "sky view";
}

}  // namespace

Found inspect_raster(const std::filesystem::path& file, const InspectOptions& options) {
    const Confines confines = confines_of(file, options.allow_outside);
    const RasterFacts facts = read_raster_facts(file, confines);
    const bool several = facts.band.empty() && !facts.variable.empty();
    Found found{.kind = several ? "rasters" : facts.crs.empty() ? "picture" : "raster"};
    found.fact = {{"format", {facts.driver}}};
    if (several) {
        found.fact.push_back({"variables", {facts.variable.begin(), facts.variable.end()}});
    } else {
        found.fact.push_back({"columns", {static_cast<long long>(facts.columns)}});
        found.fact.push_back({"rows", {static_cast<long long>(facts.rows)}});
        found.fact.push_back({"crs", {facts.crs.empty() ? std::string("none") : facts.crs}});
    }
    if (facts.transform) {
        const GeoTransform& t = *facts.transform;
        found.fact.push_back({"upper_left", {t[0], t[3]}});
        found.fact.push_back({"pixel", {t[1], t[5]}});
        if (t[2] != 0.0 || t[4] != 0.0) found.fact.push_back({"turned_by", {t[2], t[4]}});
        if (!facts.unit.empty()) found.fact.push_back({"map_unit", {facts.unit}});
    }
    FoundTable bands{
        "bands", {"band", "unit", "type", "no_data", "least", "most", "mean", "valid_px"}, {}};
    for (const BandFacts& band : facts.band) {
        const FoundValue none =
            band.no_data ? FoundValue(fmt::format("{:g}", *band.no_data)) : FoundValue("none");
        bands.row.push_back(
            {band.name, band.unit, band.type, none, band.least, band.most, band.mean, band.valid});
    }
    if (facts.band.size() < static_cast<std::size_t>(facts.bands)) {
        found.fact.push_back({"bands_in_all", {static_cast<long long>(facts.bands)}});
    }
    if (!several) found.table.push_back(std::move(bands));
    if (may_be_elevation(facts)) {
        try {
            add_elevation(file, confines, found);
        } catch (const InputError& error) {
            const std::string& problem = error.mistakes().front().problem;
            const bool heights = !facts.band.empty() && height_unit(facts.band.front().unit);
            found.fact.push_back({heights ? "warnings" : "not_elevation_because",
                                  {heights ? "not readable as elevation: " + problem : problem}});
        }
    }
    return found;
}

}  // namespace diurna
