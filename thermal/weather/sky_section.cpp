#include "thermal/weather/sky_section.hpp"

namespace diurna {

ClearSky read_sky(const Section& sky) {
    ClearSky clear;
    const auto aerosol = [&](const char* key, const char* what, double& depth) {
        if (sky.has(key)) depth = sky.number(key, what, {0.0, 5.0});
    };
    aerosol("aerosol_380nm",
            "optical depth of aerosol at 380 nm; default: from the scene's visibility, 0.15 for a "
            "single facet",
            clear.aerosol_380nm);
    aerosol("aerosol_500nm",
            "optical depth of aerosol at 500 nm; default: from the scene's visibility, 0.1 for a "
            "single facet",
            clear.aerosol_500nm);
    clear.ozone_cm = sky.number_or("ozone_cm", "thickness of the ozone layer at standard pressure",
                                   clear.ozone_cm, {0.0, 1.0});
    clear.longwave = sky.choice_or("longwave", "formula of longwave radiation from a clear sky",
                                   LongwaveFormula::dilley_obrien,
                                   {{"dilley-obrien", LongwaveFormula::dilley_obrien},
                                    {"brutsaert", LongwaveFormula::brutsaert},
                                    {"prata", LongwaveFormula::prata},
                                    {"brunt", LongwaveFormula::brunt},
                                    {"idso", LongwaveFormula::idso},
                                    {"swinbank", LongwaveFormula::swinbank}});
    clear.longwave_by_direction = sky.flag_or(
        "longwave_by_direction", "the sky's longwave radiance increases towards the horizon", true);
    if (sky.word_or("sun", "clear-sky model for sunlight that was not measured", "bird",
                    {"bird", "ineichen"}) == "ineichen") {
        clear.linke_turbidity =
            sky.number_or("linke_turbidity", "Linke turbidity", 3.0, {1.0, 12.0});
    }
    if (sky.has("precipitable_water_cm")) {
        clear.precipitable_water_cm = sky.number(
            "precipitable_water_cm", "precipitable water; default: from the humidity", {0.0, 10.0});
    }
    clear.separation = sky.choice_or(
        "separation", "model that splits measured global sunlight if it is the only one measured",
        Separation::engerer2, {{"engerer2", Separation::engerer2}, {"erbs", Separation::erbs}});
    return clear;
}

}  // namespace diurna
