// What a third party can add up anew: the radiance of pixels from the planes of a picture and the
// library of materials alone. The sum stands here once more, with Planck's law and quadratures of
// its own; of the program only the readers of files are called.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "render/picture/exr.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/job.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

namespace fs = std::filesystem;
constexpr int surfaces = 8;

/// [W m⁻² sr⁻¹ µm⁻¹]; constants of CODATA 2018.
double black_body(double um, double kelvins) {
    constexpr double c1 = 1.191042972e8, c2 = 1.438776877e4;
    return c1 / (std::pow(um, 5) * std::expm1(c2 / (um * kelvins)));
}

/// "8-12"
std::array<double, 2> edges(const std::string& band) {
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
        // What the sun sends on a plane facing it, over π: of the pixel with most of it.
        for (std::size_t p = 0; p < frame.pixels(); ++p) {
            const double facing = at("sun_fraction_1", p) * at("cosine_sun_1", p);
            if (facing > 0.5) sun_ = std::max(sun_, of_band("sunlight_1", p) / facing);
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
Found redo(const Job& job, const std::string& observer, const std::string& band, const char* time) {
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
    CAPTURE(observer, band, time, found.worst, found.mixed, found.partly_lit, found.two_levels);
    CHECK(found.pixels == 200);
    CHECK(found.worst < 0.005);
    return found;
}

/// An observer near the small scene's hangar; the runway textured in albedo.
std::string airfield() {
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

}  // namespace

TEST_CASE("a textured runway and a hangar are redone from planes and library", "[whole][redone]") {
    const Job job(airfield());
    for (const char* time : {"040000", "120000", "200000"}) {
        for (const char* band : {"3-5", "8-12", "0.62-0.66"}) {
            if (std::string(band) == "0.62-0.66" && std::string(time) == "040000") continue;
            const Found found = redo(job, "east", band, time);
            CHECK(found.two_levels > 20);
        }
    }
}

// Two rows of buildings with a street between them: walls light each other.
TEST_CASE("a street is redone from planes and library", "[whole][redone]") {
    std::string text = airfield();
    for (const char* place : {"[53.0, -108.4]", "[20.0, -60.0]"}) {
        text += "[[building]]\nname = \"" + std::string(place) + "\"\nplace_m = " + place +
                "\nwidth_m = 60.0\ndepth_m = 12.0\nheight_m = 15.0\nheading_deg = 45.0\nwall = "
                "\"painted_steel\"\nroof = \"concrete\"\n";
    }
    text = with(text, "place_m = [53.0, -88.4]", "place_m = [53.0, -20.4]");
    text = with(text, "height_above_ground_m = 40.0", "height_above_ground_m = 130.0");
    text = with(text, "look_at_m = [60.0, 0.0]", "look_at_m = [30.0, -50.0]");
    const Job job(text);
    for (const char* band : {"3-5", "8-12", "0.62-0.66"})
        CHECK(redo(job, "east", band, "200000").partly_lit > 2);
}

// Mirror, pane, net and smoke are in no surface; what is beside them is.
TEST_CASE("what is beside a net and a mirror is redone from planes and library",
          "[whole][redone]") {
    const std::string folder = std::string(DIURNA_SOURCE_DIR) + "/scenes/";
    std::ostringstream file;
    file << std::ifstream(folder + "camouflage/scene.toml").rdbuf();
    std::string text = file.str();
    for (std::size_t at; (at = text.find("../jacksboro")) != std::string::npos;) {
        text.replace(at, 12, folder + "jacksboro");
    }
    for (const char* mesh : {"net.obj", "pane.obj", "sheet.obj", "smoke.csv"}) {
        text = with(text, std::string("\"") + mesh, "\"" + folder + "camouflage/" + mesh);
    }
    text = with(text, "frame_every_s = 21600.0", "frame_every_s = 43200.0");
    text = with(text, "width = 480", "width = 160");
    text = with(text, "height = 240", "height = 80");
    text = with(text, "terms = true", "surfaces = 8");
    text = with(text, "\"visible\", \"mwir\", \"lwir\"", "\"3-5\", \"8-12\", \"0.62-0.66\"");
    text = with(text, "step_s = 600.0", "step_s = 1200.0");
    text = with(text, "sky_rays = 64", "sky_rays = 32");
    const Job job(text);
    for (const char* band : {"3-5", "8-12", "0.62-0.66"}) redo(job, "south", band, "160000");
}
