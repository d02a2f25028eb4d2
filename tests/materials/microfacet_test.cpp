#include "materials/matter/microfacet.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "materials/base/units.hpp"
#include "materials/matter/directional_optics.hpp"

using namespace diurna;

namespace {

double lobe(const Microfacets& surface, const Eigen::Vector3d& eye, const Eigen::Vector3d& light) {
    if (light.z() <= 0.0) return 0.0;
    return surface.lobe((eye + light).normalized().z(), eye.z(), light.z());
}

/// ∫ f over the hemisphere: midpoints in angle, for rough surfaces alone.
template <class F>
double over_hemisphere(const F& f) {
    constexpr int n = 600, m = 600;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        const double theta = (i + 0.5) / n * 0.5 * std::numbers::pi;
        for (int k = 0; k < m; ++k) {
            const double phi = (k + 0.5) / m * 2.0 * std::numbers::pi;
            const Eigen::Vector3d d(std::sin(theta) * std::cos(phi),
                                    std::sin(theta) * std::sin(phi), std::cos(theta));
            sum += f(d) * std::sin(theta);
        }
    }
    return sum * 0.5 * std::numbers::pi / n * 2.0 * std::numbers::pi / m;
}

Eigen::Vector3d at(double angle_deg) {
    return {std::sin(radians(angle_deg)), 0.0, std::cos(radians(angle_deg))};
}

Material coated(Finish finish, double reflectance, double transmittance = 0.0) {
    Material material;
    material.reflectance = flat_spectrum(reflectance);
    if (transmittance > 0.0) material.transmittance = flat_spectrum(transmittance);
    material.finish = std::move(finish);
    return material;
}

Finish glossy(double roughness, double index, double extinction = 0.0) {
    return Glossy{.roughness = roughness,
                  .metal = false,
                  .index = flat_spectrum(index),
                  .extinction = extinction > 0.0 ? flat_spectrum(extinction) : Spectrum{}};
}

}  // namespace

TEST_CASE("Fresnel's formula at the normal, Brewster's angle and grazing",
          "[materials][finish][by_comparison]") {
    CHECK(fresnel(1.0, 1.5) == Approx(0.04).epsilon(1e-12));
    CHECK(fresnel(1e-9, 1.5) == Approx(1.0).epsilon(1e-7));
    // ((n − 1)² + k²) / ((n + 1)² + k²): aluminium at 10 µm, n = 25.3, k = 89.8 (Rakić 1995)
    CHECK(fresnel(1.0, {25.3, 89.8}) ==
          Approx((24.3 * 24.3 + 89.8 * 89.8) / (26.3 * 26.3 + 89.8 * 89.8)).epsilon(1e-12));
    // At Brewster's angle atan n the wave along the plane vanishes, the one across it has
    // ((n² − 1) / (n² + 1))².
    const double brewster = std::atan(1.5);
    const double across = (2.25 - 1.0) / (2.25 + 1.0);
    CHECK(fresnel(std::cos(brewster), 1.5) == Approx(0.5 * across * across).epsilon(1e-12));
    // Total of 60° for n = 1.5 by hand: rs = −0.4202, rp = 0.0425
    CHECK(fresnel(0.5, 1.5) == Approx(0.0892).margin(2e-4));
}

TEST_CASE("microfacets' normals are a distribution, their lobe is reciprocal",
          "[materials][finish]") {
    const double roughness = GENERATE(0.2, 0.5, 1.0);
    const Microfacets surface{.roughness = roughness};
    CAPTURE(roughness);
    CHECK(over_hemisphere([&](const Eigen::Vector3d& h) {
              return surface.density(h.z()) * h.z();
          }) == Approx(1.0).epsilon(2e-4));
    // All that is seen has the area of its outline: ∫ D max(0, v·h) G1 dh = cosθ (Heitz 2014, 14).
    const Eigen::Vector3d eye = at(60.0);
    CHECK(over_hemisphere([&](const Eigen::Vector3d& h) {
              return surface.density(h.z()) * std::max(0.0, eye.dot(h)) /
                     (1.0 + surface.hidden(eye.z()));
          }) == Approx(eye.z()).epsilon(1e-3));
    const Eigen::Vector3d light = Eigen::Vector3d(-0.3, 0.5, 0.7).normalized();
    CHECK(lobe(surface, eye, light) == Approx(lobe(surface, light, eye)).epsilon(1e-12));
}

TEST_CASE("sampled normals weigh the lobe as its integral says", "[materials][finish]") {
    const double roughness = GENERATE(0.2, 0.6), angle = GENERATE(0.0, 40.0, 75.0);
    const Microfacets surface{.roughness = roughness};
    const Eigen::Vector3d eye = at(angle);
    const double exact =
        over_hemisphere([&](const Eigen::Vector3d& d) { return lobe(surface, eye, d) * d.z(); });
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    constexpr int samples = 200000;
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < samples; ++i) {
        const double w = surface.weight(eye, surface.normal(eye, uniform(random), uniform(random)));
        sum += w;
        square += w * w;
    }
    const double mean = sum / samples;
    const double error = std::sqrt((square / samples - mean * mean) / samples);
    CAPTURE(roughness, angle, mean, exact, error);
    CHECK(std::abs(mean - exact) < 4.0 * error + 1e-3);  // 4σ, and the integral's own error
}

