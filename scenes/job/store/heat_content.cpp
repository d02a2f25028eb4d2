#include "scenes/job/store/heat_content.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenes/job/store/digest.hpp"
#include "scenes/job/store/key_facts.hpp"
#include "scenes/job/store/stage_keys.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/measured_albedo.hpp"
#include "scenes/job/world/stepping.hpp"
#include "scenes/job/world/targets.hpp"
#include "terrain/place/sun_path.hpp"
#include "thermal/weather/repeated_day.hpp"
#include "thermal/weather/sky_by_height.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

namespace {

/// Adds values of every kind that the heat balance takes. The members of a struct are listed by
/// structured bindings, so that a member added later stops the compiler until it is added here.
class HeatFacts {
 public:
    explicit HeatFacts(KeyFacts& facts) : facts_(facts) {}

    template <class... T>
    void all(const T&... values) {
        (add(values), ...);
    }

    template <class T>
    requires std::is_arithmetic_v<T>
    void add(T value) { facts_.number(value); }
    template <class T>
    requires std::is_enum_v<T>
    void add(T value) { facts_.number(static_cast<long>(value)); }
    void add(Instant when) { add(seconds_between(Instant{}, when)); }
    void add(const std::vector<double>& values) { numbers(std::span(values)); }
    template <class T>
    void add(const std::vector<T>& values) {
        add(values.size());
        for (const T& value : values) add(value);
    }
    template <class T, std::size_t n>
    void add(const std::array<T, n>& values) {
        for (const T& value : values) add(value);
    }
    template <class T>
    void add(const std::optional<T>& value) {
        add(value.has_value());
        if (value) add(*value);
    }
    template <class... T>
    void add(const std::variant<T...>& value) {
        add(value.index());
        std::visit([this](const auto& one) { add(one); }, value);
    }
    void add(std::monostate) {}

    // Columns.
    void add(const Constant&) {}
    void add(const Radiating& x) {
        const auto& [cubic, heat] = x;
        all(cubic, heat);
    }
    void add(const Freezing& x) {
        const auto& [water, conductivity, capacity] = x;
        all(water, conductivity, capacity);
    }
    void add(const Melting& x) {
        const auto& [held] = x;
        add(held);
    }
    void add(const Layer& x) {
        const auto& [thickness, conductivity, density, capacity, law] = x;
        all(thickness, conductivity, density, capacity, law);
    }
    void add(const FixedTemperature& x) {
        const auto& [temperature] = x;
        add(temperature);
    }
    void add(const FixedFlux& x) {
        const auto& [flux] = x;
        add(flux);
    }
    void add(const Interior& x) {
        const auto& [temperature, film, schedule] = x;
        all(temperature, film, schedule);
    }
    void add(const ColumnGrid& x) {
        const auto& [depth, capacity, conductance, below, flux] = x;
        all(depth, capacity, conductance, below, flux);
    }

    // Surfaces.
    void add(const Louis& x) {
        const auto& [least, gust] = x;
        all(least, gust);
    }
    void add(const Tarp& x) {
        const auto& [length, roughness] = x;
        all(length, roughness);
    }
    void add(const Mowitt& x) {
        const auto& [roughness] = x;
        add(roughness);
    }
    void add(const ConstantFilm& x) {
        const auto& [film] = x;
        add(film);
    }
    void add(const BodyFilm& x) {
        const auto& [shape, length, transition] = x;
        all(shape, length, transition);
    }
    void add(const Flight& x) {
        const auto& [speed, length] = x;
        all(speed, length);
    }
    void add(const Evaporation& x) {
        const auto& [resistance, wetness] = x;
        all(resistance, wetness);
    }
    void add(const WaterStore& x) {
        const auto& [capacity, albedo, leaves] = x;
        all(capacity, albedo, leaves);
    }
    void add(const AgeingAlbedo& x) {
        const auto& [fresh, old] = x;
        all(fresh, old);
    }
    void add(const BigLeaf& x) {
        const auto& [conductance] = x;
        add(conductance);
    }
    void add(const TwoSource& x) {
        const auto& [area, resistance] = x;
        all(area, resistance);
    }
    void add(const ExposedBack& x) {
        const auto& [emissivity, albedo] = x;
        all(emissivity, albedo);
    }
    void add(const ThermalSurface& x) {
        const auto& [albedo, transmittance, emissivity, roughness, heat_roughness, convection,
                     flight, evaporation, store, snow, canopy, internal, schedule, layers, bottom,
                     back] = x;
        all(albedo, transmittance, emissivity, roughness, heat_roughness, convection, flight,
            evaporation, store, snow, canopy, internal, schedule, layers, bottom, back);
    }

