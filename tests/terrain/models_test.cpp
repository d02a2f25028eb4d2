#include "terrain/objects/models/models.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "terrain/objects/mesh_check.hpp"
#include "terrain/objects/models/net.hpp"
#include "terrain/objects/models/panel_box.hpp"
#include "terrain/objects/models/plates.hpp"
#include "terrain/objects/models/turned.hpp"
#include "terrain/objects/models/workpiece.hpp"
#include "terrain/objects/obj_file.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

using Eigen::Vector3d;

/// (triangle) which solid it belongs to: triangles that share vertices.
std::vector<std::uint32_t> solids_of(const MeshFile& mesh) {
    std::vector<std::uint32_t> up(mesh.vertex.size());
    std::iota(up.begin(), up.end(), 0u);
    const auto top = [&](std::uint32_t v) {
        while (up[v] != v) v = up[v] = up[up[v]];
        return v;
    };
    for (const auto& [a, b, c] : mesh.triangle) {
        up[top(a)] = top(b);
        up[top(b)] = top(c);
    }
    std::vector<std::uint32_t> solid;
    for (const auto& corner : mesh.triangle) solid.push_back(top(corner[0]));
    return solid;
}

struct Solid {
    double volume = 0.0, area = 0.0;
    double plan = 0.0;  // sum of the level parts of areas, signed: 0 if closed
    std::map<std::array<std::uint32_t, 2>, int> edges;
};

std::map<std::uint32_t, Solid> measured(const MeshFile& mesh) {
    const std::vector<std::uint32_t> of = solids_of(mesh);
    std::map<std::uint32_t, Solid> all;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        const auto& corner = mesh.triangle[t];
        Solid& solid = all[of[t]];
        const Vector3d origin = mesh.vertex[of[t]];
        const Vector3d a = mesh.vertex[corner[0]] - origin, b = mesh.vertex[corner[1]] - origin,
                       c = mesh.vertex[corner[2]] - origin;
        solid.volume += a.dot(b.cross(c)) / 6.0;
        solid.area += 0.5 * (b - a).cross(c - a).norm();
        solid.plan += 0.5 * (b - a).cross(c - a).z();
        for (std::size_t k = 0; k < 3; ++k) ++solid.edges[{corner[k], corner[(k + 1) % 3]}];
    }
    return all;
}

Vector3d size_of(const MeshFile& mesh) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& v : mesh.vertex) box.extend(v);
    return box.sizes();
}

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_CASE("a rounded box encloses what Steiner's formula says",
          "[terrain][models][by_comparison]") {
    // V = abc + 2 (ab + bc + ca) r + pi r^2 (a + b + c) + 4/3 pi r^3 of the inner box a, b, c;
    // facets of 90/n degrees cut the arcs' area by sin(x)/x, x = 90/n degrees.
    const int arc = GENERATE(2, 4, 12);
    Workpiece work{.mesh = {}, .fine = {.edge = 0.25, .arc = arc}};
    add_box(work, "box", {0.0, 0.0, 0.0}, {2.0, 1.4, 1.0}, 0.2);
    const double a = 1.6, b = 1.0, c = 0.6, r = 0.2;
    const double exact = a * b * c + 2.0 * (a * b + b * c + c * a) * r + pi * r * r * (a + b + c) +
                         4.0 / 3.0 * pi * r * r * r;
    const double x = 0.5 * pi / arc, loss = 1.0 - std::sin(x) / x;
    const double rounded = pi * r * r * (a + b + c) + 4.0 / 3.0 * pi * r * r * r;
    const double volume = enclosed_volume(work.mesh);
    CHECK(volume < exact);
    CHECK(volume > exact - 1.5 * loss * rounded);
}

TEST_CASE("turned solids enclose what Pappus says", "[terrain][models][by_comparison]") {
    // A prism of n corners for a cylinder, n/2 sin(2 pi / n) r^2 h; the half circle of a sphere.
    Workpiece work{.mesh = {}, .fine = {.edge = 0.2, .arc = 3}};
    add_bar(work, "bar", {1.0, 2.0, 0.5}, {1.0, 3.0, 1.5}, 0.1);
    const double area = 0.5 * 6 * std::sin(2.0 * pi / 6) * 0.01;
    CHECK(enclosed_volume(work.mesh) == Approx(area * std::sqrt(2.0)).epsilon(1e-9));
    Workpiece ball{.mesh = {}, .fine = {.edge = 0.05, .arc = 16}};
    add_drum(ball, "ball", {0.0, -0.5, 0.0}, {0.0, 0.5, 0.0}, 0.5, 0.5);
    CHECK(enclosed_volume(ball.mesh) == Approx(pi / 6.0).epsilon(5e-3));
}

