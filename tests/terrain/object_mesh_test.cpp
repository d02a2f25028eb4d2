#include "terrain/objects/box.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>

#include "materials/base/error.hpp"
#include "terrain/objects/mesh_check.hpp"
#include "terrain/objects/ply_file.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

const PrivateTempFolder private_temp_folder;

const BoxSpec hangar{.base = {100.0, 200.0, 30.0},
                     .width = 40.0,
                     .depth = 20.0,
                     .height = 8.0,
                     .heading_deg = 90.0,
                     .sunk = 2.0,
                     .largest_edge = 3.0,
                     .wall = MaterialId{1},
                     .front = MaterialId{2},
                     .roof = MaterialId{3}};

struct Side {
    double area = 0.0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // area-weighted
};

std::map<MaterialId, Side> sides(const ObjectMesh& mesh) {
    std::map<MaterialId, Side> result;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector3d across =
            (mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]).cast<double>();
        result[mesh.material[t]].area += 0.5 * across.norm();
        result[mesh.material[t]].normal += 0.5 * across;
    }
    return result;
}

}  // namespace

TEST_CASE("a box has the area of its sides and looks outward", "[terrain][object]") {
    const auto side = sides(box(hangar));
    REQUIRE(side.size() == 3);
    const Side front = side.at(MaterialId{2}), roof = side.at(MaterialId{3});
    CHECK(front.area == Approx(40.0 * 10.0));
    CHECK((front.normal - Eigen::Vector3d(400.0, 0.0, 0.0)).norm() < 1e-2);  // heading east
    CHECK(roof.area == Approx(800.0));
    CHECK((roof.normal - Eigen::Vector3d(0.0, 0.0, 800.0)).norm() < 1e-2);
    CHECK(side.at(MaterialId{1}).area == Approx(400.0 + 2.0 * 200.0));
    // What is left of the closed surface's vanishing sum of normals is the open floor.
    CHECK((side.at(MaterialId{1}).normal - Eigen::Vector3d(-400.0, 0.0, 0.0)).norm() < 1e-2);
}

TEST_CASE("a box is open only at its floor, with short edges", "[terrain][object]") {
    const ObjectMesh mesh = box(hangar);
    const MeshCheck check = check_mesh(mesh.vertex, mesh.triangle);
    CHECK(check.rejected_triangles == 0);
    CHECK_FALSE(check.closed());
    for (const auto& corner : mesh.triangle) {
        for (int k = 0; k < 3; ++k) {
            CHECK((mesh.vertex[corner[k]] - mesh.vertex[corner[(k + 1) % 3]]).norm() < 3.001f);
        }
    }
    // Divisions of ceil(length √2 / 3): 19 across, 10 along.
    CHECK(check.boundary_edges == 2 * (19 + 10));
    float low = 1e9f, high = -1e9f;
    for (const auto& v : mesh.vertex) {
        low = std::min(low, v.z());
        high = std::max(high, v.z());
    }
    CHECK(low == 28.0f);
    CHECK(high == 38.0f);
}

TEST_CASE("a tetrahedron is closed, and its faults are counted", "[terrain][object]") {
    const std::vector<Eigen::Vector3f> vertex{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    std::vector<std::array<std::uint32_t, 3>> triangle{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    SECTION("whole") {
        const MeshCheck check = check_mesh(vertex, triangle);
        CHECK(check.closed());
    }
    SECTION("with a hole") {
        triangle.pop_back();
        const MeshCheck check = check_mesh(vertex, triangle);
        CHECK(check.boundary_edges == 3);
        CHECK_FALSE(check.closed());
    }
    SECTION("with a turned, a degenerate and a wild triangle") {
        std::swap(triangle[3][0], triangle[3][1]);
        triangle.push_back({0, 0, 1});
        triangle.push_back({0, 1, 99});
        CHECK(check_mesh(vertex, triangle).rejected_triangles == 3);
    }
}

TEST_CASE("a box without extent is refused", "[terrain][object][stress]") {
    BoxSpec spec = hangar;
    SECTION("no width") { spec.width = 0.0; }
    SECTION("negative depth") { spec.depth = -3.0; }
    SECTION("no edge length") { spec.largest_edge = 0.0; }
    SECTION("not a number") { spec.base.z() = std::nan(""); }
    CHECK_THROWS_AS(box(spec), InputError);
}

TEST_CASE("a PLY file holds what was given", "[terrain][object]") {
    const auto file = std::filesystem::temp_directory_path() / "diurna_object_mesh_test.ply";
    const std::vector<Eigen::Vector3d> vertex{{0.1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}};
    write_ply(file, vertex, triangle);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    std::filesystem::remove(file);
    const auto body = bytes.find("end_header\n") + 11;
    REQUIRE(bytes.size() == body + 3 * 24 + 13);
    double x = 0.0;
    std::copy_n(bytes.data() + body, sizeof x, reinterpret_cast<char*>(&x));
    CHECK(x == 0.1);
    CHECK(bytes[body + 72] == 3);
    CHECK_THROWS_AS(write_ply("/no/such/folder/x.ply", vertex, triangle), InputError);
}
