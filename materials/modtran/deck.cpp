#include "materials/modtran/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

struct Choice {
    const char* name;
    int number;
    const char* word;
};
constexpr std::array<Choice, 6> models = {{{"TROP", 1, "ATM_TROPICAL"},
                                           {"MLS", 2, "ATM_MIDLAT_SUMMER"},
                                           {"MLW", 3, "ATM_MIDLAT_WINTER"},
                                           {"SAS", 4, "ATM_SUBARC_SUMMER"},
                                           {"SAW", 5, "ATM_SUBARC_WINTER"},
                                           {"US76", 6, "ATM_US_STANDARD_1976"}}};
constexpr std::array<Choice, 8> aerosols = {{{"none", 0, "AER_NONE"},
                                             {"rural", 1, "AER_RURAL"},
                                             {"maritime", 4, "AER_MARITIME"},
                                             {"urban", 5, "AER_URBAN"},
                                             {"tropospheric", 6, "AER_TROPOSPHERIC"},
                                             {"fog_advective", 8, "AER_FOG_ADVECTIVE"},
                                             {"fog_radiative", 9, "AER_FOG_RADIATIVE"},
                                             {"desert", 10, "AER_DESERT"}}};

template <std::size_t Size>
const Choice& choice(const std::array<Choice, Size>& all, const std::string& name,
                     const char* what) {
    for (const Choice& each : all) {
        if (name == each.name) return each;
    }
    std::vector<std::string> names;
    for (const Choice& each : all) names.emplace_back(each.name);
    throw InputError(
        std::string("MODTRAN ") + what,
        fmt::format("found '{}', expected one of {}", name.substr(0, 40), fmt::join(names, " ")),
        did_you_mean(name, names));
}

void check(const ModtranDeck& d) {
    const auto within = [](const char* what, double value, double least, double most) {
        if (value >= least && value <= most) return;
        throw InputError(std::string("MODTRAN ") + what,
                         fmt::format("found {:g}, expected {:g} to {:g}", value, least, most));
    };
    choice(models, d.model, "model");
    choice(aerosols, d.aerosol, "aerosol");
    if (d.name.empty() || d.name.size() > 60 ||
        !std::all_of(d.name.begin(), d.name.end(), [](unsigned char c) {
            return std::isalnum(c) || c == '_' || c == '-' || c == '.';
        })) {
        throw InputError("MODTRAN name", "expected letters, digits, '_', '-' and '.'");
    }
    within("visibility_km", d.visibility_km, 0.1, 300.0);
    within("rain_mm_h", d.rain_mm_h, 0.0, 300.0);
    within("wind_m_s", d.wind_m_s, 0.0, 50.0);
    within("co2_ppm", d.co2_ppm, 0.0, 10000.0);
    within("ground_km", d.ground_km, -0.5, 6.0);
    within("ground_temperature", d.ground_temperature, 0.0, 2000.0);
    within("albedo", d.albedo, 0.0, 1.0);
    within("h1_km", d.h1_km, d.ground_km, 100.0);
    within("zenith_deg", d.zenith_deg, 0.0, 180.0);
    if (d.path == ModtranDeck::PathType::between_heights) {
        within("h2_km", d.h2_km, d.ground_km, 100.0);
        within("range_km", d.range_km, std::max(1e-3, std::abs(d.h1_km - d.h2_km)), 9999.0);
    }
    if (d.path == ModtranDeck::PathType::level) within("range_km", d.range_km, 1e-3, 9999.0);
    within("sun_zenith_deg", d.sun_zenith_deg, 0.0, 180.0);
    within("sun_azimuth_deg", d.sun_azimuth_deg, -360.0, 360.0);
    within("day_of_year", d.day_of_year, 1, 366);
    within("first_per_cm", d.first_per_cm, 0.0, 50000.0);
    within("last_per_cm", d.last_per_cm, d.first_per_cm, 50000.0);
    within("step_per_cm", d.step_per_cm, 0.1, 500.0);
    within("width_per_cm", d.width_per_cm, d.step_per_cm, 500.0);
    if (d.profile) diurna::check(*d.profile);
}

/// A card of fixed fields.
class Card {
 public:
    Card& text(std::string_view text, std::size_t width) {
        card_ += fmt::format("{:<{}}", text.substr(0, width), width);
        return *this;
    }
    Card& integer(int value, int width) { return put(fmt::format("{:{}}", value, width), width); }
    Card& fixed(double value, int width, int decimals) {
        return put(fmt::format("{:{}.{}f}", value, width, decimals), width);
    }
    std::string line() {
        while (card_.ends_with(' ')) card_.pop_back();
        return card_ + '\n';
    }

