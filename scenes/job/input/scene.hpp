#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/confines.hpp"
#include "materials/base/files_read.hpp"
#include "materials/matter/library.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/input/read_air.hpp"
#include "scenes/job/input/read_contrast.hpp"
#include "scenes/job/input/read_crossover.hpp"
#include "scenes/job/input/read_detection.hpp"
#include "scenes/job/input/read_instrument.hpp"
#include "scenes/job/input/read_labels.hpp"
#include "scenes/job/input/read_observer.hpp"
#include "scenes/job/input/read_output.hpp"
#include "scenes/job/input/read_plumes.hpp"
#include "scenes/job/input/read_radiometer.hpp"
#include "scenes/job/input/read_sensitivity.hpp"
#include "scenes/job/input/read_signature.hpp"
#include "scenes/job/input/read_sweep.hpp"
#include "scenes/job/input/read_terrain.hpp"
#include "scenes/job/input/read_textures.hpp"
#include "scenes/job/input/read_time.hpp"
#include "scenes/job/input/read_trajectory.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "thermal/weather/clear_sky.hpp"
#include "thermal/weather_file/weather_section.hpp"

/// The whole input of a job as plain values: the content of a scene file, with units converted,
/// ranges checked and file names resolved. Places are east, north [m] from the site.
namespace diurna {

struct WeatherInput {
    std::filesystem::path file;                  // the first of `files`
    std::vector<std::filesystem::path> files{};  // of one format, joined
    WeatherOptions options;       // except place and span, which are those of the scene
    std::string measured_over{};  // a material; "": the only one
    HeightKeys by_height{};
};

struct Scene {
    std::filesystem::path file;
    Confines confines;  // folders of the files it names, and of files named in those
    std::string name;
    std::string title;
    std::optional<Site> site;  // none: the middle of the raster; height NaN: the ground there
    TerrainInput terrain;
    std::shared_ptr<const Dem> elevation{};  // read already, for places that needed it
    MaterialLibrary materials;               // the program's own with the scene's added
    WeatherInput weather;
    ClearSky sky;
    AirInput air;
    TimeInput time;
    OutputInput output;
    LabelsInput labels;
    std::vector<BandInput> bands;
    std::vector<CubeInput> cubes;
    std::vector<PlumeInput> plumes;
    std::vector<RadiometerInput> radiometers;
    std::vector<TextureInput> textures;
    TextureUses texture_uses;
    std::vector<TrajectoryInput> trajectories;
    std::vector<ObserverInput> observers;
    std::vector<InstrumentInput> instruments;
    std::vector<SignatureInput> signatures;
    std::vector<DetectionInput> detections;
    std::vector<CrossoverInput> crossovers;
    std::vector<ContrastInput> contrasts;
    std::vector<SensitivityInput> sensitivities;
    std::vector<UncertainInput> uncertain;  // for planes sigma.BAND
    SweepInput sweep;
    double tolerance = 0.0;        // [K] rms of pictures, for facets not visible; 0: all solved
    bool tolerance_given = false;  // it is in the file
    int rounds = 2;  // at most, of solving again with finer settings (scenes/job/run/rounds.hpp)
    bool exact = false;  // no shortcut: `tolerance` is 0, and other tolerances as well
    std::vector<std::string> idle_sky_keys{};  // unused keys of [sky], replaced by `air`
    int sky_rays = 64;                         // per facet of the ground
    int object_sky_rays = 256;                 // per facet of buildings and objects
    int sun_samples = 4;                       // per facet and instant
    double finer_edges = 1.0;                  // divides the edges of all facets
    int check_points = 128;                    // points in pictures that are solved separately
    std::uint64_t seed = 1;
    std::vector<FileRead> files{};  // all files opened for it so far
    // The content of the file, with settings: all of it, and without the tables used only by
    // pictures.
    std::string said{}, said_but_for_pictures{};
};

}  // namespace diurna
