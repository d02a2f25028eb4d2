#include "terrain/raster/raster_names.hpp"

#include <system_error>

#include "materials/base/error.hpp"

namespace diurna {

std::filesystem::path header_beside(const std::filesystem::path& file) {
    for (std::filesystem::path beside : {std::filesystem::path(file).replace_extension(".hdr"),
                                         std::filesystem::path(file.string() + ".hdr"),
                                         std::filesystem::path(file).replace_extension(".HDR")}) {
        std::error_code none;
        if (beside != file && std::filesystem::is_regular_file(beside, none)) return beside;
    }
    return {};
}

std::string unread_hint(const std::filesystem::path& file, const std::string& formats) {
    const std::string ends = small_letters(file.extension().string());
    if (ends == ".hdr") {
        std::error_code none;
        for (const char* data : {"", ".bil", ".bsq", ".bip", ".flt", ".dat", ".img", ".envi"}) {
            const std::filesystem::path beside =
                std::filesystem::path(file).replace_extension(data);
            if (std::filesystem::is_regular_file(beside, none)) {
                return "is the header of a raster: use its data file, " + beside.string();
            }
        }
        return "is the header of a raster: use its data file";
    }
    if (ends == ".hgt" || file.string().ends_with(".hgt.gz") ||
        file.string().ends_with(".hgt.zip")) {
        return "the name of an SRTM HGT file gives its place: N36W085.hgt is the tile with the "
               "south-west corner 36 N 85 W";
    }
    return formats;
}

}  // namespace diurna
