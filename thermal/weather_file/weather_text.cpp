#include "thermal/weather_file/weather_text.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/files_read.hpp"
#include "terrain/raster/zip_archive.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_text_bytes = std::size_t{256} << 20;

std::vector<std::string> members_named(const std::vector<std::string>& members,
                                       std::initializer_list<const char*> endings) {
    std::vector<std::string> named;
    for (const std::string& member : members) {
        const std::filesystem::path path = member;
        const bool own =
            !member.starts_with("__MACOSX/") && !path.filename().string().starts_with('.');
        const std::string ends = small_letters(path.extension().string());
        if (own && std::find(endings.begin(), endings.end(), ends) != endings.end()) {
            named.push_back(member);
        }
    }
    return named;
}

}  // namespace

std::string weather_member(const std::filesystem::path& file) {
    const std::string ends = small_letters(file.extension().string());
    if (ends == ".xlsx" || ends == ".ods" || !is_zip(file)) return "";  // a sheet, even if damaged
    const std::vector<std::string> members = zip_members(file);
    if (std::find(members.begin(), members.end(), "[Content_Types].xml") != members.end())
        return "";
    const std::vector<std::string> epw = members_named(members, {".epw"});
    std::vector<std::string> table = members_named(members, {".csv", ".dat", ".tab"});
    // Beside a header it is the data of a raster.
    if (!members_named(members, {".hdr"}).empty()) table.clear();
    if (epw.size() == 1) return epw.front();
    return epw.empty() && table.size() == 1 ? table.front() : "";
}

std::string weather_text(const std::filesystem::path& file) {
    const std::string member = weather_member(file);
    if (member.empty()) return read_text(file);
    note_file_read(file);
    const std::vector<std::byte> bytes = zip_member(file, member, most_text_bytes);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace diurna
