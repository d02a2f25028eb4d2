#include "thermal/weather/sky_section.hpp"

namespace diurna {

ClearSky read_sky(const Section& sky) {
    ClearSky clear;
    const auto aerosol = [&](const char* key, const char* what, double& depth) {
        if (sky.has(key)) depth = sky.number(key, what, {0.0, 5.0});
    };
    aerosol("aerosol_380nm",
            "optical depth of aerosol at 380 nm; else that of the scene's visibility, of a single "
            "facet 0.15",
            clear.aerosol_380nm);
    aerosol("aerosol_500nm",
            "optical depth of aerosol at 500 nm; else that of the scene's visibility, of a single "
            "facet 0.1",
            clear.aerosol_500nm);
    clear.ozone_cm =
        sky.number_or("ozone_cm", "a layer of it at standard pressure", clear.ozone_cm, {0.0, 1.0});
    clear.longwave = sky.choice_or("longwave", "formula of the clear sky's longwave",
                                   LongwaveFormula::dilley_obrien,
                                   {{"dilley-obrien", LongwaveFormula::dilley_obrien},
                                    {"brutsaert", LongwaveFormula::brutsaert},
                                    {"prata", LongwaveFormula::prata},
                                    {"brunt", LongwaveFormula::brunt},
                                    {"idso", LongwaveFormula::idso},
                                    {"swinbank", LongwaveFormula::swinbank}});
    clear.longwave_by_direction = sky.flag_or(
        "longwave_by_direction", "the sky's longwave is stronger near the horizon", true);
    if (sky.word_or("sun", "clear sky's sun where none was measured", "bird",
                    {"bird", "ineichen"}) == "ineichen") {
        clear.linke_turbidity =
            sky.number_or("linke_turbidity", "of the air, for ineichen", 3.0, {1.0, 12.0});
    }
    if (sky.has("precipitable_water_cm")) {
        clear.precipitable_water_cm = sky.number(
            "precipitable_water_cm", "in the whole air; else from its humidity", {0.0, 10.0});
    }
    clear.separation = sky.choice_or(
        "separation", "model that splits global sunlight that alone was measured",
        Separation::engerer2, {{"engerer2", Separation::engerer2}, {"erbs", Separation::erbs}});
    return clear;
}

}  // namespace diurna
