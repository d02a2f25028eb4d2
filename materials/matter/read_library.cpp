#include "materials/matter/read_library.hpp"

#include <filesystem>
#include <map>
#include <mutex>

#include "materials/base/data_folder.hpp"
#include "materials/matter/read_material.hpp"

namespace diurna {

MaterialLibrary read_material_library(const Document& document) {
    const Section root = document.root();
    MaterialLibrary library;
    for (const std::string& name : root.free_keys()) {
        const Section section = root.section(name, "a material by this name");
        library.add(read_material(section, library, name));
    }
    document.finish();
    return library;
}

MaterialLibrary load_material_library(const std::filesystem::path& file) {
    return read_material_library(Document::from_file(file));
}

MaterialLibrary default_material_library() {
    static std::mutex guard;
    static std::map<std::filesystem::path, MaterialLibrary> known;
    const std::filesystem::path file = data_folder() / "library.toml";
    const std::lock_guard lock(guard);
    auto found = known.find(file);
    if (found == known.end()) found = known.emplace(file, load_material_library(file)).first;
    return found->second;
}

}  // namespace diurna
