#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "render/picture/exr.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/job.hpp"
#include "tests/support/small_scene.hpp"

/// What a third party can add up anew: the radiance of pixels from the planes of a picture and the
/// library of materials alone. The sum stands here once more, with Planck's law and quadratures of
/// its own; of the program only the readers of files are called.
namespace redone {

using namespace diurna;
namespace fs = std::filesystem;
inline constexpr int surfaces = 8;

/// [W m⁻² sr⁻¹ µm⁻¹]; constants of CODATA 2018.
inline double black_body(double um, double kelvins) {
    constexpr double c1 = 1.191042972e8, c2 = 1.438776877e4;
    return c1 / (std::pow(um, 5) * std::expm1(c2 / (um * kelvins)));
}

/// "8-12"
inline std::array<double, 2> edges(const std::string& band) {
    const std::size_t dash = band.find('-');
    return {std::stod(band.substr(0, dash)), std::stod(band.substr(dash + 1))};
}

/// ∫ f(λ) dλ over a band by midpoints of 4000 steps.
template <class Function>
double integral(const std::string& band, const Function& f) {
    const auto [from, to] = edges(band);
    constexpr int steps = 4000;
    const double step = (to - from) / steps;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += step * f(from + (i + 0.5) * step);
    return sum;
}

/// A run's pictures, and the materials its indices mean.
struct Job {
    ScratchFolder folder{"redone"};
    MaterialLibrary materials;

    explicit Job(const std::string& text) {
        const fs::path file = folder.path / "scene.toml";
        write_text(file, text);
        materials = prepare(read_scene(file)).scene.materials;
        run_job(read_scene(file), {.out = folder.path / "out", .settings = {}});
    }
    Frame frame(const std::string& observer, const std::string& band, const char* time) const {
        return read_exr(folder.path / "out/frames" /
                        (observer + "_" + band + "_20260715T" + time + "Z.exr"));
    }
};

/// A picture's radiance, pixel by pixel.
class Redone {
 public:
    Redone(const Frame& frame, std::string band, const MaterialLibrary& materials)
        : frame_(frame), band_(std::move(band)), materials_(materials) {
        // What the sun sends on a plane facing it, over π: of the pixel that faces it most.
        double most = 0.0;
        for (std::size_t p = 0; p < frame.pixels(); ++p) {
            const double facing = at("sun_fraction_1", p) * at("cosine_sun_1", p);
            if (facing <= most) continue;
            most = facing;
            sun_ = of_band("sunlight_1", p) / facing;
        }
    }

    double sum(std::size_t p) const {
        double sum = double(frame_["path." + band_].pixel[p]);
        for (int k = 1; k <= surfaces; ++k) {
            const double weight = at(name("weight", k), p);
            if (weight > 0.0) sum += weight * sent(k, p);
        }
        return sum;
    }
    double at(const std::string& plane, std::size_t p) const {
        return double(frame_[plane].pixel[p]);
    }

 private:
    static std::string name(const std::string& of, int k) { return of + "_" + std::to_string(k); }
    double of_band(const std::string& plane, std::size_t p) const {
        return at(plane + "." + band_, p);
    }

    /// Of the k-th surface, at the eye, without the air before it.
    double sent(int k, std::size_t p) const {
        const auto in_band = [&](const char* of) { return of_band(name(of, k), p); };
        const auto id = static_cast<std::uint16_t>(at(name("material", k), p));
        const Material& material = materials_[MaterialId{id}];
        const double kelvins = at(name("temperature", k), p);
        const double emitted = integral(band_, [&](double um) {
            const double reflected = material.reflectance.at(um);
            const double through =
                material.transmittance.value.empty() ? 0.0 : material.transmittance.at(um);
            return (1.0 - reflected - through) * black_body(um, kelvins);
        });
        const double reflectance =
            integral(band_, [&](double um) { return material.reflectance.at(um); }) /
            (edges(band_)[1] - edges(band_)[0]);
        const double sunlight =
            sun_ * at(name("sun_fraction", k), p) * at(name("cosine_sun", k), p);
        return emitted * in_band("transmittance") +
               sunlight * reflectance * in_band("transmittance_sun") +
               in_band("skylight") * in_band("reflectance_sky") * in_band("transmittance_sky") +
               in_band("surroundings") * in_band("reflectance_surroundings") *
                   in_band("transmittance_surroundings") +
               in_band("behind");
    }

    const Frame& frame_;
    std::string band_;
    const MaterialLibrary& materials_;
    double sun_ = 0.0;
};

struct Found {
    double worst = 0.0;  // relative
    std::size_t pixels = 0, mixed = 0, partly_lit = 0, two_levels = 0;
};

/// 200 pixels anywhere in the picture that are wholly listed; of those whose surface an edge of a
/// shadow crosses, 40 if there are so many.
inline Found redo(const Job& job, const std::string& observer, const std::string& band,
                  const char* time) {
    const Frame frame = job.frame(observer, band, time);
    const Redone redone(frame, band, job.materials);
    const std::vector<float>& radiance = frame["radiance." + band].pixel;
    std::mt19937 random(7);
    Found found;
    for (int tries = 0; found.pixels < 200 && tries < 100000; ++tries) {
        const std::size_t p = random() % frame.pixels();
        if (redone.at("unlisted", p) > 0.0 || redone.at("weight_1", p) == 0.0) continue;
        const double sun = redone.at("sun_fraction_1", p);
        const bool partly = sun > 0.02 && sun < 0.98;
        if (tries < 50000 && (partly ? found.partly_lit == 40 : found.pixels == 160)) continue;
        ++found.pixels;
        found.partly_lit += partly;
        const bool mixed = redone.at("weight_2", p) > 0.0;
        found.mixed += mixed;
        found.two_levels += mixed && redone.at("place_1", p) == redone.at("place_2", p);
        found.worst = std::max(found.worst, std::abs(redone.sum(p) / double(radiance[p]) - 1.0));
    }
    return found;
}

/// An observer near the small scene's hangar; the runway textured in albedo.
inline std::string airfield() {
    std::string text = small_scene();
    for (const auto& [from, to] :
         {std::pair{"radius_m = 4000.0", "radius_m = 900.0"},
          {"frame_every_s = 21600.0", "frame_every_s = 28800.0"},
          {"material = \"asphalt\"", "material = \"asphalt\"\ntexture = \"worn\""},
          {"place_m = [2000.0, 1100.0]", "place_m = [160.0, 60.0]"},
          {"height_above_ground_m = 450.0", "height_above_ground_m = 40.0"},
          {"look_at_m = [0.0, 0.0]", "look_at_m = [60.0, 0.0]"},
          {"horizontal_fov_deg = 24.0", "horizontal_fov_deg = 60.0"},
          {"bands = [\"3-5\", \"8-12\"]",
           "bands = [\"3-5\", \"8-12\", \"0.62-0.66\"]\nsurfaces = 8"}}) {
        text = with(text, from, to);
    }
    return text +
           "[[texture]]\nname = \"worn\"\nstd = 0.03\ncorrelation_length_m = 4.0\nlevels = 3\n";
}

}  // namespace redone