    // Targets.
    void add(const ClockHours::Window& x) {
        const auto& [from, to, share, day] = x;
        all(from, to, share, day);
    }
    void add(const ClockHours& x) {
        const auto& [window, offset] = x;
        all(window, offset);
    }
    void add(const NetworkColumn& x) {
        const auto& [grid, spread] = x;
        all(grid, spread);
    }
    void add(const NetworkFacet& x) {
        const auto& [column, area, sideways, edge, lump, film, radiant, contact, open] = x;
        all(column, area, sideways, edge, lump, film, radiant, contact, open);
    }
    void add(const HeatTouch& x) {
        const auto& [facet, edge, conductance] = x;
        all(facet, edge, conductance);
    }
    void add(const HeatLump& x) {
        const auto& [capacity, fixed] = x;
        all(capacity, fixed);
    }
    void add(const HeatLink& x) {
        const auto& [a, b, conductance] = x;
        all(a, b, conductance);
    }
    void add(const HeatStream& x) {
        const auto& [from, to, conductance] = x;
        all(from, to, conductance);
    }
    void add(const HeatNetwork& x) {
        const auto& [column, facet, edges, touch, lump, link, stream] = x;
        all(column, facet, edges, touch, lump, link, stream);
    }
    void add(const NetworkObject::Source& x) {
        const auto& [lump, facet, watts, hours] = x;
        all(lump, facet, watts, hours);
    }
    void add(const NetworkObject::Given& x) {
        const auto& [lump, kelvin, hours] = x;
        all(lump, kelvin, hours);
    }
    void add(const NetworkObject::Sunlit& x) {
        const auto& [pane, behind, transmittance] = x;
        all(pane, behind, transmittance);
    }
    void add(const NetworkObject::Jet::Face& x) {
        const auto& [facet, back, film, heat] = x;
        all(facet, back, film, heat);
    }
    void add(const NetworkObject::Jet& x) {
        const auto& [kelvin, lump, hours, face] = x;
        all(kelvin, lump, hours, face);
    }
    void add(const NetworkObject& x) {
        const auto& [name, network, facet, back, inner, source, given, sunlit, jet, notes,
                     loose_edges] = x;
        all(network, facet, back, inner, source, given, sunlit, jet);
    }

    // Air and sky.
    void add(const AirState& x) {
        const auto& [temperature, pressure, vapour] = x;
        all(temperature, pressure, vapour);
    }
    void add(const DiffuseSplit& x) {
        const auto& [circumsolar, horizon, uneven, by_air] = x;
        all(circumsolar, horizon, uneven, by_air);
    }
    void add(const SkyState& x) {
        const auto& [sun, to_sun, beam, diffuse, split, longwave, tilted, albedo, on_facet,
                     by_height, when] = x;
        all(sun.elevation_deg, sun.distance_au, to_sun.x(), to_sun.y(), to_sun.z(), beam, diffuse,
            split, longwave, tilted, albedo, on_facet);
    }

 private:
    template <class T>
    void numbers(std::span<const T> values) {
        add(values.size());
        for (const T value : values) add(value);
    }

