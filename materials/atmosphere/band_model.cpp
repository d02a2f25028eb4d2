#include "materials/atmosphere/band_model.hpp"

#include <algorithm>

#include "materials/atmosphere/band_model_tables.hpp"
#include "materials/base/error.hpp"

namespace diurna {

std::vector<std::string> aerosol_names() {
    std::vector<std::string> names = {"none"};
    for (const auto& [name, levels] : band_model_tables().aerosols) names.push_back(name);
    return names;
}

void check(const BandModel& model) {
    check(model.profile);
    const std::vector<std::string> names = aerosol_names();
    if (std::find(names.begin(), names.end(), model.aerosol) == names.end()) {
        refuse_word("aerosol", model.aerosol, names);
    }
    check_within("visibility_km", model.visibility_km, 0.05, 300.0);
    check_within("co2_ppm", model.co2_ppm, 0.0, 10000.0);
    check_within("space_temperature", model.space_temperature, 0.0, 10000.0);
    check_within("ground_km", model.ground_km, -0.5, 5.5);
    check_within("rain_mm_h", model.rain_mm_h, 0.0, 300.0);
    check_within("rain_top_km", model.rain_top_km, 0.0, 10.0);
    check_within("cloud.fraction", model.cloud.fraction, 0.0, 1.0);
    check_within("cloud.base_km", model.cloud.base_km, -0.5, 20.0);
    check_within("cloud.depth_km", model.cloud.depth_km, 0.0, 15.0);
    check_within("cloud.sunlit_fraction", model.cloud.over_sun(), 0.0, 1.0);
    check_within("cloud.temperature", model.cloud.temperature, 0.0, 400.0);
    check_within("cloud.optical_depth", model.cloud.optical_depth, 0.0, 1000.0);
    check_within("cloud.emissivity", model.cloud.emissivity, 0.0, 1.0);
}

SightLine line_of(const BandModel& model, double height_km, double zenith_deg, double range_km,
                  const Segmentation& segmentation) {
    return model.refraction
               ? refracted_line(model.profile, height_km, zenith_deg, range_km, segmentation)
               : sight_line(height_km, zenith_deg, range_km, segmentation);
}

bool ends_on_ground(const BandModel& model, double height_km, double zenith_deg) {
    return model.refraction ? meets_ground(model.profile, height_km, zenith_deg)
                            : meets_ground(height_km, zenith_deg);
}

}  // namespace diurna
