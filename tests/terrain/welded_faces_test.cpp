#include "terrain/objects/welded_faces.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>

#include "terrain/objects/facing.hpp"
#include "terrain/objects/open_pieces.hpp"
#include "tests/support/read_mesh.hpp"

using namespace diurna;

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// A square of two triangles, then `more` of a second part.
MeshFile square_and(std::vector<Corners> more) {
    MeshFile mesh{.vertex = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                  .triangle = {{0, 1, 2}, {0, 2, 3}},
                  .part_of = {0, 0},
                  .part = {{"a", ""}, {"b", ""}}};
    for (const Corners& corner : more) {
        mesh.triangle.push_back(corner);
        mesh.part_of.push_back(1);
    }
    return mesh;
}

bool is_open(const MeshFile& mesh) {
    ObjectMesh placed;
    for (const auto& v : mesh.vertex) placed.vertex.push_back(v.cast<float>());
    placed.triangle = mesh.triangle;
    placed.material.resize(mesh.triangle.size());
    for (const std::uint8_t open : open_pieces(placed)) {
        if (open == 0) return false;
    }
    return true;
}

const std::vector<std::string> alike = {"tin", "tin"}, unlike = {"tin", "cloth"};

}  // namespace

TEST_CASE("a sheet written twice is one sheet, whichever way the copy faces",
          "[terrain][objects]") {
    const std::vector<Corners> copy = GENERATE(std::vector<Corners>{{1, 2, 0}, {0, 2, 3}},
                                               std::vector<Corners>{{0, 2, 1}, {3, 2, 0}});
    MeshFile mesh = square_and(copy);
    CHECK_FALSE(is_open(mesh));
    const WeldedFaces found = weld_faces(mesh, alike);
    CHECK(found.removed == 2);
    CHECK(mesh.triangle == std::vector<Corners>{{0, 1, 2}, {0, 2, 3}});
    CHECK(mesh.part_of == std::vector<std::uint16_t>{0, 0});
    CHECK(is_open(mesh));
}

TEST_CASE("faces of two materials in one place are reported", "[terrain][objects]") {
    MeshFile same_way = square_and({{2, 0, 1}});
    const WeldedFaces contested = weld_faces(same_way, unlike);
    REQUIRE(contested.contested);
    CHECK(*contested.contested == std::array<std::uint32_t, 2>{0, 1});

    MeshFile reversed = square_and({{0, 2, 1}});
    const WeldedFaces kept = weld_faces(reversed, unlike);
    CHECK_FALSE(kept.contested);
    CHECK(kept.back_to_back == 1);
    CHECK(kept.removed == 0);
    CHECK(reversed.triangle.size() == 3);
}

TEST_CASE("triangles whose corners lie on a line are skipped", "[terrain][objects]") {
    MeshFile mesh = square_and({{0, 1, 4}});
    const WeldedFaces found = weld_faces(mesh, alike);
    CHECK(found.flat == 1);
    CHECK(mesh.triangle.size() == 2);
}

// Triangles of a reversed polygon go out from its last corner: along the other diagonal.
TEST_CASE("a sheet written twice is one sheet, along whichever diagonal it is cut",
          "[terrain][objects]") {
    const std::vector<Corners> copy = GENERATE(std::vector<Corners>{{3, 2, 1}, {3, 1, 0}},
                                               std::vector<Corners>{{0, 1, 3}, {1, 2, 3}});
    MeshFile mesh = square_and(copy);
    const WeldedFaces found = weld_faces(mesh, alike);
    CHECK(found.removed == 2);
    CHECK(mesh.triangle == std::vector<Corners>{{0, 1, 2}, {0, 2, 3}});
    CHECK(is_open(mesh));
}

TEST_CASE("faces of two materials cut along two diagonals are back to back", "[terrain][objects]") {
    MeshFile reversed = square_and({{3, 2, 1}, {3, 1, 0}});
    const WeldedFaces kept = weld_faces(reversed, unlike);
    CHECK_FALSE(kept.contested);
    CHECK(kept.back_to_back == 2);
    CHECK(reversed.triangle == std::vector<Corners>{{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}});
    CHECK(reversed.part_of == std::vector<std::uint16_t>{0, 0, 1, 1});
    MeshFile same_way = square_and({{0, 1, 3}, {1, 2, 3}});
    CHECK(weld_faces(same_way, unlike).contested);
}

