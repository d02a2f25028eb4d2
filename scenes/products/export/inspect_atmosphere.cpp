#include <fmt/format.h>

#include <algorithm>

#include "materials/air/igra.hpp"
#include "materials/air/radiosonde.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/modtran/tape7.hpp"
#include "scenes/products/export/inspect.hpp"

namespace diurna {

namespace {

const char* path_words(int path_type) {
    return path_type == 1 ? "level" : path_type == 2 ? "between heights" : "to space";
}

const char* emission_words(int emission) {
    switch (emission) {
        case 0:
            return "transmittance";
        case 1:
            return "thermal";
        case 2:
            return "thermal and scattered sun";
        default:
            return "direct sun";
    }
}

}  // namespace

Found inspect_tape7(const std::filesystem::path& file) {
    const std::vector<Tape7Run> runs = read_tape7(file);
    Found found{.kind = "tape7"};
    found.fact = {{"model", {runs.front().lowtran ? "LOWTRAN" : "MODTRAN"}},
                  {"runs", {static_cast<long long>(runs.size())}}};
    FoundTable paths{"paths",
                     {"path", "radiance", "h1_km", "h2_km", "zenith_deg", "range_km",
                      "first_per_cm", "last_per_cm", "rows", "columns"},
                     {}};
    constexpr std::size_t most_shown = 50;
    for (const Tape7Run& run : runs) {
        if (paths.row.size() == most_shown) break;
        paths.row.push_back({path_words(run.path_type), emission_words(run.emission), run.h1_km,
                             run.h2_km, run.zenith_deg, run.range_km, run.table.wavenumber.front(),
                             run.table.wavenumber.back(),
                             static_cast<long long>(run.table.wavenumber.size()),
                             fmt::format("{}", fmt::join(run.table.name, " "))});
    }
    found.table.push_back(std::move(paths));
    found.next = "use it as table in [atmosphere] of a scene, if it has runs of thermal radiance";
    return found;
}

Found inspect_igra(const std::filesystem::path& file) {
    const std::vector<std::string> times = igra_times(read_text(file));
    if (times.size() == 1) return inspect_sounding(file);
    Found found{.kind = "soundings"};
    found.fact = {{"format", {"IGRA v2"}},
                  {"soundings", {static_cast<long long>(times.size())}},
                  {"first", {times.front()}},
                  {"last", {times.back()}}};
    found.next = fmt::format(
        "use it as sounding in [atmosphere] of a scene, with sounding_time = \"{}\"", times.back());
    return found;
}

Found inspect_sounding(const std::filesystem::path& file) {
    const Sounding sounding = read_sounding(file);
    const Profile& sonde = sounding.profile;
    const std::size_t top = sounding.levels - 1;
    Found found{.kind = "sounding"};
    found.fact = {{"levels", {static_cast<long long>(sounding.levels)}},
                  {"lowest_height_m", {1e3 * sonde.height_km.front()}},
                  {"highest_height_m", {1e3 * sonde.height_km[top]}},
                  {"lowest_pressure_hPa", {sonde.pressure_hPa[top]}},
                  {"highest_pressure_hPa", {sonde.pressure_hPa.front()}},
                  {"ground_temperature_K", {sonde.temperature.front()}},
                  {"ground_vapour_pressure_hPa", {sample_of(sonde, 0).vapour_pressure_hPa()}}};
    const auto coldest = std::min_element(
        sonde.temperature.begin(), sonde.temperature.begin() + std::ptrdiff_t(sounding.levels));
    found.fact.push_back({"coldest_K", {*coldest}});
    if (!sonde.notes.empty()) {
        found.fact.push_back({"notes", {sonde.notes.begin(), sonde.notes.end()}});
    }
    found.next = fmt::format(
        "use it as sounding in [atmosphere] of a scene, or diurna path --profile {} ...",
        file.string());
    return found;
}

}  // namespace diurna
