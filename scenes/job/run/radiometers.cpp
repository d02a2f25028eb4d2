#include "scenes/job/run/radiometers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "materials/base/files.hpp"
#include "materials/matter/passed_light.hpp"
#include "scenes/job/world/border_ground.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/measured_albedo.hpp"
#include "scenes/job/world/stepping.hpp"
#include "terrain/place/local_time.hpp"
#include "terrain/place/sun_path.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/receiver_views.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "thermal/received_light.hpp"
#include "thermal/solve/solve_input.hpp"
#include "thermal/weather/sky_by_height.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

namespace {

/// The ways that six receivers face, in the order of mean_radiant_temperature().
struct ReceiverFace {
    const char* name;
    Eigen::Vector3d normal;
};
const std::array<ReceiverFace, 6>& six_faces() {
    static const std::array<ReceiverFace, 6> ways = {
        ReceiverFace{"down", {0, 0, 1}},  // falls from above
        ReceiverFace{"up", {0, 0, -1}},   // comes from below
        ReceiverFace{"from_north", {0, 1, 0}},  ReceiverFace{"from_east", {1, 0, 0}},
        ReceiverFace{"from_south", {0, -1, 0}}, ReceiverFace{"from_west", {-1, 0, 0}}};
    return ways;
}

/// A view of facets as one of the surfaces on them.
FacetViews on_levels(const TextureLevels& levels, FacetViews views) {
    if (!levels.empty()) views.others = levels_seen(levels, views.others);
    return views;
}

/// A radiometer in one stage of the scene.
struct StageView {
    FacetViews heat;
    std::optional<FacetViews> sunlight;  // where panes let other light pass than heat
    const FacetViews& of_sunlight() const { return sunlight ? *sunlight : heat; }
};

StageView stage_view(const Prepared& stage, const std::vector<Receiver>& receivers) {
    ReceiverViewOptions options{.ground_facets = stage.world.ground_facets,
                                .seed = stage.scene.seed};
    const auto seen = [&] {
        return on_levels(stage.world.texture_levels,
                         receiver_views(receivers, stage.world.facets, stage.rays, options));
    };
    StageView view{.heat = seen(), .sunlight = {}};
    if (passes_by_spectrum(passed_light(stage.scene.materials))) {
        options.sunlight = true;
        view.sunlight = seen();
    }
    return view;
}

/// What the ground goes on as beyond the raster: (facet) shares of the outline.
std::vector<float> ground_beyond(const World& world) {
    std::vector<float> weight;
    const std::optional<BorderGround> border = border_ground(world, world.surfaces());
    if (!border) return weight;
    weight.assign(world.surfaces().size(), 0.0f);
    float length = 0.0f;
    for (const BorderFacet& facet : border->facet) length += facet.length;
    for (const BorderFacet& facet : border->facet) weight[facet.facet] += facet.length / length;
    return weight;
}

/// The heat balance's sky at any instant, over a height above the sea.
class SkyOver {
 public:
    explicit SkyOver(const Prepared& prepared)
        : prepared_(prepared),
          rule_(air_by_height(prepared.scene, prepared.weather)),
          path_(prepared.world.site),
          series_(prepared.weather, prepared.world.site, prepared.weather.height,
                  prepared.scene.sky, prepared.scene.time.start, prepared.scene.time.end()) {}

    SkyState at(Instant when, double height) {
        const SkyState sky = series_.at(when, path_.at(when));
        if (rule_.same_everywhere()) return sky;
        const Forcing now = series_.weather().at(when);
        return sky_at_height(sky, now, air_at_height(rule_, now.air, height), rule_, height,
                             prepared_.scene.sky);
    }

