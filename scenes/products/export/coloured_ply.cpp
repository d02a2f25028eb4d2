#include "scenes/products/export/coloured_ply.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/made_by.hpp"
#include "render/picture/palette.hpp"
#include "terrain/objects/ply_file.hpp"

namespace diurna {

ColourScale write_coloured_ply(const std::filesystem::path& file, const RunHeat& heat,
                               const HeatAt& at) {
    const FacetSet& facets = heat.mesh.facets;
    const Site& site = heat.mesh.site;
    const Plane plane{"temperature", "K", at.kelvin};
    const ColourScale scale = colour_scale(plane);
    std::vector<Rgb> colour;
    for (const float kelvin : at.kelvin) {
        const double t = (in_colour_unit(plane, kelvin) - scale.low) / (scale.high - scale.low);
        colour.push_back(warm_colour(std::clamp(t, 0.0, 1.0)));
    }
    std::vector<Eigen::Vector3d> vertex;
    for (const Eigen::Vector3f& v : facets.vertex) vertex.push_back(v.cast<double>());
    write_ply(file, vertex, facets.corner,
              {.colour = colour,
               .temperature = at.kelvin,
               .comments = {fmt::format("{} {}", made_by(), format_instant(at.when)), made_with(),
                            fmt::format("x, y, z: east, north, up [m] from {:.9f}, {:.9f} (WGS84), "
                                        "{:.3f} m; heights as in the scene",
                                        site.latitude_deg, site.longitude_deg, site.height),
                            fmt::format("colours: {:g} to {:g} degC", scale.low, scale.high)}});
    return scale;
}

}  // namespace diurna
