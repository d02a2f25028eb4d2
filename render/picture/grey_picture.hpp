#pragma once

#include <filesystem>
#include <string>

#include "render/picture/grey_counts.hpp"

namespace diurna {

enum class GreyFormat { png, tiff };
/// ".png", ".tif"
std::string extension_of(GreyFormat format);

/// A plane's pixels without margins, title or bar: as training data. The scale is stored in the
/// file too: PNG's text "Scale", TIFF's image description.
void write_grey_picture(const std::filesystem::path& path, const GreyPicture& picture,
                        GreyFormat format);

}  // namespace diurna
