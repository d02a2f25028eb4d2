#include "scenes/input/read_details.hpp"

#include <optional>
#include <string>
#include <utility>

namespace diurna {

DemOptions read_posts(const Section& section, bool geoid) {
    DemOptions options{.confines = section.confines()};
    options.voids =
        section.choice_or("voids", "posts without elevation in the file", VoidPolicy::refuse,
                          {{"refuse", VoidPolicy::refuse}, {"fill", VoidPolicy::fill}});
    options.unit = section.choice_or(
        "height_unit", "of the posts; file: what the raster says; geopotential: m2 s-2",
        std::optional<double>{},
        {{"file", std::nullopt},
         {"m", 1.0},
         {"dm", 0.1},
         {"cm", 0.01},
         {"km", 1000.0},
         {"ft", 0.3048},
         {"us_ft", 1200.0 / 3937.0},
         {"geopotential", 1.0 / 9.80665}});
    options.geoid = section.choice_or(
        "vertical_datum",
        "egm96: the heights are above that geoid, the sea; file: taken as they are", geoid,
        {{"file", false}, {"egm96", true}});
    return options;
}

std::vector<DetailInput> read_details(const Section& terrain, double tolerance, bool geoid) {
    std::vector<DetailInput> details;
    for (const Section& section :
         terrain.sections("detail",
                          "a finer model of part of the ground, blended into the one below; later "
                          "ones lie on top. Its vertical_datum is terrain's unless it names one")) {
        DetailInput detail;
        detail.files.push_back(section.file(
            "elevation",
            "a raster that GDAL reads, of any CRS; what hangs over counts for nothing"));
        for (const std::string& tile : section.texts_or(
                 "more_tiles", "rasters of the same lattice that go on beside it", {})) {
            detail.files.push_back(section.file_named("more_tiles", tile));
        }
        detail.reading = read_posts(section, geoid);
        detail.tolerance =
            section.number_or("tolerance_m", "no post of it lies further from the mesh, vertically",
                              {tolerance, "that of terrain"}, {0.0, 1000.0});
        detail.blend = section.number_or(
            "blend_m",
            "width of the strip within its border over which it goes over into the "
            "ground below: w fine + (1 - w) coarse",
            20.0, {0.0, 1e4});
        details.push_back(std::move(detail));
    }
    return details;
}

}  // namespace diurna