 private:
    const Prepared& prepared_;
    AirByHeight rule_;
    SunPath path_;
    SkySeries series_;
};

/// The least and the greatest of a series.
struct Extremes {
    double least = 1e9, greatest = -1e9;
    void add(double value) {
        least = std::min(least, value);
        greatest = std::max(greatest, value);
    }
};

/// One radiometer's rows as they are found.
struct Readings {
    const PlacedRadiometer& radiometer;
    std::vector<Receiver> receivers;
    FacetSet facets;
    double height;                 // [m] above the sea
    std::vector<StageView> stage;  // filled when a stage is first needed
    fmt::memory_buffer csv{};
    Extremes shortwave{}, longwave{}, radiant{};  // on the first receiver; of all six
};

Readings begin_readings(const PlacedRadiometer& radiometer, const World& world) {
    std::vector<Receiver> receivers;
    Readings readings{.radiometer = radiometer,
                      .receivers = {},
                      .facets = {},
                      .height = height_above_sea(world, radiometer.place),
                      .stage = {}};
    const auto out = std::back_inserter(readings.csv);
    fmt::format_to(out, "time");
    if (radiometer.input.normal) {
        receivers.push_back({radiometer.place, *radiometer.input.normal});
        fmt::format_to(out,
                       ",shortwave_W_m2,longwave_W_m2,sun_W_m2,sky_W_m2,reflected_W_m2,"
                       "sky_longwave_W_m2,sun_in_view\n");
    } else {
        for (const ReceiverFace& face : six_faces())
            receivers.push_back({radiometer.place, face.normal});
        for (const char* kind : {"shortwave", "longwave"}) {
            for (const ReceiverFace& face : six_faces())
                fmt::format_to(out, ",{}_{}_W_m2", kind, face.name);
        }
        fmt::format_to(out, ",mean_radiant_temperature_K,sun_in_view\n");
    }
    readings.facets = receiver_facets(receivers);
    readings.receivers = std::move(receivers);
    return readings;
}

/// The share of the sun's disc that a place sees, what lets light through included.
double sun_in_view(const Readings& readings, const Prepared& stage, const SkyState& sky) {
    if (!(sky.to_sun.z() > 0.0)) return 0.0;
    const Receiver to_sun{readings.radiometer.place, sky.to_sun};
    float share = 0.0f;
    sun_fraction(receiver_facets({&to_sun, 1}), stage.rays, sky.to_sun, {&share, 1},
                 {.samples = 64, .seed = stage.scene.seed});
    return double{share};
}

void add_row(Readings& readings, const Prepared& stage, const StageView& view,
             std::span<const float> beyond, const SkyState& sky, const LeavingLight& leaving,
             const std::string& time) {
    const double disc = sun_in_view(readings, stage, sky);
    std::array<double, 6> shortwave{}, longwave{};
    ReceivedLight light;
    for (std::size_t r = 0; r < readings.receivers.size(); ++r) {
        const double seen = std::max(0.0, readings.receivers[r].normal.dot(sky.to_sun)) * disc;
        light = received_light({view.heat, view.of_sunlight(), beyond}, r, seen, sky, leaving);
        shortwave[r] = light.shortwave();
        longwave[r] = light.longwave();
    }
    readings.shortwave.add(shortwave.front());
    readings.longwave.add(longwave.front());
    const auto out = std::back_inserter(readings.csv);
    fmt::format_to(out, "{}", time);
    if (readings.radiometer.input.normal) {
        for (const double watts : {light.shortwave(), light.longwave(), light.sun, light.sky,
                                   light.reflected, light.sky_longwave}) {
            fmt::format_to(out, ",{:.3f}", watts);
        }
    } else {
        for (const double watts : shortwave) fmt::format_to(out, ",{:.3f}", watts);
        for (const double watts : longwave) fmt::format_to(out, ",{:.3f}", watts);
        const double radiant = mean_radiant_temperature(shortwave, longwave);
        readings.radiant.add(radiant);
        fmt::format_to(out, ",{:.3f}", radiant);
    }
    fmt::format_to(out, ",{:.4f}\n", disc);
}

/// The albedo that was measured at an instant: (material); empty where none was.
std::vector<double> measured_at(const SkyState& sky, const MeasuredAlbedo& measured) {
    std::vector<double> albedo;
    if (std::isnan(sky.albedo)) return albedo;
    for (const double share : measured.share) albedo.push_back(measured_albedo(sky, share));
    return albedo;
}

/// What a radiometer received, for the report.
std::string ranges(const Readings& readings) {
    const char* const way = readings.radiometer.input.normal ? "" : " down";
    std::string text =
        fmt::format("shortwave{} {:.0f} to {:.0f} W/m2, longwave{} {:.0f} to {:.0f} W/m2", way,
                    readings.shortwave.least, readings.shortwave.greatest, way,
                    readings.longwave.least, readings.longwave.greatest);
    if (!readings.radiometer.input.normal) {
        text += fmt::format(", mean radiant temperature {:.1f} to {:.1f} K", readings.radiant.least,
                            readings.radiant.greatest);
    }
    return text;
}

/// What of a radiometer's view is not modelled, if that is much.
std::string view_note(const Readings& readings) {
    constexpr double much = 0.01;
    double hidden = 0.0;
    for (const StageView& view : readings.stage) {
        for (const float share : view.heat.hidden) hidden = std::max(hidden, double{share});
    }
    if (hidden < much) return "";
    return fmt::format(
        "radiometer \"{}\": up to {:.0f} % of a receiver's view is blocked by thin bodies around "
        "it; that share gets the mean radiance of the rest",
        readings.radiometer.input.name, 100.0 * hidden);
}

}  // namespace

