#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/job/input/checked_names.hpp"
#include "terrain/texture/clutter.hpp"
#include "terrain/texture/texture_file.hpp"

namespace diurna {

/// A table [[texture]]: the parameter that varies, and a picture or a random field.
struct TextureInput {
    enum class What { albedo, emissivity, mixture };

    std::string name;
    std::string where;  // in the scene file, for mistakes found later
    What what = What::albedo;
    std::array<std::string, 2> between;  // materials of a mixture: shares 0 and 1 of the second
    int levels = 0;                      // number solved; 0: one per 0.3 of albedo or 0.2 of

    // A random field. The value is normal about `mean` with standard deviation `deviation`, clipped
    // at three deviations and at the parameter's own limits.
    std::optional<ClutterSpec> clutter;
    std::optional<double> mean;  // none: the material's own
    double deviation = 0.0;

    // A picture, with values of the parameter.
    std::filesystem::path file;
    TextureImage image;
    bool nearest = false, repeat = false;
    double metres_per_texel = 0.0;  // 0: by the file's georeference
    Eigen::Vector2d place =
        Eigen::Vector2d::Zero();  // of its middle; of an object: from its middle
    double heading_deg = 0.0;     // direction of its upper edge
};

/// The tables [[texture]]; mistakes are noted in the sections.
std::vector<TextureInput> read_textures(const Section& root, const Reading& reading);

}  // namespace diurna
