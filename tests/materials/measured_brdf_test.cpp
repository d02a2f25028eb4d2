#include "materials/matter/measured_brdf.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/microfacet.hpp"
#include "materials/matter/read_brdf.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/matter/read_material.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

using Brdf = std::function<double(const Eigen::Vector3d& eye, const Eigen::Vector3d& light)>;

Eigen::Vector3d towards(double angle_deg, double azimuth_deg = 0.0) {
    const double a = radians(angle_deg), p = radians(azimuth_deg);
    return {std::sin(a) * std::cos(p), std::sin(a) * std::sin(p), std::cos(a)};
}

/// A file of the MERL database (Matusik et al. 2003) of an analytic BRDF, at the cells' middles;
/// −1 below the horizon, as their files have it.
void write_merl(const std::filesystem::path& path, const Brdf& f) {
    const std::int32_t size[3] = {90, 90, 180};
    std::vector<double> values(3u * 90u * 90u * 180u);
    const double scale[3] = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
    for (std::size_t h = 0; h < 90; ++h) {
        const double theta_h = radians((double(h) + 0.5) * (double(h) + 0.5) / 90.0);
        const Eigen::Vector3d half(std::sin(theta_h), 0.0, std::cos(theta_h));
        const Eigen::Vector3d across = Eigen::Vector3d::UnitY(), along = across.cross(half);
        for (std::size_t d = 0; d < 90; ++d) {
            const double theta_d = radians(double(d) + 0.5);
            for (std::size_t p = 0; p < 180; ++p) {
                const double phi = radians(double(p) + 0.5);
                const Eigen::Vector3d light =
                    half * std::cos(theta_d) +
                    std::sin(theta_d) * (std::cos(phi) * along + std::sin(phi) * across);
                const Eigen::Vector3d eye = 2.0 * half.dot(light) * half - light;
                const bool seen = light.z() > 0.0 && eye.z() > 0.0;
                for (std::size_t c = 0; c < 3; ++c) {
                    values[((c * 90 + h) * 90 + d) * 180 + p] =
                        seen ? f(eye, light) / scale[c] : -1.0;
                }
            }
        }
    }
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(size), sizeof size);
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(double)));
}

/// A CSV of light_deg, eye_deg, azimuth_deg, brdf_sr.
std::string table(const std::function<double(double, double, double)>& f, double step = 10.0) {
    std::ostringstream out;
    out.precision(10);
    out << "light_deg,eye_deg,azimuth_deg,brdf_sr\n";
    for (double i = 0.0; i <= 90.0; i += step) {
        for (double o = 0.0; o <= 90.0; o += step) {
            for (double p = 0.0; p <= 180.0; p += 30.0) {
                out << i << ',' << o << ',' << p << ',' << f(i, o, p) << '\n';
            }
        }
    }
    return out.str();
}

std::string refusal(const std::filesystem::path& path) {
    try {
        read_brdf(path);
    } catch (const InputError& error) {
        REQUIRE(error.mistakes().size() == 1);
        return error.mistakes().front().line();
    }
    return "";
}

/// ∫ f cosθ dω over lights, by midpoints in the light's own angles.
double over_lights(const Brdf& f, const Eigen::Vector3d& eye) {
    constexpr int rings = 900, spokes = 900;
    double sum = 0.0;
    for (int i = 0; i < rings; ++i) {
        const double theta = (i + 0.5) / rings * 90.0;
        for (int k = 0; k < spokes; ++k) {
            const Eigen::Vector3d light = towards(theta, (k + 0.5) / spokes * 180.0);
            sum += f(eye, light) * light.z() * std::sin(radians(theta));
        }
    }
    return sum * 2.0 * (0.5 * std::numbers::pi / rings) * (std::numbers::pi / spokes);
}

}  // namespace

