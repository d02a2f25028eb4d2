#include "scenes/job/input/read_details.hpp"

#include <optional>
#include <string>
#include <utility>

namespace diurna {

DemOptions read_posts(const Section& section, bool geoid) {
    DemOptions options{.confines = section.confines()};
    options.voids =
        section.choice_or("voids", "action for posts without elevation", VoidPolicy::refuse,
                          {{"refuse", VoidPolicy::refuse}, {"fill", VoidPolicy::fill}});
    options.unit = section.choice_or(
        "height_unit", "unit of the heights; file: as the raster declares; geopotential: m2 s-2",
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
        "zero of the heights; egm96: above this geoid (sea level); file: as in the file", geoid,
        {{"file", false}, {"egm96", true}});
    return options;
}

std::vector<DetailInput> read_details(const Section& terrain, double tolerance, bool geoid) {
    std::vector<DetailInput> details;
    for (const Section& section : terrain.sections(
             "detail",
             "a finer elevation raster for part of the ground, blended into the coarser one; later "
             "ones lie on top. Its default vertical_datum is that of terrain")) {
        DetailInput detail;
        detail.files.push_back(section.file(
            "elevation", "elevation raster that GDAL reads, in any CRS; overhangs are ignored"));
        for (const std::string& tile :
             section.texts_or("more_tiles", "adjacent rasters of the same grid", {})) {
            detail.files.push_back(section.file_named("more_tiles", tile));
        }
        detail.reading = read_posts(section, geoid);
        detail.tolerance =
            section.number_or("tolerance_m", "largest vertical distance between mesh and posts",
                              {tolerance, "that of terrain"}, {0.0, 1000.0});
        detail.blend = section.number_or("blend_m",
                                         "width of the strip inside its border where it is blended "
                                         "with the ground below: w fine + (1 - w) coarse",
                                         20.0, {0.0, 1e4});
        details.push_back(std::move(detail));
    }
    return details;
}

}  // namespace diurna
