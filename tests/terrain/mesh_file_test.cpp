#include "terrain/objects/placed_mesh.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <map>

#include "materials/base/error.hpp"
#include "terrain/objects/facing.hpp"
#include "terrain/objects/mesh_check.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

const PrivateTempFolder private_temp_folder;

/// A wedge 4 long (z), 2 wide (x), 1 high at its front (y up), in two parts; quadrilaterals and
/// triangles.
std::string wedge(bool inside_out) {
    const auto face = [&](std::vector<int> corner) {
        if (inside_out) std::reverse(corner.begin(), corner.end());
        std::string line = "f";
        for (const int c : corner) line += " " + std::to_string(c);
        return line + "\n";
    };
    return "v -1 0 -2\nv 1 0 -2\nv 1 0 2\nv -1 0 2\nv 1 1 2\nv -1 1 2\n"
           "g hull\n" +
           face({1, 2, 3, 4}) + face({1, 4, 6}) + face({2, 5, 3}) + face({3, 5, 6, 4}) +
           "g deck\nusemtl shiny\n" + face({1, 6, 5, 2});
}

MeshFile read(const std::string& text, const std::string& name = "a.obj") {
    const ScratchFolder folder("mesh");
    write_text(folder.path / name, text);
    return read_mesh_file(folder.path / name);
}

double area(const ObjectMesh& mesh, MaterialId material) {
    double sum = 0.0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector3f across =
            (mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]);
        if (mesh.material[t] == material) sum += 0.5 * across.norm();
    }
    return sum;
}

double volume(const ObjectMesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangle) {
        sum += mesh.vertex[a].cast<double>().dot(
                   mesh.vertex[b].cast<double>().cross(mesh.vertex[c].cast<double>())) /
               6.0;
    }
    return sum;
}

Eigen::AlignedBox3f box_of(const ObjectMesh& mesh) {
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& v : mesh.vertex) box.extend(v);
    return box;
}

}  // namespace

TEST_CASE("a file's parts keep their names", "[mesh_file]") {
    const MeshFile mesh = read(wedge(false));
    CHECK(mesh.vertex.size() == 6);  // equal corners of the two parts are one vertex
    CHECK(mesh.triangle.size() == 8);
    REQUIRE(mesh.part.size() == 2);
    CHECK(mesh.part[0].node == "hull");
    CHECK(mesh.part[1].node == "deck");
    CHECK(mesh.part[1].material == "shiny");
}

TEST_CASE("a placed mesh stands where and how it should", "[mesh_file]") {
    for (const bool inside_out : {false, true}) {
        MeshFile mesh = read(wedge(inside_out));
        turn_outward(mesh, std::vector<std::string>{"tin", "steel"});
        const ObjectMesh placed = placed_mesh(
            mesh,
            {.base = {100.0, 50.0, 7.0}, .heading_deg = 90.0, .metres = 0.5, .largest_edge = 0.2},
            {MaterialId{1}, MaterialId{2}});
        // Half the size; 4 long along its heading, east.
        const Eigen::AlignedBox3f box = box_of(placed);
        CHECK((box.min() - Eigen::Vector3f(99.0f, 49.5f, 7.0f)).norm() < 1e-4f);
        CHECK((box.max() - Eigen::Vector3f(101.0f, 50.5f, 7.5f)).norm() < 1e-4f);
        // The front, high, looks east.
        for (const Eigen::Vector3f& v : placed.vertex) {
            if (v.z() > 7.49f) CHECK(v.x() == Approx(101.0f).margin(1e-4));
        }
        // Neither cutting nor turning changes areas: sqrt(4^2 + 1) x 2 for the deck, 16 + 2 + 2 + 2
        // minus ... for the rest: floor 8, sides 2 x 2, front 2.
        CHECK(area(placed, MaterialId{2}) == Approx(0.25 * 2.0 * std::sqrt(17.0)).epsilon(1e-4));
        CHECK(area(placed, MaterialId{1}) == Approx(0.25 * (8.0 + 4.0 + 2.0)).epsilon(1e-4));
        CHECK(volume(placed) == Approx(0.125 * 4.0).epsilon(2e-3));  // float at 100 m
        // No crack: still closed, and no edge longer than asked.
        const MeshCheck check = check_mesh(placed.vertex, placed.triangle);
        CHECK(check.closed());
        float longest = 0.0f;
        for (const auto& [a, b, c] : placed.triangle) {
            longest = std::max({longest, (placed.vertex[a] - placed.vertex[b]).norm(),
                                (placed.vertex[b] - placed.vertex[c]).norm(),
                                (placed.vertex[c] - placed.vertex[a]).norm()});
        }
        CHECK(longest <= 0.2f + 1e-4f);
    }
}

TEST_CASE("what is no mesh is refused", "[mesh_file]") {
    CHECK_THROWS_AS(read("v 0 0 0\n", "a.txt"), InputError);
    CHECK_THROWS_AS(read("v 0 0 0\nv 1 0 0\n"), InputError);
    CHECK_THROWS_AS(read("v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n"), InputError);
    CHECK_THROWS_AS(read("solid a\nendsolid a\n", "a.stl"), InputError);
    CHECK_THROWS_AS(read("not a mesh", "a.glb"), InputError);
}

TEST_CASE("meshes of vehicles and sheds are read", "[mesh_file][shared]") {
    const auto folder = shared_data("data/objects");
    if (!folder) return;
    // Sizes as in the folder's SOURCE.md.
    const std::map<std::string, Eigen::Vector3d> size = {
        {"CesiumMilkTruck.obj", {4.87, 2.84, 2.79}},
        {"kenney_vehicle-truck-green.obj", {1.5, 1.4, 2.9}},
        {"kenney_vehicle-truck-green.glb", {1.5, 1.4, 2.9}},
        {"kenney_vehicle-motorcycle.obj", {1.1, 1.27, 2.4}},
        {"kenney_decoration-tents.obj", {10.0, 4.2, 10.0}}};
    for (const auto& [name, expected] : size) {
        CAPTURE(name);
        const MeshFile mesh = read_mesh_file(*folder / name);
        Eigen::AlignedBox3d box;
        for (const Eigen::Vector3d& v : mesh.vertex) box.extend(v);
        CHECK((box.sizes() - expected).cwiseAbs().maxCoeff() < 0.06);
    }
    const MeshFile truck = read_mesh_file(*folder / "kenney_vehicle-truck-green.obj");
    CHECK(truck.part.size() == 6);  // the body, four wheels, the underside
}