TEST_CASE("the table of a rough interface is its integral", "[materials][finish]") {
    const double roughness = GENERATE(0.25, 0.5, 1.0), angle = GENERATE(5.0, 45.0, 70.0);
    const Microfacets surface{.roughness = roughness};
    const Eigen::Vector3d eye = at(angle);
    const auto integral = [&](auto&& reflected) {
        return over_hemisphere([&](const Eigen::Vector3d& d) {
            const double cosine = eye.dot((eye + d).normalized());
            return lobe(surface, eye, d) * d.z() * reflected(cosine);
        });
    };
    const auto glass = [](double c) { return fresnel(c, 1.5); };
    const double exact = integral(glass) / integral([](double) { return 1.0; });
    CAPTURE(roughness, angle);
    CHECK(microfacet_reflectance(surface, eye.z(), glass) == Approx(exact).margin(1e-3));
}

// White furnace: what absorbs nothing returns all of a uniform light, at any angle and roughness.
TEST_CASE("a lossless surface disappears in a uniform light",
          "[materials][finish][furnace][by_degenerate]") {
    const double roughness = GENERATE(0.0, 0.05, 0.3, 1.0), cosine = GENERATE(0.02, 0.3, 0.7, 1.0);
    CAPTURE(roughness, cosine);
    const Material paint = coated(glossy(roughness, 1.5), 1.0);
    const DirectionalOptics white = directional_optics(paint, 10.0, cosine);
    CHECK(white.mirrored + white.diffuse == Approx(1.0).epsilon(1e-3));
    const Material mirror =
        coated(Glossy{.roughness = roughness, .metal = true, .index = {}, .extinction = {}}, 1.0);
    CHECK(directional_optics(mirror, 10.0, cosine).mirrored == Approx(1.0).epsilon(1e-3));
    const Material glass = coated(glossy(roughness, 1.5), 0.1, 0.9);
    const DirectionalOptics clear = directional_optics(glass, 0.6, cosine);
    CHECK(clear.mirrored + clear.diffuse + clear.transmittance == Approx(1.0).epsilon(1e-3));
}

TEST_CASE("emissivity, reflectance and transmittance add up to one and stay in range",
          "[materials][finish][by_trace]") {
    const Finish finish =
        GENERATE(Finish{Lambert{}}, glossy(0.0, 1.33), glossy(0.2, 1.5, 0.3), glossy(1.0, 2.5),
                 Finish{ByAngle{{0.0, 60.0, 90.0}, {1, 2, 9}}},
                 Finish{Glossy{.roughness = 0.4, .metal = true, .index = {}, .extinction = {}}});
    const double reflectance = GENERATE(0.0, 0.02, 0.3, 0.7), cosine = GENERATE(0.01, 0.4, 1.0);
    const bool metal = std::holds_alternative<Glossy>(finish) && std::get<Glossy>(finish).metal;
    const Material material = coated(finish, reflectance, metal ? 0.0 : 0.3);
    const DirectionalOptics o = directional_optics(material, 9.0, cosine);
    CAPTURE(finish.index(), reflectance, cosine);
    CHECK(o.emissivity + o.mirrored + o.diffuse + o.transmittance == Approx(1.0).epsilon(1e-14));
    for (const double part : {o.emissivity, o.mirrored, o.diffuse, o.transmittance}) {
        CHECK(part >= -1e-12);
        CHECK(part <= 1.0 + 1e-12);
    }
    // At 10° the spectra hold.
    const DirectionalOptics lab = directional_optics(material, 9.0, std::cos(radians(10.0)));
    if (!metal) {
        const double factor = finish.index() == 2 ? 1.0 + 10.0 / 60.0 : 1.0;
        CHECK(lab.mirrored + lab.diffuse ==
              Approx(std::min(0.7, factor * reflectance)).margin(1e-12));
        CHECK(lab.transmittance == Approx(0.3).epsilon(1e-12));
    }
}

// Water at 11 µm, n = 1.153, k = 0.0968 (Hale & Querry 1973): Fresnel's formula, worked out apart.
TEST_CASE("calm water emits less at grazing angles", "[materials][finish]") {
    const Material water =
        coated(glossy(0.0, 1.153, 0.0968), fresnel(std::cos(radians(10.0)), {1.153, 0.0968}));
    const auto emissivity = [&](double angle_deg) {
        return directional_optics(water, 11.0, std::cos(radians(angle_deg))).emissivity;
    };
    CHECK(emissivity(0.0) == Approx(0.992943).margin(1e-6));
    CHECK(emissivity(60.0) == Approx(0.968307).margin(1e-6));
    CHECK(emissivity(80.0) == Approx(0.713441).margin(1e-6));
    CHECK(hemispherical_optics(water, 11.0).emissivity < emissivity(10.0));
}

TEST_CASE("a diffuse lobe by angle is reciprocal and keeps its energy",
          "[materials][finish][by_trace]") {
    const Material sand = coated(ByAngle{{0.0, 45.0, 90.0}, {1.0, 1.1, 2.0}}, 0.2);
    const double mean = hemispherical_optics(sand, 9.0).diffuse;
    const auto weight = [&](double c) { return directional_optics(sand, 9.0, c).diffuse / mean; };
    const auto both_ways = [&](double in, double out) { return weight(out) * mean * weight(in); };
    CHECK(both_ways(0.3, 0.8) == Approx(both_ways(0.8, 0.3)).epsilon(1e-12));
    double sum = 0.0;
    constexpr int n = 2000;
    for (int i = 0; i < n; ++i) {
        const double c = (i + 0.5) / n;
        sum += weight(c) * 2.0 * c / n;
    }
    CHECK(sum == Approx(1.0).epsilon(1e-3));
}
