#include "materials/modtran/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

struct DeckWord {
    const char* name;
    int number;
};
constexpr std::array<DeckWord, 6> models = {
    {{"TROP", 1}, {"MLS", 2}, {"MLW", 3}, {"SAS", 4}, {"SAW", 5}, {"US76", 6}}};
constexpr std::array<DeckWord, 8> aerosols = {{{"none", 0},
                                               {"rural", 1},
                                               {"maritime", 4},
                                               {"urban", 5},
                                               {"tropospheric", 6},
                                               {"fog_advective", 8},
                                               {"fog_radiative", 9},
                                               {"desert", 10}}};

template <std::size_t Size>
const DeckWord& choice(const std::array<DeckWord, Size>& all, const std::string& name,
                       const char* what) {
    for (const DeckWord& each : all) {
        if (name == each.name) return each;
    }
    std::vector<std::string> names;
    for (const DeckWord& each : all) names.emplace_back(each.name);
    refuse_word(std::string("MODTRAN ") + what, name, names);
}

void check_deck(const ModtranDeck& d) {
    const auto within = [](const char* what, double value, double least, double most) {
        check_within(std::string("MODTRAN ") + what, value, least, most);
    };
    choice(models, d.model, "model");
    choice(aerosols, d.aerosol, "aerosol");
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

/// Cards 1 and 1A: what is computed, with which gases and over which ground.
std::string first_cards(const ModtranDeck& d) {
    const int model = choice(models, d.model, "model").number;
    Card card1;
    card1.text("T F ", 4).integer(d.profile ? 7 : model, 1).integer(static_cast<int>(d.path), 5);
    card1.integer(static_cast<int>(d.emission), 5).integer(d.multiple_scattering ? 1 : 0, 5);
    for (int i = 0; i < 6; ++i) card1.integer(d.profile ? model : 0, 5);
    card1.integer(0, 5).integer(d.profile ? 1 : 0, 5).integer(0, 5);
    card1.fixed(d.ground_temperature, 8, 3).fixed(d.albedo, 7, 2);
    Card card1a;
    card1a.text("fFF", 3).integer(8, 3).fixed(0.0, 4, 0).fixed(d.co2_ppm, 10, 3);
    card1a.text("  0.000000", 10).text("  0.000000", 10).text("0F F F F F", 10);
    return card1.line() + card1a.line();
}

/// Card 2: aerosol, wind, rain and ground.
std::string aerosol_card(const ModtranDeck& d) {
    Card card2;
    card2.text("", 2).integer(choice(aerosols, d.aerosol, "aerosol").number, 3).text("", 1);
    card2.integer(0, 4).text("", 3).integer(0, 2).integer(0, 5);
    card2.integer(0, 5).integer(0, 5).fixed(d.visibility_km, 10, 5);
    card2.fixed(d.wind_m_s, 10, 5).fixed(d.wind_m_s, 10, 5).fixed(d.rain_mm_h, 10, 5);
    card2.fixed(d.ground_km, 10, 5);
    return card2.line();
}

/// Cards 2C and 2C1: the levels of a profile from the ground up.
std::string profile_cards(const ModtranDeck& d, const Profile& p) {
    std::vector<std::size_t> levels;
    for (std::size_t i = 0; i < p.height_km.size(); ++i) {
        if (p.height_km[i] >= d.ground_km - 1e-9 && p.height_km[i] <= 100.0) levels.push_back(i);
    }
    if (levels.size() < 2 || levels.size() > 999) {
        throw InputError("MODTRAN profile",
                         fmt::format("found {} levels from the ground to 100 km, expected 2 to 999",
                                     levels.size()));
    }
    Card card2c;
    card2c.integer(static_cast<int>(levels.size()), 5).integer(0, 5).integer(0, 5);
    card2c.text(" " + p.name, 20).fixed(0.0, 10, 6);
    std::string cards = card2c.line();
    std::string units = "AAA";  // hPa, K, ppm; the other gases of the model
    units.append(11, static_cast<char>('0' + choice(models, d.model, "model").number));
    for (const std::size_t i : levels) {
        Card level;
        level.fixed(p.height_km[i], 10, 5);
        for (const double value :
             {p.pressure_hPa[i], p.temperature[i], p.mixing_ratio_ppm[0][i], 0.0, 0.0}) {
            level.text(fmt::format("{:10.3E}", value), 10);
        }
        cards += level.text(units, 14).line();
    }
    return cards;
}

/// Cards 3 to 3A2: the path and the sun.
std::string geometry_cards(const ModtranDeck& d) {
    const bool level = d.path == ModtranDeck::PathType::level;
    const bool space = d.path == ModtranDeck::PathType::to_space;
    Card card3;
    card3.fixed(d.h1_km, 10, 6).fixed(level || space ? 0.0 : d.h2_km, 10, 6);
    card3.fixed(space ? d.zenith_deg : 0.0, 10, 5).fixed(space ? 0.0 : d.range_km, 10, 5);
    card3.fixed(0.0, 10, 6).fixed(0.0, 10, 6).integer(0, 5).text("", 5).fixed(0.0, 10, 6);
    std::string cards = card3.line();
    if (d.emission == ModtranDeck::Emission::thermal_and_sun) {
        Card card3a1;
        card3a1.integer(2, 5).integer(2, 5).integer(d.day_of_year, 5).integer(0, 5);
        Card card3a2;
        card3a2.fixed(d.sun_azimuth_deg, 10, 3).fixed(d.sun_zenith_deg, 10, 3);
        for (int i = 0; i < 6; ++i) card3a2.fixed(0.0, 10, 3);
        cards += card3a1.line() + card3a2.line();
    }
    return cards;
}

/// Card 4: the wavenumbers.
std::string spectral_card(const ModtranDeck& d) {
    Card card4;
    card4.fixed(d.first_per_cm, 10, 3).fixed(d.last_per_cm, 10, 3).fixed(d.step_per_cm, 10, 3);
    card4.fixed(d.width_per_cm, 10, 3).text(" W", 2);
    return card4.line();
}

}  // namespace

std::string write_tape5(const std::vector<ModtranDeck>& decks) {
    std::string text;
    for (std::size_t i = 0; i < decks.size(); ++i) {
        const ModtranDeck& d = decks[i];
        check_deck(d);
        text += first_cards(d) + aerosol_card(d);
        if (d.profile) text += profile_cards(d, *d.profile);
        text += geometry_cards(d) + spectral_card(d);
        text += Card().integer(i + 1 < decks.size() ? 1 : 0, 5).line();
    }
    return text;
}

}  // namespace diurna
