#include "render/picture/grey_picture.hpp"

#include "materials/base/files.hpp"
#include "render/picture/grey_png.hpp"
#include "render/picture/grey_tiff.hpp"

namespace diurna {

std::string extension_of(GreyFormat format) { return format == GreyFormat::tiff ? ".tif" : ".png"; }

void write_grey_picture(const std::filesystem::path& path, const GreyPicture& picture,
                        GreyFormat format) {
    write_whole_file(path, format == GreyFormat::tiff ? grey_tiff(picture) : grey_png(picture));
}

}  // namespace diurna
