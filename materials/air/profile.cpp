#include "materials/air/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "materials/base/csv.hpp"
#include "materials/base/data_folder.hpp"
#include "materials/base/error.hpp"
#include "materials/base/interval.hpp"

namespace diurna {

namespace {

constexpr std::array<const char*, gas_count> gas_columns = {"H2O", "CO2", "O3", "N2O",
                                                            "CO",  "CH4", "O2", "HNO3"};

const std::map<std::string, Profile>& afgl_table() {
    static const std::map<std::string, Profile> profiles = [] {
        const CsvTable table = read_csv(data_folder() / "atmosphere" / "afgl_profiles.csv");
        const std::size_t model = table.column("model");
        std::map<std::string, Profile> found;
        for (std::size_t row = 0; row < table.rows.size(); ++row) {
            Profile& profile = found[table.rows[row][model]];
            profile.name = table.rows[row][model];
            profile.height_km.push_back(table.number(row, table.column("z_km")));
            profile.pressure_hPa.push_back(table.number(row, table.column("P_hPa")));
            profile.temperature.push_back(table.number(row, table.column("T_K")));
            for (std::size_t gas = 0; gas < gas_count; ++gas) {
                profile.mixing_ratio_ppm[gas].push_back(
                    table.number(row, table.column(gas_columns[gas])));
            }
        }
        for (auto& [name, profile] : found) {
            profile.winter = name == "MLW" || name == "SAW";
            check(profile);
        }
        return found;
    }();
    return profiles;
}

}  // namespace

std::vector<std::string> afgl_profile_names() {
    return {"TROP", "MLS", "MLW", "SAS", "SAW", "US76"};
}

Profile afgl_profile(const std::string& name) {
    const auto& table = afgl_table();
    const auto found = table.find(name);
    if (found == table.end()) refuse_word("profile", name, afgl_profile_names());
    return found->second;
}

void check(const Profile& profile) {
    const std::string where = "profile " + profile.name;
    const std::size_t levels = profile.height_km.size();
    if (levels < 2)
        throw InputError(where, fmt::format("found {} levels, expected at least 2", levels));
    const auto same_length = [&](const std::vector<double>& v) { return v.size() == levels; };
    if (!same_length(profile.pressure_hPa) || !same_length(profile.temperature) ||
        !std::all_of(profile.mixing_ratio_ppm.begin(), profile.mixing_ratio_ppm.end(),
                     same_length)) {
        throw InputError(where, "the columns differ in length");
    }
    for (std::size_t i = 0; i < levels; ++i) {
        const std::string at =
            fmt::format("{}, level {} ({:g} km)", where, i, profile.height_km[i]);
        if (!std::isfinite(profile.height_km[i]) ||
            (i > 0 && !(profile.height_km[i] > profile.height_km[i - 1]))) {
            throw InputError(at, "heights must ascend");
        }
        if (!(profile.pressure_hPa[i] > 0.0 && profile.pressure_hPa[i] < 1200.0)) {
            throw InputError(at, fmt::format("found {:g} hPa, expected a pressure of 0 to 1200",
                                             profile.pressure_hPa[i]));
        }
        if (!(profile.temperature[i] >= 50.0 && profile.temperature[i] <= 1500.0)) {
            throw InputError(at, fmt::format("found {:g} K, expected a temperature of 50 to 1500",
                                             profile.temperature[i]));
        }
        for (std::size_t gas = 0; gas < gas_count; ++gas) {
            const double ratio = profile.mixing_ratio_ppm[gas][i];
            if (!(ratio >= 0.0 && ratio <= 1e6)) {
                throw InputError(at, fmt::format("found {:g} ppm of {}, expected 0 to 1e6", ratio,
                                                 gas_columns[gas]));
            }
        }
    }
}

namespace {

/// Interpolation at one height.
struct Between {
    std::size_t low;
    double t;