    KeyFacts& facts_;
};

/// (facet of surfaces()) its material as a rank among those in use, and each of these.
void add_surfaces(const Prepared& prepared, HeatFacts& facts) {
    const World& world = prepared.world;
    const FacetSet& surfaces = world.surfaces();
    const std::set<MaterialId> used(surfaces.material.begin(), surfaces.material.end());
    std::vector<std::uint32_t> rank(prepared.scene.materials.size(), 0);
    std::uint32_t next = 0;
    for (const MaterialId id : used) rank[index(id)] = next++;
    facts.add(surfaces.size());
    for (std::size_t f = 0; f < surfaces.size(); ++f) {
        facts.add(rank[index(surfaces.material[f])]);
        if (!world.texture_levels.empty()) {
            facts.add(world.texture_levels.origin[f]);
            facts.add(surfaces.area[f]);
        }
    }
    const MeasuredAlbedo measured = measured_albedo(prepared.scene, world, prepared.weather);
    for (const MaterialId id : used) {
        facts.add(prepared.scene.materials[id].thermal);
        if (!measured.share.empty()) facts.add(measured.share[index(id)]);
    }
    facts.add(targets(world, prepared.scene));
}

/// The samples between which everything but sunlight and longwave is linear.
void add_air(const Prepared& prepared, HeatFacts& facts) {
    const Weather& weather = prepared.weather;
    facts.all(weather.wind_height, weather.air_height, weather.height, weather.span);
    facts.add(weather.sample.size());
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        const Forcing& now = weather.sample[i];
        facts.all(weather.instant[i], now.air, now.wind_speed, now.rain_mm_h);
    }
}

/// The sky at every step that the span and the days before it may take, and at three heights of the
/// scene where it differs between them.
void add_sky(const Prepared& prepared, const SpanOptions& span, HeatFacts& facts) {
    const World& world = prepared.world;
    const Weather& weather = prepared.weather;
    const double before = seconds_of_day * std::max(1, span.days_before);
    const Instant known = later(weather.instant.front(), -seconds_of_day);
    const Instant from = std::max(later(span.start, -before), std::min(known, span.start));
    const Instant to = std::max(span.end, later(span.start, seconds_of_day));
    const ClearSky& clear = prepared.scene.sky;
    const SkySeries series(weather, world.site, weather.height, clear, from, to);
    const AirByHeight rule = air_by_height(prepared.scene, weather);
    const HeightSpan heights = heights_of_surfaces(world);
    const bool level = rule.same_everywhere() && weather.by_height == nullptr;
    SunPath path(world.site);
    for (Instant when = from; when <= to; when = later(when, span.day.step)) {
        const SkyState sky = series.at(when, path.at(when));
        facts.add(sky);
        for (const double share : {0.0, 0.5, 1.0}) {
            if (level) break;
            const double height = std::lerp(heights.low, heights.high, share);
            const Forcing now = series.weather().at(when);
            const AirState air = air_at_height(rule, now.air, height);
            facts.all(air, sky_at_height(sky, now, air, rule, height, clear));
        }
    }
}

}  // namespace

std::string heat_content(const Prepared& prepared) {
    const Scene& scene = prepared.scene;
    KeyFacts key("heat content");
    key.line(visibility_key(prepared));
    HeatFacts facts(key);
    const Site& site = prepared.world.site;
    facts.all(site.latitude_deg, site.longitude_deg, site.height, site.refraction,
              prepared.world.sea_level_height, scene.time.utc_offset);
    const SpanOptions span = scene_span(scene);
    facts.all(span.day.step, span.start, span.end, span.begin, span.days_before, span.heat,
              span.goes_on);
    if (span.begin == SpanStart::state) key.line(sha256_of_file(scene.time.state));
    add_surfaces(prepared, facts);
    add_air(prepared, facts);
    add_sky(prepared, span, facts);
    return key.digest();
}

}  // namespace diurna
