#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/sheet_scene.hpp"

/// A run with labels, and where its blocks must lie in the picture.
namespace diurna::testing {

inline constexpr int columns = 96, rows = 64;
inline constexpr double field_deg = 12.0;
// The level plain falls away from the site's plane by 0.28 mm there.
inline const Eigen::Vector3d eye(0.0, -60.0, 20.0 - 60.0 * 60.0 / (2.0 * 6371e3));

/// A truck in the open, one behind a wall's left half, one behind a net, one partly out of the
/// picture; over a plain, from 60 m south and 20 m above.
inline void write_yard(const std::filesystem::path& folder) {
    namespace plain = over_plain;
    plain::Given given{.mesh = plain::block(-1.0, 1.0, -2.0, 2.0, 1.5), .height = 0.0};
    given.longwave = 300.0;
    given.ground_edge = 10.0;
    given.observer = R"(place_m = [0.0, -60.0]
height_above_ground_m = 20.0
azimuth_deg = 0.0
elevation_deg = -18.0
horizontal_fov_deg = 12.0
)";
    const auto object = [](const std::string& name, const std::string& mesh, double east,
                           double north, const std::string& more) {
        return fmt::format(
            "[[object]]\nname = \"{}\"\nmesh = \"{}.obj\"\nup = \"z\"\nplace_m = [{}, {}]\n"
            "largest_edge_m = 2.0\n{}\n",
            name, mesh, east, north, more);
    };
    const std::string truck = "class = \"truck\"\nmaterial = \"sheet\"\n";
    given.observer += object("open", "mesh", -4.2, 0.0, truck + "heading_deg = 90.0");
    given.observer += object("hidden", "mesh", 4.0, 0.0, truck);
    given.observer += object("edge", "mesh", 6.5, -3.0, truck);
    given.observer += object("wall", "wall", 4.0, -4.0, "material = \"sheet\"");
    given.observer += object("net", "net", 0.0, -4.0,
                             "class = \"camouflage net\"\nmaterial = \"net\"\n"
                             "height_above_ground_m = 0.2");
    given.sheet = R"([material.net]
albedo = 0.2
emissivity = 0.9
cover = 0.65
roughness_length_m = 0.01
layers = [{ thickness_m = 0.001, conductivity_W_mK = 1.0, density_kg_m3 = 1000.0, heat_capacity_J_kgK = 1000.0 }]
convection = { kind = "constant", value_W_m2K = 10.0 }
)";
    plain::write_scene(folder, given);
    write_text(folder / "wall.obj", plain::block(-1.0, 1.0, -0.1, 0.1, 2.0));
    write_text(folder / "net.obj", "v -1.8 0 0\nv 1.8 0 0\nv 1.8 0 4\nv -1.8 0 4\nf 1 2 3 4\n");
    std::string scene = read_text(folder / "scene.toml");
    scene = with(scene, "width = 32", fmt::format("width = {}", columns));
    scene = with(scene, "height = 32", fmt::format("height = {}", rows));
    scene = with(scene, "name = \"sheet\"\nmesh", "name = \"netted\"\nclass = \"truck\"\nmesh");
    write_text(folder / "scene.toml", scene + "[labels]\nbits = 16\nvalidation_share = 0.5\n");
}

/// Column and row of a place by the pinhole's own equations, the axis 18 degrees down to the north.
inline Eigen::Vector2d projected(const Eigen::Vector3d& place) {
    const double down = 18.0 * std::numbers::pi / 180.0;
    const Eigen::Vector3d axis(0.0, std::cos(down), -std::sin(down));
    const Eigen::Vector3d below(0.0, -std::sin(down), -std::cos(down));
    const Eigen::Vector3d away = place - eye;
    const double focal = 0.5 * columns / std::tan(0.5 * field_deg * std::numbers::pi / 180.0);
    return {0.5 * columns + focal * away.x() / away.dot(axis),
            0.5 * rows + focal * away.dot(below) / away.dot(axis)};
}

/// Pixels whose centres lie in a block's picture, which is the convex hull of its corners: a centre
/// lies in it unless a line through it has all corners on one side. Columns from −96 to 192.
inline int silhouette(const Eigen::Vector2d& middle, const Eigen::Vector2d& half, double height) {
    std::vector<Eigen::Vector2d> corner;
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            for (const double z : {0.0, height}) {
                corner.push_back(
                    projected({middle.x() + x * half.x(), middle.y() + y * half.y(), z}));
            }
        }
    }
    int inside = 0;
    for (int column = -columns; column < 2 * columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            std::vector<double> bearing;
            for (const Eigen::Vector2d& c : corner) {
                bearing.push_back(std::atan2(c.y() - row - 0.5, c.x() - column - 0.5));
            }
            std::sort(bearing.begin(), bearing.end());
            double gap = bearing.front() + 2.0 * std::numbers::pi - bearing.back();
            for (std::size_t i = 1; i < bearing.size(); ++i) {
                gap = std::max(gap, bearing[i] - bearing[i - 1]);
            }
            inside += gap < std::numbers::pi;
        }
    }
    return inside;
}

using Json = nlohmann::json;

struct Yard {
    ScratchFolder folder{"yard"};
    std::filesystem::path out = folder.path / "out";
    Json coco;

    Yard() {
        write_yard(folder.path);
        JobOptions options;
        options.out = out;
        run_job(read_scene(folder.path / "scene.toml"), options);
        coco = Json::parse(read_text(out / "annotations.json"));
    }
    /// (name of the object) its label in an image.
    std::map<std::string, Json> of_image(int id) const {
        std::map<std::string, Json> found;
        for (const Json& label : coco["annotations"]) {
            if (label["image_id"] == id) found[label["instance"]["name"]] = label;
        }
        return found;
    }
};
inline const Yard& yard() {
    static const Yard once;
    return once;
}

}  // namespace diurna::testing