TEST_CASE("plates lose their holes, belts have their length", "[terrain][models]") {
    Workpiece work{.mesh = {}, .fine = {.edge = 0.3, .arc = 2}};
    add_plate(work, "plate", {{1.0, 1.0, 1.0}, Vector3d::UnitX(), Vector3d::UnitZ()},
              {2.0, 1.0, 0.1}, {{0.2, 0.7, 0.3, 0.8}, {1.0, 1.9, 0.1, 0.2}});
    CHECK(enclosed_volume(work.mesh) == Approx(0.1 * (2.0 - 0.25 - 0.09)).epsilon(1e-12));
    // A square belt 3 m long outside, 0.1 thick: 4 (3 - 0.1) 0.1 of cross section.
    Workpiece belt{.mesh = {}, .fine = {.edge = 0.3, .arc = 2}};
    add_belt(belt, "belt", {{0.0, 0.0}, {3.0, 0.0}, {3.0, 3.0}, {0.0, 3.0}}, 0.1, -0.2, 0.3);
    CHECK(enclosed_volume(belt.mesh) == Approx(0.5 * 4.0 * 2.9 * 0.1).epsilon(1e-9));
    // A box with one panel 0.1 m in.
    Workpiece recessed{.mesh = {}, .fine = {.edge = 0.3, .arc = 2}};
    add_box(recessed, PanelBox{.part = "box",
                               .low = {0, 0, 0},
                               .high = {1, 1, 1},
                               .panels = {{Side::left, 0.2, 0.6, 0.1, 0.7, "window", 0.1}}});
    CHECK(enclosed_volume(recessed.mesh) == Approx(1.0 - 0.1 * 0.4 * 0.6).epsilon(1e-12));
}

TEST_CASE("every solid of every model is closed and looks outward", "[terrain][models]") {
    const std::vector<std::string> names = model_names();
    REQUIRE(names.size() == 11);
    for (const std::string& name : names) {
        std::size_t fewer = 0;
        for (const Detail detail : {Detail::low, Detail::medium, Detail::high}) {
            const MeshFile mesh = model_mesh(name, detail);
            CAPTURE(name, static_cast<int>(detail), mesh.triangle.size());
            CHECK(mesh.triangle.size() >= 2000);
            CHECK(mesh.triangle.size() <= 20000);
            CHECK(mesh.triangle.size() > fewer * 3 / 2);
            fewer = mesh.triangle.size();
            std::size_t open_edges = 0, inside_out = 0, leaking = 0;
            for (const auto& [number, solid] : measured(mesh)) {
                for (const auto& [edge, count] : solid.edges) {
                    const auto back = solid.edges.find({edge[1], edge[0]});
                    if (count != 1 || back == solid.edges.end()) ++open_edges;
                }
                if (!(solid.volume > 1e-6)) ++inside_out;
                if (std::abs(solid.plan) > 1e-9 * solid.area) ++leaking;
            }
            CHECK(open_edges == 0);
            CHECK(inside_out == 0);
            CHECK(leaking == 0);
            std::vector<Eigen::Vector3f> vertex;
            for (const Vector3d& v : mesh.vertex) vertex.push_back(v.cast<float>());
            CHECK(check_mesh(vertex, mesh.triangle).closed());
            double lowest = 1e9;
            for (const Vector3d& v : mesh.vertex) lowest = std::min(lowest, v.z());
            CHECK(lowest == Approx(0.0).margin(1e-9));
        }
    }
}

TEST_CASE("no model has slivers", "[terrain][models]") {
    for (const std::string& name : model_names()) {
        const MeshFile mesh = model_mesh(name, Detail::low);
        double worst = 1.0;
        for (const auto& [i, j, k] : mesh.triangle) {
            const Vector3d a = mesh.vertex[i], b = mesh.vertex[j], c = mesh.vertex[k];
            const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
            worst = std::min(worst, (b - a).cross(c - a).norm() / (longest * longest));
        }
        CAPTURE(name, worst);
        CHECK(worst > 0.004);  // height over longest edge
    }
}

TEST_CASE("models have the sizes that they state", "[terrain][models]") {
    const auto size = [](const char* name) { return size_of(model_mesh(name, Detail::high)); };
    // ISO 668: 6.058 x 2.438 x 2.591 m.
    CHECK((size("container") - Vector3d(2.438, 6.058, 2.591)).norm() < 0.03);
    // From the drawings' own dimensions: fronts and backs of the foremost and rearmost solids.
    CHECK(size("truck").y() == Approx(3.66 + 3.6).margin(1e-6));
    CHECK(size("truck").z() == Approx(2.95).margin(2e-3));
    CHECK(size("tractor_and_trailer").z() == Approx(3.9).margin(1e-6));
    CHECK(size("aircraft").x() == Approx(17.0).margin(1e-6));
    CHECK(size("mast").z() == Approx(21.0).margin(1e-6));
    CHECK(size("hangar").x() == Approx(30.0).margin(1.0));
}

