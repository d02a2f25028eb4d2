#include "scenes/input/read_observer.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/input/checked_names.hpp"

namespace diurna {

namespace {

/// A field of view, or a focal plane behind a lens, or the width of a picture of parallel rays.
void read_projection(const Section& section, ObserverInput& observer) {
    const std::vector<std::string> names = {"pinhole", "equidistant", "equisolid", "panorama",
                                            "orthographic"};
    const std::string name = section.word_or("projection", "pinhole", names);
    const auto found = std::find(names.begin(), names.end(), name);
    observer.projection = static_cast<Projection>(found - names.begin());
    if (observer.projection == Projection::orthographic) {
        observer.picture_width = section.number("picture_width_m", 0.01, 2e5);
    } else if (section.has("focal_length_mm")) {
        const double focal_length = section.number("focal_length_mm", 0.1, 1e5);
        const double pitch = section.number("pixel_pitch_um", 0.1, 1e4);
        observer.horizontal_fov_deg = field_of_view_deg(observer.width, pitch, focal_length);
        if (observer.projection != Projection::pinhole || section.has("horizontal_fov_deg")) {
            section.mistake("focal_length_mm", "is for pinhole cameras without horizontal_fov_deg");
        } else if (!(observer.horizontal_fov_deg <= 150.0)) {
            section.mistake("focal_length_mm",
                            fmt::format("makes a field of view of {:.1f} degrees, expected at most "
                                        "150",
                                        observer.horizontal_fov_deg));
        }
    } else {
        const bool pinhole = observer.projection == Projection::pinhole;
        observer.horizontal_fov_deg = section.number_or(
            "horizontal_fov_deg", pinhole ? 20.0 : 180.0, 0.01, pinhole ? 150.0 : 360.0);
    }
}

AdaptiveOptions read_adaptive(const Section& section) {
    AdaptiveOptions options;
    options.from = section.integer_or("from", options.from, 2, 1024);
    options.to = section.integer_or("to", std::max(options.to, options.from), 2, 4096);
    options.tolerance = section.number_or("tolerance_K", options.tolerance, 1e-4, 100.0);
    if (options.to < options.from) {
        section.mistake("to", fmt::format("{} is less than from, {}", options.to, options.from));
    }
    return options;
}

}  // namespace

ObserverInput read_observer(const Section& section, const std::vector<BandInput>& bands,
                            const std::vector<CubeInput>& cubes) {
    ObserverInput observer;
    observer.name = section.text("name");
    observer.place = place(section, "place_m");
    observer.height_above_ground = section.number("height_above_ground_m", 0.1, 50000);
    if (section.has("look_at_m")) {
        observer.look_at = place(section, "look_at_m");
    } else {
        observer.azimuth_deg = section.number("azimuth_deg", -360, 360);
        observer.elevation_deg = section.number("elevation_deg", -90, 90);
    }
    observer.roll_deg = section.number_or("roll_deg", 0.0, -180, 180);
    observer.width = section.integer_or("width", 640, 1, 16384);
    observer.height = section.integer_or("height", 512, 1, 16384);
    read_projection(section, observer);
    if (section.has("velocity_m_s")) {
        const std::vector<double> velocity = section.numbers("velocity_m_s", 3);
        observer.velocity = {velocity[0], velocity[1], velocity[2]};
        if (!(observer.velocity.cwiseAbs().maxCoeff() <= 1e4)) {
            section.mistake("velocity_m_s", "faster than 10000 m/s");
        }
    }
    observer.row_time = section.number_or("row_time_s", 0.0, 0.0, 60.0);
    observer.exposure = section.number_or("exposure_s", 0.0, 0.0, 60.0);
    for (const char* key : {"row_time_s", "exposure_s"}) {
        if (section.has(key) && !section.has("velocity_m_s")) {
            section.mistake(key,
                            "tells nothing of a camera that stands still, expected "
                            "velocity_m_s = [east, north, up] beside it");
        }
    }
    observer.samples = section.integer_or("samples", 16, 1, 1024);
    if (section.has("adaptive")) {
        observer.adaptive = read_adaptive(section.section("adaptive"));
        if (section.has("samples")) {
            section.mistake("samples", "is for uniform sampling, adaptive says from and to");
        }
        observer.samples = observer.adaptive->from;
    }
    observer.terms = section.flag_or("terms", false);
    observer.bands = section.texts_or("bands", {"3-5", "8-12"});
    for (const std::string& band : observer.bands) {
        try {
            named_band(bands, band);
        } catch (const InputError& error) {
            section.mistake("bands", error.mistakes().front().problem,
                            error.mistakes().front().hint);
        }
    }
    observer.cubes = section.texts_or("cubes", {});
    std::vector<std::string> known;
    for (const CubeInput& cube : cubes) known.push_back(cube.name);
    for (const std::string& cube : observer.cubes) {
        if (std::find(known.begin(), known.end(), cube) == known.end()) {
            section.mistake("cubes", fmt::format("no cube \"{}\" in [[cubes]]", cube),
                            did_you_mean(cube, known));
        }
    }
    return observer;
}

}  // namespace diurna
