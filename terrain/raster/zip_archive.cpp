#include "terrain/raster/zip_archive.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <string_view>

#include "materials/base/error.hpp"
#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_members = 10'000;

std::string absolute_name(const std::filesystem::path& file) {
    return std::filesystem::absolute(file).lexically_normal().string();
}

/// In braces, for archives that are not named .zip.
std::string inside(const std::filesystem::path& file) {
    return "/vsizip/{" + absolute_name(file) + "}";
}

/// Whether a name ends in one of some endings, in small or capital letters.
bool ends_in(const std::string& member, std::initializer_list<const char*> endings) {
    const std::string ends = small_letters(std::filesystem::path(member).extension().string());
    return std::find(endings.begin(), endings.end(), ends) != endings.end();
}

/// Files that an archiver adds of itself: "__MACOSX/._N36W085.hgt", ".DS_Store".
bool is_by_the_way(const std::string& member) {
    const std::string name = std::filesystem::path(member).filename().string();
    return member.starts_with("__MACOSX/") || member.find("/__MACOSX/") != std::string::npos ||
           name.starts_with('.');
}

bool is_raster_name(const std::string& member, const std::vector<std::string>& members) {
    if (ends_in(member, {".hgt", ".tif", ".tiff", ".dt0", ".dt1", ".dt2", ".asc", ".dem", ".bil",
                         ".bip", ".bsq", ".flt", ".img", ".png", ".jpg", ".jpeg", ".nc"})) {
        return true;
    }
    if (ends_in(member, {".hdr", ".prj", ".xml", ".txt", ".pdf", ".stx", ".clr"})) return false;
    const std::string stem = std::filesystem::path(member).replace_extension(".hdr").string();
    return std::find(members.begin(), members.end(), stem) != members.end() ||
           std::find(members.begin(), members.end(), member + ".hdr") != members.end();
}

bool is_shape_name(const std::string& member) {
    return ends_in(
        member, {".shp", ".gpkg", ".geojson", ".json", ".geojsonl", ".geojsons", ".kml", ".fgb"});
}

/// GDAL's name of the one member that is wanted. `what` names it; `several` is the advice where
/// there are more.
std::string member_name(const std::filesystem::path& file, const std::vector<std::string>& members,
                        const std::vector<std::string>& wanted, const char* what,
                        const char* several) {
    if (wanted.size() == 1) return inside(file) + "/" + wanted.front();
    const auto shown = std::ptrdiff_t(std::min<std::size_t>(members.size(), 6));
    if (wanted.empty()) {
        throw InputError(file.string(),
                         fmt::format("is a zip archive without a {}; it contains {}{}", what,
                                     fmt::join(members.begin(), members.begin() + shown, ", "),
                                     shown < std::ptrdiff_t(members.size()) ? " ..." : ""));
    }
    throw InputError(
        file.string(),
        fmt::format("is a zip archive with {} {}s, expected one: {}, {}{}", wanted.size(), what,
                    wanted[0], wanted[1], wanted.size() > 2 ? " ..." : ""),
        several);
}

std::vector<std::string> own_members(const std::filesystem::path& file) {
    std::vector<std::string> members = zip_members(file);
    std::erase_if(members, is_by_the_way);
    return members;
}

bool is_gz_name(const std::string& path) { return small_letters(path).ends_with(".gz"); }

}  // namespace

bool is_zip(const std::filesystem::path& file) {
    std::error_code none;
    if (!std::filesystem::is_regular_file(file, none)) return false;
    std::array<char, 4> head{};
    std::ifstream in(file, std::ios::binary);
    in.read(head.data(), head.size());
    return in.gcount() == 4 && std::string_view(head.data(), 4) == "PK\x03\x04";
}

