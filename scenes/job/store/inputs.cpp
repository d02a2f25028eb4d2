#include "scenes/job/store/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "materials/base/data_folder.hpp"
#include "materials/base/files.hpp"
#include "scenes/job/store/digest.hpp"

namespace diurna {

namespace fs = std::filesystem;

/// SHA-256 of the sources, made when they are built (scenes/job/store/program_digest.cmake).
const char* program_sources();

namespace {

/// Finer elevation and land cover.
std::vector<fs::path> rasters_on_ground(const Scene& scene) {
    std::vector<fs::path> files;
    for (const DetailInput& detail : scene.terrain.elevation.details) {
        files.insert(files.end(), detail.files.begin(), detail.files.end());
    }
    for (const LandCoverInput& cover : scene.terrain.land_cover) files.push_back(cover.file);
    return files;
}

/// Those that the scene names itself, opened yet or not.
std::vector<fs::path> named_files(const Scene& scene) {
    std::vector<fs::path> files{scene.file, scene.terrain.elevation.file, scene.air.table_file,
                                scene.air.sounding_file, scene.time.state};
    files.insert(files.end(), scene.weather.files.begin(), scene.weather.files.end());
    files.insert(files.end(), scene.terrain.elevation.tiles.begin(),
                 scene.terrain.elevation.tiles.end());
    for (const fs::path& file : rasters_on_ground(scene)) files.push_back(file);
    for (const ShapesInput& shapes : scene.terrain.shapes) files.push_back(shapes.file);
    const ObjectInput* before = nullptr;
    for (const ObjectInput& object : scene.terrain.objects) {
        const bool again =
            before != nullptr && !object.copy_of.empty() && object.copy_of == before->copy_of;
        before = &object;
        if (again) continue;
        for (const fs::path& file : {object.file, object.target.file, object.copies_file}) {
            files.push_back(file);
        }
    }
    for (const BandInput& band : scene.bands) files.push_back(band.file);
    for (const TextureInput& texture : scene.textures) files.push_back(texture.file);
    for (const PlumeInput& plume : scene.plumes) files.push_back(plume.file);
    for (const TrajectoryInput& way : scene.trajectories) files.push_back(way.file);
    return files;
}

/// What a reader of a raster or of shapes may open beside it: all that is called like it.
std::vector<fs::path> files_beside(const fs::path& file) {
    std::vector<fs::path> beside;
    const std::string stem = file.stem().string() + ".";
    std::error_code ignored;
    for (const auto& entry :
         fs::directory_iterator(file.parent_path().empty() ? "." : file.parent_path(), ignored)) {
        if (entry.path().filename().string().starts_with(stem)) {
            beside.push_back(file.parent_path() / entry.path().filename());
        }
    }
    return beside;
}

std::set<fs::path> listed_inputs(const Scene& scene) {
    std::set<fs::path> files;
    const auto add = [&](const fs::path& file) {
        std::error_code ignored;
        if (fs::is_regular_file(file, ignored)) files.insert(file.lexically_normal());
    };
    for (const fs::path& file : named_files(scene)) add(file);
    std::vector<fs::path> read_with_sidecars{scene.terrain.elevation.file};
    const auto& tiles = scene.terrain.elevation.tiles;
    read_with_sidecars.insert(read_with_sidecars.end(), tiles.begin(), tiles.end());
    for (const fs::path& file : rasters_on_ground(scene)) read_with_sidecars.push_back(file);
    for (const ShapesInput& shapes : scene.terrain.shapes)
        read_with_sidecars.push_back(shapes.file);
    for (const TextureInput& texture : scene.textures) read_with_sidecars.push_back(texture.file);
    for (const fs::path& file : read_with_sidecars) {
        if (file.empty()) continue;
        for (const fs::path& beside : files_beside(file)) {
            if (why_not(scene.confines, beside).empty()) add(beside);  // else no reader may have it
        }
    }
    for (const auto& entry : fs::recursive_directory_iterator(data_folder())) {
        const std::string extension = entry.path().extension();
        if (extension == ".csv" || extension == ".toml") add(entry.path());
    }
    return files;
}

/// The same for the same files, wherever their folder lies and whatever the working folder is.
std::string input_name(const fs::path& path, const Scene& scene) {
    const fs::path real = fs::weakly_canonical(path);
    const std::pair<const char*, fs::path> bases[] = {
        {"scene", fs::weakly_canonical(fs::absolute(scene.file).parent_path())},
        {"data", fs::weakly_canonical(data_folder())}};
    for (const auto& [says, base] : bases) {
        const fs::path below = real.lexically_relative(base);
        if (!below.empty() && *below.begin() != "..")
            return fmt::format("{}/{}", says, below.string());
    }
    return real.string();
}

}  // namespace

std::vector<RunInput> run_inputs(const Scene& scene) {
    for (const FileRead& file : scene.files) {
        if (is_unchanged(file)) continue;
        throw std::runtime_error(
            file.path.string() +
            ": changed while it was being read; run again when no other program writes to it");
    }
    std::set<fs::path> files = listed_inputs(scene);
    std::set<fs::path> real;
    for (const fs::path& file : files) real.insert(fs::weakly_canonical(file));
    for (const FileRead& file : scene.files) {
        if (real.insert(fs::weakly_canonical(file.path)).second) files.insert(file.path);
    }
    std::vector<RunInput> inputs;
    for (const fs::path& file : files) {
        inputs.push_back({file, input_name(file, scene), sha256_of_file(file)});
    }
    return inputs;
}

std::vector<FileRead> named_inputs(const Scene& scene) {
    std::vector<FileRead> files;
    std::error_code none;
    for (const fs::path& file : named_files(scene)) {
        if (fs::is_regular_file(file, none)) files.push_back({.path = file});
    }
    return files;
}

std::string job_key(const std::vector<RunInput>& inputs, const std::vector<std::string>& settings) {
    std::string text =
        fmt::format("{} {}\n{}", DIURNA_VERSION, program_sources(), DIURNA_LIBRARIES);
    for (const std::string& setting : settings) text += fmt::format("\nset {}", setting);
    std::map<std::string, std::string> by_name;
    for (const RunInput& input : inputs) by_name[input.name] = input.sha256;
    for (const auto& [name, sha256] : by_name) text += fmt::format("\n{} {}", sha256, name);
    return sha256(text);
}

}  // namespace diurna
