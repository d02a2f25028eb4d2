#include "scenes/job/input/scene_places.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/job/input/sea_height.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/named_crs.hpp"

namespace diurna {

namespace {

constexpr double furthest_place = 1e6;  // [m] from the site
constexpr const char* crs_says =
    "CRS of the places of this table that are not in metres: EPSG:32616, ...; [latitude, "
    "longitude] for geographic ones, [easting, northing] for projected ones";
constexpr const char* crs_of_all_says =
    "CRS of all places that are not in metres and have no CRS of their own: EPSG:32616, ...";
constexpr const char* wgs84_said = "WGS84: [latitude, longitude]";

/// Whether what is read while it lives is a mistake of a section that had none: of what it would
/// lead to, nothing more is to be reported.
class Watched {
 public:
    explicit Watched(const Section& section) : section_(section), before_(section.has_mistakes()) {}
    bool went_wrong() const { return !before_ && section_.has_mistakes(); }

 private:
    const Section& section_;
    bool before_;
};

/// A name that PROJ knows, else "" and a mistake.
std::string crs_under(const Section& section, const char* says, const Or<std::string>& fallback) {
    const std::string crs = section.text_or("place_crs", says, fallback);
    if (!section.has("place_crs") || is_crs(crs)) return crs;
    section.mistake(
        "place_crs",
        fmt::format("found \"{}\", not a horizontal coordinate reference system known to PROJ",
                    crs),
        "for example \"EPSG:32616\", UTM zone 16 north");
    return "";
}

}  // namespace

struct ScenePlaces::State {
    Section site_section, terrain_section;
    std::optional<Site> origin;
    ElevationInput input;
    std::string crs{};  // of all places without one of their own
    std::shared_ptr<const Dem> dem{};
    std::optional<SceneFrame> frame{};
    bool tried = false;

    /// The frame, for the first place that needs it; none after a mistake, which is reported once.
    const SceneFrame* found() {
        if (tried) return frame ? &*frame : nullptr;
        tried = true;
        if (input.file.empty()) return nullptr;  // reported already
        try {
            dem = std::make_shared<const Dem>(read_elevation(input));
            frame = frame_of(origin, input, *dem, site_section.where());
        } catch (const InputError& error) {
            const Mistake& first = error.mistakes().front();
            terrain_section.mistake("elevation", first.where + ": " + first.problem, first.hint);
        }
        return frame ? &*frame : nullptr;
    }

    double height_of(const Geodetic& at, const HeightInput& height) const {
        if (height.over == HeightOver::ellipsoid) return height.metres;
        if (height.over == HeightOver::sea) return height.metres + sea_at(*frame, at);
        const double ground = height_at(*dem, at.latitude_deg, at.longitude_deg);
        return height.metres + (std::isnan(ground) ? frame->site.height : ground);
    }

    /// Of a place of the map; a mistake for none or one far away.
    Eigen::Vector2d local(const Section& section, const char* key, Geodetic at,
                          const HeightInput& height) {
        const SceneFrame* here = found();
        if (here == nullptr || std::isnan(at.latitude_deg)) return Eigen::Vector2d::Zero();
        at.height = height_of(at, height);
        const Eigen::Vector3d place = to_local(here->site, at);
        if (place.norm() <= furthest_place) return place.head<2>();
        section.mistake(
            key,
            fmt::format(
                "latitude {:.5g}, longitude {:.5g} is {:.0f} km from the site at {:.5g}, {:.5g}",
                at.latitude_deg, at.longitude_deg, 1e-3 * place.norm(), here->site.latitude_deg,
                here->site.longitude_deg),
            "latitude comes before longitude, easting before northing");
        return Eigen::Vector2d::Zero();
    }
};

ScenePlaces::ScenePlaces(const Section& site, const Section& terrain, std::optional<Site> origin,
                         ElevationInput elevation)
    : state_(std::make_shared<State>(State{.site_section = site,
                                           .terrain_section = terrain,
                                           .origin = origin,
                                           .input = std::move(elevation)})) {
    state_->crs = crs_under(site, crs_of_all_says, {"", wgs84_said});
}

std::vector<Geodetic> ScenePlaces::geodetic(const Section& section, const char* mapped,
                                            const std::vector<std::vector<double>>& rows) const {
    const Watched watched(section);
    const std::string crs = crs_under(section, crs_says, {state_->crs, "that of [site]"});
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (watched.went_wrong()) return {rows.size(), Geodetic{none, none, 0.0}};
    std::vector<Eigen::Vector2d> given;
    for (const std::vector<double>& row : rows) given.emplace_back(row[0], row[1]);
    std::vector<Geodetic> places = geodetic_of(crs, given);
    bool reported = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool sound =
            std::abs(places[i].latitude_deg) <= 90.0 && std::abs(places[i].longitude_deg) <= 360.0;
        if (sound) continue;
        places[i] = {none, none, 0.0};
        if (std::exchange(reported, true)) continue;
        const std::string found =
            fmt::format("found [{:.10g}, {:.10g}]", given[i].x(), given[i].y());
        if (crs.empty()) {
            section.mistake(mapped, found + ", expected [latitude, longitude] in degrees",
                            "use place_crs = \"EPSG:...\" for other coordinates");
        } else {
            section.mistake(mapped, fmt::format("{} is not a place that {} covers", found, crs));
        }
    }
    return places;
}

std::vector<Eigen::Vector2d> ScenePlaces::all(const Section& section, const char* mapped,
                                              const std::vector<std::vector<double>>& rows) const {
    const Watched watched(section);
    std::vector<Eigen::Vector2d> places;
    for (const Geodetic& at : geodetic(section, mapped, rows)) {
        places.push_back(state_->local(section, mapped, at, {}));
        if (watched.went_wrong()) return {rows.size(), Eigen::Vector2d::Zero()};
    }
    return places;
}

Eigen::Vector2d ScenePlaces::one(const Section& section, const PlaceKeys& keys, const char* says,
                                 const HeightInput& height) const {
    const std::string in_metres = fmt::format("[east, north] {}", says);
    if (!section.has(keys.mapped)) {
        const std::vector<double> at = section.numbers(keys.metres, in_metres.c_str(), 2);
        return {at[0], at[1]};
    }
    if (section.has(keys.metres)) {
        section.mistake(keys.metres, fmt::format("cannot be combined with {}", keys.mapped));
    }
    const std::string on_map =
        fmt::format("[latitude, longitude] instead of {}, or in the CRS of place_crs", keys.metres);
    const Watched watched(section);
    const std::vector<double> at = section.numbers(keys.mapped, on_map.c_str(), 2);
    const bool wrong = watched.went_wrong();
    if (wrong) {
        section.text_or("place_crs", crs_says, "");  // what it is meant for is not lost on it
        return Eigen::Vector2d::Zero();
    }
    return state_->local(section, keys.mapped, geodetic(section, keys.mapped, {at}).front(),
                         height);
}

Eigen::Vector2d ScenePlaces::at(const Section& section, const char* key, const Geodetic& place,
                                const HeightInput& height) const {
    return state_->local(section, key, place, height);
}

std::shared_ptr<const Dem> ScenePlaces::elevation() const { return state_->dem; }

}  // namespace diurna