TEST_CASE("a house, a tank and a wheel enclose their own", "[terrain][models]") {
    // The house's largest solid: 10 x 8 x 5.6 m and a gable from 5.6 to 8.2 m, less 12 cm behind 12
    // windows of 1.3 x 1.3, and 8 of 1.0 x 1.3, half of the first being 1.1 wide, and a door.
    double largest = 0.0;
    for (const auto& [number, solid] : measured(model_mesh("house", Detail::low))) {
        largest = std::max(largest, solid.volume);
    }
    const double windows = 0.12 * 1.3 * (6 * 1.3 + 6 * 1.1 + 8 * 1.0), door = 0.1 * 1.0 * 2.1;
    CHECK(largest == Approx(80.0 * 5.6 + 0.5 * 80.0 * 2.6 - windows - door).epsilon(1e-9));
    // The tank: a cylinder of 1.4 m, 8 m long, its edges rounded by 0.35 m (Pappus: the square
    // corner less its quarter circle, whose centroid is (10 - 3 pi) / (12 - 3 pi) r from the
    // sides).
    largest = 0.0;
    for (const auto& [number, solid] : measured(model_mesh("fuel_tank", Detail::high))) {
        largest = std::max(largest, solid.volume);
    }
    const double r = 0.35, corner = (1.0 - pi / 4.0) * r * r,
                 in = r * (10.0 - 3.0 * pi) / (12.0 - 3.0 * pi);
    const double exact = pi * 1.4 * 1.4 * 8.0 - 2.0 * corner * 2.0 * pi * (1.4 - in);
    CHECK(largest == Approx(exact).epsilon(3e-3));
    CHECK(largest < exact);
}

TEST_CASE("a net hangs clear of what it covers and stands open", "[terrain][models]") {
    MeshFile mesh = model_mesh("truck", Detail::low);
    const std::size_t vertices = mesh.vertex.size(), triangles = mesh.triangle.size();
    add_net(mesh, 0.4, 0.3);
    CHECK(mesh.part.back().material == "camouflage_net");
    for (std::size_t v = vertices; v < mesh.vertex.size(); ++v) {
        CHECK(mesh.vertex[v].z() >= 0.1 - 1e-9);
    }
    double highest = 0.0;
    for (const Vector3d& v : mesh.vertex) highest = std::max(highest, v.z());
    CHECK(highest == Approx(2.95 + 0.4).margin(0.05));
    std::map<std::array<std::uint32_t, 2>, int> sides;
    for (std::size_t t = triangles; t < mesh.triangle.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.triangle[t][k], b = mesh.triangle[t][(k + 1) % 3];
            ++sides[{std::min(a, b), std::max(a, b)}];
        }
    }
    for (const auto& [edge, count] : sides) {  // it ends at its hem alone
        if (count == 2) continue;
        REQUIRE(mesh.vertex[edge[0]].z() == Approx(0.1).margin(1e-9));
        REQUIRE(mesh.vertex[edge[1]].z() == Approx(0.1).margin(1e-9));
    }
    // Straight above the truck's every vertex the net is higher by its clearance, except for its
    // own squares' sag over an edge.
    double least = 1e9;
    for (std::size_t v = 0; v < vertices; ++v) {
        const Vector3d p = mesh.vertex[v];
        for (std::size_t t = triangles; t < mesh.triangle.size(); ++t) {
            Eigen::Matrix2d m;
            const Vector3d a = mesh.vertex[mesh.triangle[t][0]],
                           b = mesh.vertex[mesh.triangle[t][1]],
                           c = mesh.vertex[mesh.triangle[t][2]];
            m.col(0) = (b - a).head<2>();
            m.col(1) = (c - a).head<2>();
            const Eigen::Vector2d w = m.inverse() * (p - a).head<2>();
            if (w.minCoeff() < 0.0 || w.sum() > 1.0) continue;
            least = std::min(least, a.z() + w.x() * (b - a).z() + w.y() * (c - a).z() - p.z());
        }
    }
    CHECK(least > 0.3);
}

TEST_CASE("a model written as OBJ is read as it was", "[terrain][models]") {
    const ScratchFolder folder("models");
    for (const std::string name : {"generator", "aircraft"}) {
        const MeshFile mesh = model_mesh(name, Detail::low);
        write_obj(folder.path / "model.obj", mesh, name);
        const MeshFile read = read_mesh_file(folder.path / "model.obj");
        CHECK(read.triangle.size() == mesh.triangle.size());
        CHECK(enclosed_volume(read) == Approx(enclosed_volume(mesh)).epsilon(1e-4));
        std::map<std::string, int> parts;
        for (const MeshFile::Part& part : mesh.part) ++parts[part.node];
        for (const MeshFile::Part& part : read.part) CHECK(parts.count(part.node) == 1);
        CHECK(read.part.size() == mesh.part.size());
    }
}