std::vector<std::string> radiometer_files(const Scene& scene) {
    std::vector<std::string> files;
    for (const RadiometerInput& radiometer : scene.radiometers) {
        files.push_back("radiometer_" + radiometer.name + ".csv");
    }
    return files;
}

void write_radiometers(const Stages& stages, const SpanResult& result,
                       const std::filesystem::path& folder, HeatReport& report) {
    const Prepared& prepared = stages.scene();
    std::vector<Readings> all;
    for (const PlacedRadiometer& radiometer : prepared.radiometers) {
        all.push_back(begin_readings(radiometer, prepared.world));
    }
    if (all.empty()) return;
    const MeasuredAlbedo measured =
        measured_albedo(prepared.scene, prepared.world, prepared.weather);
    const std::vector<float> beyond = ground_beyond(prepared.world);
    SkyOver sky_over(prepared);
    const std::vector<Instant>& kept = result.temperature.instant;
    for (const Instant when : scene_steps(prepared.scene)) {
        const auto at = std::lower_bound(kept.begin(), kept.end(), when);
        const std::size_t number = prepared.movement.none() ? 0 : prepared.movement.stage_of(when);
        const Prepared& stage = stages.at(number).prepared;
        const std::vector<double> albedo =
            measured_at(sky_over.at(when, prepared.weather.height), measured);
        const LeavingLight leaving =
            leaving_light(prepared.world.surfaces(), prepared.scene.materials, result.temperature,
                          result.heat, std::size_t(at - kept.begin()), albedo);
        const std::string time = format_local(when, prepared.scene.time.utc_offset);
        for (Readings& readings : all) {
            while (readings.stage.size() <= number) {
                const SceneStage next = stages.at(readings.stage.size());
                readings.stage.push_back(stage_view(next.prepared, readings.receivers));
            }
            add_row(readings, stage, readings.stage[number], beyond,
                    sky_over.at(when, readings.height), leaving, time);
        }
    }
    const std::vector<std::string> files = radiometer_files(prepared.scene);
    for (std::size_t i = 0; i < all.size(); ++i) {
        write_whole_file(folder / files[i], std::string_view(all[i].csv.data(), all[i].csv.size()));
        report.rows.emplace_back("radiometer " + all[i].radiometer.input.name,
                                 fmt::format("{}; {}", ranges(all[i]), files[i]));
        if (std::string note = view_note(all[i]); !note.empty()) {
            report.notes.push_back(std::move(note));
        }
    }
}

}  // namespace diurna
