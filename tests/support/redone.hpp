#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/small_scene.hpp"

/// What a third party can add up again: the radiance of pixels from the planes of a picture and the
/// library of materials alone. The sum stands here once more, with Planck's law and quadratures of
/// its own; of the program only the readers of files are called.
namespace redone {

using namespace diurna;
namespace fs = std::filesystem;

/// [W m⁻² sr⁻¹ µm⁻¹]; constants of CODATA 2018.
inline double black_body(double um, double kelvins) {
    constexpr double c1 = 1.191042972e8, c2 = 1.438776877e4;
    return c1 / (std::pow(um, 5) * std::expm1(c2 / (um * kelvins)));
}

/// Of unpolarised light on a smooth face of index n + ik (Born & Wolf 1.5).
inline double fresnel(double n, double k, double cosine) {
    const std::complex<double> index(n, k);
    const std::complex<double> inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
    const auto s = (cosine - index * inside) / (cosine + index * inside);
    const auto p = (index * cosine - inside) / (index * cosine + inside);
    return 0.5 * (std::norm(s) + std::norm(p));
}
/// Of the sun on a white surface facing it: a black body of 5772 K, 6.8e-5 sr wide.
inline double sunlight(double um) { return 6.8e-5 / std::numbers::pi * black_body(um, 5772.0); }

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
        while (frame.find(name("weight", surfaces_ + 1))) ++surfaces_;
        has_rays_ = frame.find("rest." + band_) != nullptr;
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
        double sum = double(frame_["path." + band_].pixel[p]) + rest(p);
        for (int k = 1; k <= surfaces_; ++k) {
            const double weight = at(name("weight", k), p);
            if (weight > 0.0) sum += weight * (sent(k, p) + shown(k, p));
        }
        return sum;
    }
    /// What is seen past others and is not listed.
    double rest(std::size_t p) const { return has_rays_ ? of_band("rest", p) : 0.0; }
    /// Whether a surface of the pixel mirrors.
    bool has_mirror(std::size_t p) const {
        for (int k = 1; k <= surfaces_ && has_rays_; ++k) {
            if (of_band(name("mirror", k), p) > 0.0) return true;
        }
        return false;
    }
    /// By how much the reflectance that the library's n and k make is another than that of the
    /// planes, the most of a pixel's surfaces that are seen straight and not at grazing angles,
    /// where the slopes of waves count. A pane has two faces: 2 R / (1 + R) where it is clear.
    double off_fresnel(std::size_t p) const {
        double worst = 0.0;
        for (int k = 1; k <= surfaces_ && has_rays_; ++k) {
            const double cosine = at(name("cosine", k), p), found = of_band(name("mirror", k), p);
            if (at(name("way", k), p) != 0.0 || found <= 0.0 || cosine < 0.5) continue;
            const Material& of = material(k, p);
            const auto& finish = std::get<Glossy>(of.finish);
            const double kelvins = at(name("temperature", k), p);
            const auto light = [&](double um) { return black_body(um, kelvins) + sunlight(um); };
            const auto mirrored = [&](double um) {
                const double r = fresnel(finish.index.at(um), extinction(finish, um), cosine);
                const bool clear = finish.pane && um < 2.0;
                return light(um) * (clear ? 2.0 * r / (1.0 + r) : r);
            };
            const double expected = integral(band_, mirrored) / integral(band_, light);
            worst = std::max(worst, std::abs(expected - found));
        }
        return worst;
    }
    double at(const std::string& plane, std::size_t p) const {
        return double(frame_[plane].pixel[p]);
    }

 private:
    static std::string name(const std::string& of, int k) { return of + "_" + std::to_string(k); }
    double of_band(const std::string& plane, std::size_t p) const {
        return at(plane + "." + band_, p);
    }
    const Material& material(int k, std::size_t p) const {
        const auto id = static_cast<std::uint16_t>(at(name("material", k), p));
        return materials_[MaterialId{id}];
    }
    static double extinction(const Glossy& finish, double um) {
        return finish.extinction.value.empty() ? 0.0 : finish.extinction.at(um);
    }

    /// What a surface mirrors at large, and the air before it where it is seen past another.
    double shown(int k, std::size_t p) const {
        if (!has_rays_) return 0.0;
        return of_band(name("mirrored", k), p) + of_band(name("air", k), p);
    }

    /// Of the k-th surface, at the eye, without the air before it.
    double sent(int k, std::size_t p) const {
        const auto in_band = [&](const char* of) { return of_band(name(of, k), p); };
        const double sky_and_all =
            in_band("skylight") * in_band("reflectance_sky") * in_band("transmittance_sky") +
            in_band("surroundings") * in_band("reflectance_surroundings") *
                in_band("transmittance_surroundings") +
            in_band("behind");
        if (at(name("facet", k), p) < 0.0) {  // smoke, or the sky
            return in_band("black") * in_band("emissivity") * in_band("transmittance");
        }
        const Material& material = this->material(k, p);
        const double sun_here =
            sun_ * at(name("sun_fraction", k), p) * at(name("cosine_sun", k), p);
        const double kelvins = at(name("temperature", k), p);
        if (material.needs_rays()) {  // by the planes: the angle decides
            const double black =
                integral(band_, [&](double um) { return black_body(um, kelvins); });
            return black * in_band("emissivity") * in_band("transmittance") +
                   sun_here * in_band("reflectance_sun") * in_band("transmittance_sun") +
                   sky_and_all;
        }
        const double emitted = integral(band_, [&](double um) {
            const double reflected = material.reflectance.at(um);
            const double through =
                material.transmittance.value.empty() ? 0.0 : material.transmittance.at(um);
            return (1.0 - reflected - through) * black_body(um, kelvins);
        });
        const double reflectance =
            integral(band_, [&](double um) { return material.reflectance.at(um); }) /
            (edges(band_)[1] - edges(band_)[0]);
        return emitted * in_band("transmittance") +
               sun_here * reflectance * in_band("transmittance_sun") + sky_and_all;
    }

    const Frame& frame_;
    std::string band_;
    const MaterialLibrary& materials_;
    double sun_ = 0.0;
    int surfaces_ = 0;
    bool has_rays_ = false;  // planes of what is seen in mirrors and through panes
};