std::vector<std::string> zip_members(const std::filesystem::path& file) {
    const QuietGdal gdal;
    const std::unique_ptr<char*, decltype(&CSLDestroy)> list(
        VSIReadDirRecursive(inside(file).c_str()), CSLDestroy);
    std::vector<std::string> members;
    for (char** one = list.get(); one != nullptr && *one != nullptr; ++one) {
        const std::string name = *one;
        if (name.ends_with('/')) continue;
        if (members.size() == most_members) {
            throw InputError(file.string(),
                             fmt::format("is an archive of more than {} files", most_members));
        }
        members.push_back(name);
    }
    if (members.empty()) {
        throw InputError(file.string(),
                         "is a zip archive that is damaged or empty" + gdal.because());
    }
    return members;
}

std::vector<std::byte> zip_member(const std::filesystem::path& file, const std::string& member,
                                  std::size_t limit) {
    const QuietGdal gdal;
    const std::string name = inside(file) + "/" + member;
    VSIStatBufL found{};
    if (VSIStatL(name.c_str(), &found) != 0) {
        throw InputError(file.string(), "has no " + member + gdal.because());
    }
    const auto size = static_cast<std::size_t>(found.st_size);
    if (size > limit) {
        throw InputError(file.string() + ": " + member,
                         fmt::format("has {} bytes, expected at most {}", size, limit));
    }
    VSILFILE* const in = VSIFOpenL(name.c_str(), "rb");
    std::vector<std::byte> bytes(size);
    const std::size_t read = in != nullptr ? VSIFReadL(bytes.data(), 1, size, in) : 0;
    if (in != nullptr) VSIFCloseL(in);
    if (read != size || in == nullptr) {
        throw InputError(file.string() + ": " + member, "is damaged" + gdal.because());
    }
    return bytes;
}

std::string gdal_raster_name(const std::filesystem::path& file) {
    const std::string path = absolute_name(file);
    if (is_gz_name(path)) return "/vsigzip/" + path;
    if (!is_zip(file)) return path;
    const std::vector<std::string> members = own_members(file);
    std::vector<std::string> rasters;
    std::copy_if(members.begin(), members.end(), std::back_inserter(rasters),
                 [&](const std::string& name) { return is_raster_name(name, members); });
    return member_name(file, members, rasters, "raster",
                       "unpack it and use one, or several with more_tiles");
}

std::string gdal_vector_name(const std::filesystem::path& file) {
    const std::string path = absolute_name(file);
    if (is_gz_name(path)) return "/vsigzip/" + path;
    if (!is_zip(file)) return path;
    const std::vector<std::string> members = own_members(file);
    std::vector<std::string> shapes;
    std::copy_if(members.begin(), members.end(), std::back_inserter(shapes), is_shape_name);
    return member_name(file, members, shapes, "file of shape", "unpack it and use one");
}

bool holds_shapes(const std::filesystem::path& file) {
    const std::string path = small_letters(file.string());
    if (is_gz_name(path)) return is_shape_name(path.substr(0, path.size() - 3));
    if (!is_zip(file)) return false;
    const std::vector<std::string> members = own_members(file);
    return std::any_of(members.begin(), members.end(), is_shape_name) &&
           std::none_of(members.begin(), members.end(),
                        [&](const auto& name) { return is_raster_name(name, members); });
}

std::string unpacked_text(const std::filesystem::path& file) {
    constexpr std::size_t most = std::size_t{4} << 30;
    const QuietGdal gdal;
    const std::string name = gdal_raster_name(file);
    VSILFILE* const in = VSIFOpenL(name.c_str(), "rb");
    if (in == nullptr) throw InputError(file.string(), "cannot be read" + gdal.because());
    std::string text;
    std::vector<char> part(std::size_t{1} << 20);
    for (std::size_t count; (count = VSIFReadL(part.data(), 1, part.size(), in)) > 0;) {
        text.append(part.data(), count);
        if (text.size() > most) break;
    }
    VSIFCloseL(in);
    if (text.size() > most) throw InputError(file.string(), "has more than 4 GB of text");
    return text;
}

}  // namespace diurna