// Minnaert: f = c (cosθ_in cosθ_out)^(k−1), R(θ) = 2π c / (k + 1) cos^(k−1) θ; k = 1 is Lambert.
TEST_CASE("a MERL file of Minnaert's law reflects as his formula integrates",
          "[materials][brdf][by_comparison]") {
    const double k = GENERATE(1.0, 1.4);
    const double c = 0.12;
    const ScratchFolder folder("merl");
    write_merl(folder.path / "minnaert.binary", [&](const auto& eye, const auto& light) {
        return c * std::pow(eye.z() * light.z(), k - 1.0);
    });
    const MeasuredBrdf read = read_brdf(folder.path / "minnaert.binary");
    for (const double angle : {0.0, 10.0, 30.0, 50.0, 60.0, 70.0}) {
        const double cosine = std::cos(radians(angle));
        const double expected = 2.0 * std::numbers::pi * c / (k + 1.0) * std::pow(cosine, k - 1.0);
        CAPTURE(k, angle);
        CHECK(directional_hemispherical(read, cosine) == Approx(expected).epsilon(0.01));
    }
}

TEST_CASE("a MERL file of a metal's lobe reflects as the lobe integrates",
          "[materials][brdf][by_comparison]") {
    const Microfacets surface{.roughness = 0.25};
    const Brdf lobe = [&](const Eigen::Vector3d& eye, const Eigen::Vector3d& light) {
        if (eye.z() <= 0.0 || light.z() <= 0.0) return 0.0;
        return 0.8 * surface.lobe((eye + light).normalized().z(), eye.z(), light.z());
    };
    const ScratchFolder folder("lobe");
    write_merl(folder.path / "lobe.binary", lobe);
    const MeasuredBrdf read = read_brdf(folder.path / "lobe.binary");
    for (const double angle : {5.0, 40.0, 65.0}) {
        const Eigen::Vector3d eye = towards(angle);
        CAPTURE(angle);
        CHECK(directional_hemispherical(read, eye.z()) ==
              Approx(over_lights(lobe, eye)).epsilon(0.01));
        const Eigen::Vector3d light = towards(30.0, 170.0);
        CHECK(brdf(read, eye, light) == Approx(lobe(eye, light)).epsilon(0.03));
        CHECK(brdf(read, eye, light) == Approx(brdf(read, light, eye)).epsilon(1e-9));
    }
}

TEST_CASE("a table of angles reflects as its formula", "[materials][brdf]") {
    const ScratchFolder folder("table");
    const auto path = folder.path / "own.csv";
    write_whole_file(path, table([](double, double, double) { return 0.3 / std::numbers::pi; }));
    const MeasuredBrdf flat = read_brdf(path);
    CHECK(directional_hemispherical(flat, 0.5) == Approx(0.3).epsilon(2e-3));
    CHECK(brdf(flat, towards(20.0), towards(47.0, 33.0)) ==
          Approx(0.3 / std::numbers::pi).epsilon(1e-6));
    // Brighter where the eye stands at the light's side: f = (1 + cos φ sinθ sinθ') / 10, of which
    // the cosine vanishes in the sum: R = π / 10.
    write_whole_file(path, table(
                               [](double i, double o, double p) {
                                   return 0.1 * (1.0 + std::cos(radians(p)) * std::sin(radians(i)) *
                                                           std::sin(radians(o)));
                               },
                               5.0));
    const MeasuredBrdf sided = read_brdf(path);
    CHECK(directional_hemispherical(sided, std::cos(radians(40.0))) ==
          Approx(std::numbers::pi / 10.0).epsilon(5e-3));
    CHECK(brdf(sided, towards(40.0, 100.0), towards(40.0, 100.0)) >
          1.5 * brdf(sided, towards(40.0, 100.0), towards(40.0, -80.0)));
}

