#include "terrain/raster/zip_archive.hpp"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
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

bool is_elevation_name(const std::string& member) {
    const std::string ends = small_letters(std::filesystem::path(member).extension().string());
    constexpr std::array known{".hgt", ".tif", ".tiff", ".dt0", ".dt1", ".dt2", ".asc", ".dem"};
    return std::find(known.begin(), known.end(), ends) != known.end();
}

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
        throw InputError(file.string(), "holds no " + member + gdal.because());
    }
    const auto size = static_cast<std::size_t>(found.st_size);
    if (size > limit) {
        throw InputError(file.string() + ": " + member,
                         fmt::format("has {} bytes, at most {} are read", size, limit));
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
    if (small_letters(path).ends_with(".hgt.gz")) return "/vsigzip/" + path;
    if (!is_zip(file)) return path;
    const std::vector<std::string> members = zip_members(file);
    std::vector<std::string> rasters;
    std::copy_if(members.begin(), members.end(), std::back_inserter(rasters), is_elevation_name);
    if (rasters.size() == 1) return inside(file) + "/" + rasters.front();
    const auto shown = std::min<std::size_t>(members.size(), 6);
    throw InputError(
        file.string(),
        rasters.empty()
            ? fmt::format("is a zip archive without a raster; it holds {}{}",
                          fmt::join(members.begin(), members.begin() + std::ptrdiff_t(shown), ", "),
                          shown < members.size() ? " ..." : "")
            : fmt::format("is a zip archive of {} rasters, expected one: {}, {}{}", rasters.size(),
                          rasters[0], rasters[1], rasters.size() > 2 ? " ..." : ""),
        rasters.empty() ? "" : "unpack it and name one, or several as more_tiles");
}

}  // namespace diurna