struct Found {
    double worst = 0.0;  // relative
    std::size_t pixels = 0, mixed = 0, partly_lit = 0, two_levels = 0;
    std::size_t not_listed = 0;  // whose surfaces miss 0.5 % and more of the radiance
    double off_fresnel = 0.0;    // the most of a reflectance
};

/// 200 pixels that see a mirror, as water and window glass are, straight.
inline Found redo_mirrors(const Job& job, const std::string& observer, const std::string& band,
                          const char* time) {
    const Frame frame = job.frame(observer, band, time);
    const Redone redone(frame, band, job.materials);
    const std::vector<float>& radiance = frame["radiance." + band].pixel;
    std::mt19937 random(11);
    Found found;
    for (int tries = 0; found.pixels < 200 && tries < 100000; ++tries) {
        const std::size_t p = random() % frame.pixels();
        if (redone.at("unlisted", p) > 0.0 || !redone.has_mirror(p)) continue;
        const bool listed = std::abs(redone.rest(p)) < 0.005 * double(radiance[p]);
        if (!listed) {
            ++found.not_listed;
            continue;
        }
        ++found.pixels;
        found.off_fresnel = std::max(found.off_fresnel, redone.off_fresnel(p));
        found.worst = std::max(found.worst, std::abs(redone.sum(p) / double(radiance[p]) - 1.0));
    }
    return found;
}

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

/// A pond before it and the hangar's glass front, from a height [m].
inline std::string waterside(const std::string& height) {
    std::string text = airfield() +
                       "[[ground]]\nname = \"pond\"\nmaterial = \"water\"\nrectangle_m = [110.0, "
                       "-40.0, 60.0, 40.0, 0.0]\nlargest_edge_m = 15.0\n";
    text = with(text, "height_above_ground_m = 40.0", "height_above_ground_m = " + height);
    text = with(text, "look_at_m = [60.0, 0.0]", "look_at_m = [75.0, -60.0]");
    return with(text, "surfaces = 8", "surfaces = 24");
}

}  // namespace redone