TEST_CASE("a measured finish keeps its energy under a sun anywhere",
          "[materials][brdf][by_trace]") {
    const ScratchFolder folder("finish");
    const auto path = folder.path / "own.csv";
    write_whole_file(path, table(
                               [](double i, double o, double p) {
                                   return 0.1 * (1.0 + std::cos(radians(p)) * std::sin(radians(i)) *
                                                           std::sin(radians(o)));
                               },
                               5.0));
    Material material;
    material.reflectance = flat_spectrum(0.4);
    material.finish = finish_of(read_brdf(path));
    CHECK(directional_optics(material, 9.0, laboratory_cosine).diffuse == Approx(0.4));
    const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();
    const Eigen::Vector3d eye = Eigen::Vector3d(0.1, 0.6, 0.7).normalized();
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), normal);
    const auto share = [&](double cosine) {
        return directional_optics(material, 9.0, cosine).diffuse;
    };
    const double mean = hemispherical_optics(material, 9.0).diffuse;
    double sum = 0.0;
    constexpr int n = 200;
    for (int i = 0; i < n; ++i) {
        const double theta = (i + 0.5) / n * 90.0;
        for (int k = 0; k < n; ++k) {
            const Eigen::Vector3d local = towards(theta, (k + 0.5) / n * 360.0);
            sum += measured_lobe(material.finish, normal, eye, turn * local) * share(local.z()) *
                   local.z() * std::sin(radians(theta));
        }
    }
    sum *= (0.5 * std::numbers::pi / n) * (2.0 * std::numbers::pi / n) / std::numbers::pi / mean;
    CHECK(sum == Approx(1.0).epsilon(0.01));
    CHECK(measured_lobe(Lambert{}, normal, eye, eye) == 1.0);
}

TEST_CASE("a BRDF that cannot be is refused in one line", "[materials][brdf]") {
    const ScratchFolder folder("refused");
    const auto path = folder.path / "own.csv";
    const auto reported = [&](const std::string& text) {
        write_whole_file(path, text);
        return refusal(path);
    };
    CHECK_THAT(reported(table([](double, double, double) { return 0.4; })),
               Catch::Contains("own.csv: reflects 1.257 of the light at 0 deg"));
    CHECK_THAT(reported(table([](double i, double, double) { return 0.1 + 0.001 * i; })),
               Catch::Contains("not reciprocal"));
    CHECK_THAT(
        reported("light_deg,eye_deg,azimuth_deg,brdf_sr\n0,0,0,0.1\n0,0,180,0.1\n0,60,0,0.1\n"
                 "0,60,180,0.1\n60,0,0,0.1\n60,0,180,0.1\n60,60,0,0.1\n70,60,180,0.1\n"),
        Catch::Contains("no row of light 60, eye 60, azimuth 180"));
    CHECK_THAT(reported("light_deg,eye_deg,azimuth_deg,brdf_sr\n0,0,0,-0.1\n"),
               Catch::Contains("own.csv:2:"));
    const auto merl = folder.path / "short.binary";
    write_whole_file(merl, std::string("short"));
    CHECK_THAT(refusal(merl), Catch::Contains("not a MERL BRDF"));
    CHECK_THAT(refusal(folder.path / "own.dat"), Catch::Contains("expected a .binary"));
}

TEST_CASE("a material takes a measured BRDF by its key", "[materials][brdf]") {
    const ScratchFolder folder("key");
    write_whole_file(folder.path / "own.csv", table([](double, double, double) { return 0.05; }));
    const auto read = [&](const std::string& file) {
        const Document document = Document::from_text(
            "[material]\nname = \"own\"\nlike = \"concrete\"\nfinish = { kind = \"measured\", file "
            "= \"" +
                file + "\" }\n",
            (folder.path / "column.toml").string());
        const Material found = read_material(document.root().required_section("material", ""),
                                             default_material_library());
        document.finish();
        return found;
    };
    const Material own = read("own.csv");
    CHECK(std::get<ByAngle>(own.finish).measured != nullptr);
    CHECK(own.needs_rays());
    try {
        read("none.csv");
        FAIL("a file that is not there was taken");
    } catch (const InputError& error) {
        REQUIRE(error.mistakes().size() == 1);
        CHECK_THAT(error.mistakes().front().line(),
                   Catch::Contains("column.toml:4:") && Catch::Contains("none.csv"));
    }
}