 private:
    Card& put(const std::string& field, int width) {
        if (field.size() > static_cast<std::size_t>(width)) {
            throw InputError("MODTRAN tape5",
                             fmt::format("{} does not fit {} columns", field, width));
        }
        card_ += field;
        return *this;
    }
    std::string card_;
};

std::string deck_cards(const ModtranDeck& d, int emission, int path) {
    const int model = d.profile ? 7 : choice(models, d.model, "model").number;
    const int gases = d.profile ? choice(models, d.model, "model").number : 0;
    std::string cards;
    Card card1;
    card1.text("T F ", 4).integer(model, 1).integer(path, 5).integer(emission, 5);
    card1.integer(d.multiple_scattering ? 1 : 0, 5);
    for (int i = 0; i < 6; ++i) card1.integer(gases, 5);
    card1.integer(0, 5).integer(d.profile ? 1 : 0, 5).integer(0, 5);
    card1.fixed(d.ground_temperature, 8, 3).fixed(d.albedo, 7, 2);
    cards += card1.line();
    Card card1a;
    card1a.text("fFF", 3).integer(8, 3).fixed(0.0, 4, 0).fixed(d.co2_ppm, 10, 3);
    card1a.text("  0.000000", 10).text("  0.000000", 10).text("0F F F F F", 10);
    cards += card1a.line();
    Card card2;
    card2.text("", 2).integer(choice(aerosols, d.aerosol, "aerosol").number, 3).text("", 1);
    card2.integer(0, 4).text("", 3).integer(0, 2).integer(0, 5);
    card2.integer(0, 5).integer(0, 5).fixed(d.visibility_km, 10, 5);
    card2.fixed(d.wind_m_s, 10, 5).fixed(d.wind_m_s, 10, 5).fixed(d.rain_mm_h, 10, 5);
    card2.fixed(d.ground_km, 10, 5);
    cards += card2.line();
    if (d.profile) {
        const Profile& p = *d.profile;
        std::vector<std::size_t> levels;
        for (std::size_t i = 0; i < p.height_km.size(); ++i) {
            if (p.height_km[i] >= d.ground_km - 1e-9 && p.height_km[i] <= 100.0)
                levels.push_back(i);
        }
        if (levels.size() < 2 || levels.size() > 999) {
            throw InputError("MODTRAN profile",
                             fmt::format("{} levels from the ground to 100 km, expected 2 to 999",
                                         levels.size()));
        }
        Card card2c;
        card2c.integer(static_cast<int>(levels.size()), 5).integer(0, 5).integer(0, 5);
        card2c.text(" " + p.name, 20).fixed(0.0, 10, 6);
        cards += card2c.line();
        for (const std::size_t i : levels) {
            // Height, pressure [hPa], temperature [K], water [ppm]; other gases of the model.
            Card level;
            level.fixed(p.height_km[i], 10, 5);
            level.text(fmt::format("{:10.3E}", p.pressure_hPa[i]), 10);
            level.text(fmt::format("{:10.3E}", p.temperature[i]), 10);
            level.text(fmt::format("{:10.3E}", p.mixing_ratio_ppm[0][i]), 10);
            level.text(fmt::format("{:10.3E}", 0.0), 10).text(fmt::format("{:10.3E}", 0.0), 10);
            std::string units = "AAA";
            units.append(11, static_cast<char>('0' + gases));
            level.text(units, 14);
            cards += level.line();
        }
    }
    Card card3;
    if (emission == 3) {
        card3.fixed(d.h1_km, 10, 6).fixed(0.0, 10, 6).fixed(d.zenith_deg, 10, 5);
        card3.integer(d.day_of_year, 5).text("", 5).fixed(0.0, 10, 3).integer(0, 5);
        card3.fixed(0.0, 10, 3);
        cards += card3.line();
    } else {
        const bool level = path == 1, space = path == 3;
        card3.fixed(d.h1_km, 10, 6).fixed(level || space ? 0.0 : d.h2_km, 10, 6);
        card3.fixed(space ? d.zenith_deg : 0.0, 10, 5).fixed(space ? 0.0 : d.range_km, 10, 5);
        card3.fixed(0.0, 10, 6).fixed(0.0, 10, 6).integer(0, 5).text("", 5).fixed(0.0, 10, 6);
        cards += card3.line();
    }
    if (emission == 2) {
        Card card3a1;
        card3a1.integer(2, 5).integer(2, 5).integer(d.day_of_year, 5).integer(0, 5);
        cards += card3a1.line();
        Card card3a2;
        card3a2.fixed(d.sun_azimuth_deg, 10, 3).fixed(d.sun_zenith_deg, 10, 3);
        for (int i = 0; i < 6; ++i) card3a2.fixed(0.0, 10, 3);
        cards += card3a2.line();
    }
    Card card4;
    card4.fixed(d.first_per_cm, 10, 3).fixed(d.last_per_cm, 10, 3).fixed(d.step_per_cm, 10, 3);
    card4.fixed(d.width_per_cm, 10, 3).text(" W", 2);
    cards += card4.line();
    return cards;
}

}  // namespace

