#include "thermal/point/point_csv.hpp"

#include <fmt/format.h>

#include <iterator>

namespace diurna {

std::string column_csv(const PointResult& result) {
    fmt::memory_buffer text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out,
                   "time,surface_temperature_K,absorbed_solar_W_m2,longwave_in_W_m2,"
                   "longwave_out_W_m2,sensible_W_m2,latent_W_m2,conducted_W_m2{}{}{}{}\n",
                   result.has_back ? ",back_temperature_K" : "",
                   result.has_canopy ? ",ground_temperature_K,leaf_temperature_K" : "",
                   result.has_store ? ",water_mm,frost_mm" : "",
                   result.has_melt ? ",melt_W_m2" : "");
    for (const PointRow& r : result.row) {
        fmt::format_to(out, "{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}",
                       format_instant(r.instant), r.surface_temperature, r.absorbed_solar,
                       r.longwave_in, r.longwave_out, r.sensible, r.latent, r.conducted);
        if (result.has_back) fmt::format_to(out, ",{:.4f}", r.back_temperature);
        if (result.has_canopy) {
            fmt::format_to(out, ",{:.4f},{:.4f}", r.ground_temperature, r.leaf_temperature);
        }
        if (result.has_store) fmt::format_to(out, ",{:.5f},{:.5f}", r.water_mm, r.frost_mm);
        if (result.has_melt) fmt::format_to(out, ",{:.4f}", r.melt);
        fmt::format_to(out, "\n");
    }
    return fmt::to_string(text);
}

}  // namespace diurna
