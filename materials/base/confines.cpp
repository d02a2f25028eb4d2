#include "materials/base/confines.hpp"

#include <algorithm>
#include <system_error>

#include "materials/base/data_folder.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Without links, "." and ".." (a file is beneath itself), whether it exists or not. Sets `problem`
/// where that cannot be reported.
fs::path resolved(const fs::path& path, std::error_code& problem) {
    const fs::path whole = fs::absolute(path, problem);  // else what is not there stays relative
    return problem ? whole : fs::weakly_canonical(whole, problem);
}

/// As it is named where links cannot be followed.
fs::path resolved_root(const fs::path& path) {
    std::error_code problem;
    const fs::path named = path.empty() ? fs::path(".") : path, found = resolved(named, problem);
    return problem ? fs::absolute(named, problem).lexically_normal() : found;
}

bool lies_beneath(const fs::path& file, const fs::path& folder) {
    const auto [rest, same] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return rest == folder.end();
}

}  // namespace

Confines confines_of(const fs::path& file) {
    return {.folders = {resolved_root(file.parent_path()), resolved_root(file),
                        resolved_root(data_folder()), resolved_root(samples_folder())}};
}

Confines confines_of(const fs::path& file, bool allow_outside) {
    Confines confines = confines_of(file);
    confines.everywhere = allow_outside;
    return confines;
}

std::string why_not(const Confines& confines, const fs::path& file) {
    std::error_code problem;
    const fs::path path = resolved(file, problem);
    if (problem) return "is a link that leads to no file";
    const bool inside =
        confines.everywhere ||
        std::any_of(confines.folders.begin(), confines.folders.end(),
                    [&](const fs::path& folder) { return lies_beneath(path, folder); });
    if (!inside) return "is outside the folder of the file that names it";
    const fs::file_status status = fs::status(path, problem);
    if (fs::exists(status) && !fs::is_regular_file(status)) return "is not a regular file";
    return "";
}

}  // namespace diurna
