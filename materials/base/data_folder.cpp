#include "materials/base/data_folder.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <vector>

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// The folders of the file this code stands in (a library's, where it is part of one) and of the
/// program that runs.
std::vector<fs::path> own_places() {
    std::error_code unknown;
    std::vector<fs::path> places;
    Dl_info found{};
    if (dladdr(reinterpret_cast<const void*>(&data_folder), &found) != 0 &&
        found.dli_fname != nullptr && found.dli_fname[0] == '/') {
        places.push_back(fs::weakly_canonical(found.dli_fname, unknown).parent_path());
    }
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
    if (!unknown) places.push_back(program.parent_path());
    return places;
}

/// The folder that holds materials/ and scenes/: the first that does.
fs::path find_root() {
    std::vector<fs::path> roots;
    for (const fs::path& place : own_places()) {
        roots.push_back((place / "../share/diurna").lexically_normal());
        roots.push_back(place / "share/diurna");
    }
    roots.insert(roots.end(), {DIURNA_SOURCE_DIR, "/usr/local/share/diurna", "/usr/share/diurna"});
    std::error_code none;
    const auto holds = [&](const fs::path& root) {
        return fs::is_regular_file(root / "materials" / "library.toml", none);
    };
    const auto found = std::find_if(roots.begin(), roots.end(), holds);
    return found == roots.end() ? DIURNA_SOURCE_DIR : *found;
}

const fs::path& own_root() {
    static const fs::path root = find_root();
    return root;
}

}  // namespace

fs::path data_folder() {
    const char* named = std::getenv("DIURNA_DATA");
    return named != nullptr ? fs::path(named) : own_root() / "materials";
}

fs::path samples_folder() { return own_root() / "scenes"; }

}  // namespace diurna
