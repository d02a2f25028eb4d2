#pragma once

#include <string>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/world/build_world.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_scene.hpp"

/// Small scenes on files of ground, built.
namespace diurna::testing::built_land {

inline const ScratchFolder scratch("land");

inline Scene scene_of(const std::string& text) {
    write_text(scratch.path / "scene.toml", text);
    return read_scene(scratch.path / "scene.toml");
}

struct Built {
    Scene scene;
    Dem dem;
    World world;
};

inline Built built(const std::string& text) {
    Scene scene = scene_of(text);
    Dem dem = read_dem(scene.terrain.elevation.file, scene.terrain.elevation.reading);
    World world = build_world(scene, dem);
    return {std::move(scene), std::move(dem), std::move(world)};
}

inline std::string with_terrain(const std::string& keys) {
    return with(small_scene(), "tolerance_m = 10.0", "tolerance_m = 10.0\n" + keys);
}

}  // namespace diurna::testing::built_land