// A square of one edge more, and a grid of bent pieces, each even.
TEST_CASE("patches in one place are found by their borders", "[terrain][objects]") {
    MeshFile cut = square_and({});
    cut.vertex.push_back({0.4, 0.0, 0.0});
    for (const Corners& corner : {Corners{3, 2, 5}, {2, 1, 5}, {3, 5, 0}}) {
        cut.triangle.push_back(corner);
        cut.part_of.push_back(1);
    }
    CHECK(weld_faces(cut, alike).removed == 3);
    MeshFile roof{.vertex = {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {0, 1, 0}, {1, 1, 1}, {2, 1, 0}},
                  .triangle = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}},
                  .part_of = {0, 0, 0, 0, 0, 0, 0, 0},
                  .part = {{"a", ""}, {"b", ""}}};
    for (const Corners& corner : {Corners{3, 4, 1}, {3, 1, 0}, {4, 5, 2}, {4, 2, 1}}) {
        roof.triangle.push_back(corner);
    }
    CHECK(weld_faces(roof, alike).removed == 4);
    CHECK(is_open(roof));
    // Two tiles beside each other, the second one's border is none of the first's.
    MeshFile beside = square_and({{1, 4, 2}});
    CHECK(weld_faces(beside, alike).removed == 0);
    CHECK(beside.triangle.size() == 3);
}

TEST_CASE("walls between boxes that touch are removed, whichever way the boxes face",
          "[terrain][objects]") {
    // n x n unit boxes in one block, some inside out: surface 2 n² + 4 n, volume n².
    const int n = GENERATE(2, 3, 4);
    const unsigned turned = GENERATE(0u, 1u, 0x5a5au, 0xffffu);
    CAPTURE(n, turned);
    MeshFile mesh{.part = {{"a", ""}}};
    std::map<std::array<double, 3>, std::uint32_t> number;
    for (int k = 0; k < n * n; ++k) {
        const read_mesh::Box box{.low = {double(k / n), double(k % n), 0.0},
                                 .inside_out = (turned >> k & 1u) != 0};
        for (const auto& corner : box.triangles()) {
            Corners triangle{};
            for (std::size_t c = 0; c < 3; ++c) {
                const auto [known, fresh] = number.try_emplace(
                    {corner[c].x(), corner[c].y(), corner[c].z()}, std::uint32_t(number.size()));
                if (fresh) mesh.vertex.push_back(corner[c]);
                triangle[c] = known->second;
            }
            mesh.triangle.push_back(triangle);
            mesh.part_of.push_back(0);
        }
    }
    const std::vector<std::string> tin = {"tin"};
    const WeldedFaces found = weld_faces(mesh, tin);
    CHECK(found.inner == std::size_t(2 * 2 * n * (n - 1)));
    turn_outward(mesh, tin);
    CHECK(read_mesh::area(mesh) == Approx(2.0 * n * n + 4.0 * n));
    CHECK(read_mesh::volume(mesh) == Approx(double(n * n)));
}

TEST_CASE("a fin written twice on a box remains once", "[terrain][objects]") {
    MeshFile mesh{.part = {{"a", ""}}};
    for (const auto& corner : read_mesh::Box{.low = {0, 0, 0}}.triangles()) {
        Corners triangle{};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto at = std::find(mesh.vertex.begin(), mesh.vertex.end(), corner[c]);
            triangle[c] = std::uint32_t(at - mesh.vertex.begin());
            if (at == mesh.vertex.end()) mesh.vertex.push_back(corner[c]);
        }
        mesh.triangle.push_back(triangle);
        mesh.part_of.push_back(0);
    }
    const auto find = [&](const Eigen::Vector3d& at) {
        return std::uint32_t(std::find(mesh.vertex.begin(), mesh.vertex.end(), at) -
                             mesh.vertex.begin());
    };
    const std::uint32_t a = find({0, 0, 1}), b = find({1, 0, 1}),
                        tip = std::uint32_t(mesh.vertex.size());
    mesh.vertex.push_back({0.5, 0.0, 2.0});
    for (const Corners& fin : {Corners{a, b, tip}, Corners{b, a, tip}}) {
        mesh.triangle.push_back(fin);
        mesh.part_of.push_back(0);
    }
    const WeldedFaces found = weld_faces(mesh, std::vector<std::string>{"tin"});
    CHECK(found.inner == 0);
    CHECK(found.removed == 1);
    CHECK(mesh.triangle.size() == 13);
}