    Between(const Profile& profile, double height_km) {
        const std::vector<double>& z = profile.height_km;
        const double h = std::clamp(height_km, z.front(), z.back());
        low = interval_of(z, h);
        t = (h - z[low]) / (z[low + 1] - z[low]);
    }
    double linear(const std::vector<double>& v) const { return v[low] + t * (v[low + 1] - v[low]); }
    double logarithmic(const std::vector<double>& v) const {
        const double from = std::max(v[low], 1e-12), to = std::max(v[low + 1], 1e-12);
        return from == to ? from : from * std::exp(t * std::log(to / from));
    }
};

}  // namespace

std::pair<double, double> pressure_and_temperature_at(const Profile& profile, double height_km) {
    const Between at(profile, height_km);
    return {at.logarithmic(profile.pressure_hPa), at.linear(profile.temperature)};
}

AirSample air_at(const Profile& profile, double height_km) {
    const Between at(profile, height_km);
    AirSample air{.pressure_hPa = at.logarithmic(profile.pressure_hPa),
                  .temperature = at.linear(profile.temperature),
                  .mixing_ratio_ppm = {}};
    for (std::size_t gas = 0; gas < gas_count; ++gas) {
        air.mixing_ratio_ppm[gas] = at.logarithmic(profile.mixing_ratio_ppm[gas]);
    }
    return air;
}

namespace {

void insert_level(Profile& profile, std::size_t at, double height_km, const AirSample& air) {
    const auto i = static_cast<std::ptrdiff_t>(at);
    profile.height_km.insert(profile.height_km.begin() + i, height_km);
    profile.pressure_hPa.insert(profile.pressure_hPa.begin() + i, air.pressure_hPa);
    profile.temperature.insert(profile.temperature.begin() + i, air.temperature);
    for (std::size_t gas = 0; gas < gas_count; ++gas) {
        auto& ratio = profile.mixing_ratio_ppm[gas];
        ratio.insert(ratio.begin() + i, air.mixing_ratio_ppm[gas]);
    }
}

}  // namespace

AirSample sample_of(const Profile& profile, std::size_t level) {
    AirSample air{.pressure_hPa = profile.pressure_hPa[level],
                  .temperature = profile.temperature[level],
                  .mixing_ratio_ppm = {}};
    for (std::size_t gas = 0; gas < gas_count; ++gas) {
        air.mixing_ratio_ppm[gas] = profile.mixing_ratio_ppm[gas][level];
    }
    return air;
}

void append_level(Profile& profile, double height_km, const AirSample& air) {
    insert_level(profile, profile.height_km.size(), height_km, air);
}

void add_level(Profile& profile, double height_km) {
    constexpr double same_km = 1e-6;
    const auto& z = profile.height_km;
    const auto place = std::lower_bound(z.begin(), z.end(), height_km - same_km);
    if (place == z.end() || *place <= height_km + same_km) return;
    insert_level(profile, static_cast<std::size_t>(place - z.begin()), height_km,
                 air_at(profile, height_km));
}

void change_level(Profile& profile, std::size_t level, const AirChange& change, double share) {
    constexpr auto water = static_cast<std::size_t>(Gas::water);
    profile.temperature[level] += share * change.warmer;
    profile.pressure_hPa[level] *= std::exp(share * change.ln_pressure);
    profile.mixing_ratio_ppm[water][level] *= std::exp(share * change.ln_water);
}

Profile with_surface(Profile profile, double ground_km, double temperature,
                     double vapour_pressure_hPa, double depth_km) {
    constexpr auto water = static_cast<std::size_t>(Gas::water);
    const double top_km = ground_km + depth_km;
    // Levels at the ground and where the change ends, so that the kinks lie where they are meant.
    for (const double level : {ground_km, top_km}) add_level(profile, level);
    const AirSample ground = air_at(profile, ground_km);
    const AirChange change{
        .warmer = temperature - ground.temperature,
        .ln_water = std::log(std::max(vapour_pressure_hPa, 1e-9) / ground.pressure_hPa * 1e6 /
                             ground.mixing_ratio_ppm[water])};
    for (std::size_t i = 0; i < profile.height_km.size(); ++i) {
        const double share = std::clamp((top_km - profile.height_km[i]) / depth_km, 0.0, 1.0);
        change_level(profile, i, change, share);
    }
    return profile;
}

}  // namespace diurna