std::string write_tape5(const std::vector<ModtranDeck>& decks) {
    std::string text;
    for (std::size_t i = 0; i < decks.size(); ++i) {
        check(decks[i]);
        text += deck_cards(decks[i], static_cast<int>(decks[i].emission),
                           static_cast<int>(decks[i].path));
        text += Card().integer(i + 1 < decks.size() ? 1 : 0, 5).line();
    }
    return text;
}

std::string write_modtran6_json(const std::vector<ModtranDeck>& decks) {
    using Json = nlohmann::ordered_json;
    Json runs = Json::array();
    int number = 0;
    for (const ModtranDeck& d : decks) {
        check(d);
        constexpr std::array<const char*, 4> emissions = {
            "RT_TRANSMITTANCE", "RT_THERMAL_ONLY", "RT_SOLAR_AND_THERMAL", "RT_SOLAR_IRRADIANCE"};
        const char* const model = choice(models, d.model, "model").word;
        Json atmosphere = {{"MODEL", d.profile ? "ATM_USER_ALT_PROFILE" : model}};
        for (int i = 1; i <= 6; ++i) atmosphere["M" + std::to_string(i)] = model;
        atmosphere["CO2MX"] = d.co2_ppm;
        if (d.profile) {
            const auto profile = [&](const char* type, const char* unit,
                                     const std::vector<double>& values) {
                return Json{{"TYPE", type}, {"UNITS", unit}, {"PROFILE", values}};
            };
            atmosphere["NPROF"] = 4;
            atmosphere["NLAYERS"] = d.profile->height_km.size();
            atmosphere["PROFILES"] = {
                profile("PROF_ALTITUDE", "UNT_KILOMETERS", d.profile->height_km),
                profile("PROF_PRESSURE", "UNT_PMILLIBAR", d.profile->pressure_hPa),
                profile("PROF_TEMPERATURE", "UNT_TKELVIN", d.profile->temperature),
                profile("PROF_H2O", "UNT_DPPMV", d.profile->mixing_ratio_ppm[0])};
        }
        Json geometry = {{"ITYPE", static_cast<int>(d.path)}, {"H1ALT", d.h1_km}};
        if (d.path == ModtranDeck::PathType::to_space) {
            geometry["OBSZEN"] = d.zenith_deg;
        } else {
            geometry["HRANGE"] = d.range_km;
        }
        if (d.path == ModtranDeck::PathType::between_heights) geometry["H2ALT"] = d.h2_km;
        geometry["IDAY"] = d.day_of_year;
        if (d.emission == ModtranDeck::Emission::thermal_and_sun) {
            geometry["IPARM"] = 2;
            geometry["PARM1"] = d.sun_azimuth_deg;
            geometry["PARM2"] = d.sun_zenith_deg;
        }
        runs.push_back(
            {{"MODTRANINPUT",
              {{"NAME", d.name},
               {"CASE", number++},
               {"RTOPTIONS",
                {{"MODTRN", "RT_CORRK_FAST"},
                 {"IEMSCT", emissions[static_cast<std::size_t>(d.emission)]},
                 {"IMULT", d.multiple_scattering ? "RT_DISORT" : "RT_NO_MULTIPLE_SCATTER"},
                 {"NSTR", 8}}},
               {"ATMOSPHERE", atmosphere},
               {"AEROSOLS",
                {{"IHAZE", choice(aerosols, d.aerosol, "aerosol").word},
                 {"VIS", d.visibility_km},
                 {"WSS", d.wind_m_s},
                 {"WHH", d.wind_m_s},
                 {"RAINRT", d.rain_mm_h}}},
               {"GEOMETRY", geometry},
               {"SURFACE",
                {{"SURFTYPE", "REFL_CONSTANT"},
                 {"TPTEMP", d.ground_temperature},
                 {"SURREF", d.albedo},
                 {"GNDALT", d.ground_km}}},
               {"SPECTRAL",
                {{"V1", d.first_per_cm},
                 {"V2", d.last_per_cm},
                 {"DV", d.step_per_cm},
                 {"FWHM", d.width_per_cm},
                 {"YFLAG", "R"},
                 {"XFLAG", "W"}}},
               {"FILEOPTIONS", {{"JSONPRNT", d.name + ".json"}, {"JSONOPT", 7}}}}}});
    }
    return Json{{"MODTRAN", runs}}.dump(2) + "\n";
}

}  // namespace diurna
