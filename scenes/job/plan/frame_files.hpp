#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "terrain/place/instant.hpp"

/// Names of a job's pictures, relative to its folder.
namespace diurna {

/// "frames/east_8-12_20260715T040000Z": a band's or a cube's picture without its extension.
std::string frame_base(const std::string& observer, const std::string& band, Instant instant);

/// "images/east_8-12_20260715T040000Z.png": the same as a plain grey picture.
std::string grey_picture(const std::string& observer, const std::string& band, Instant instant,
                         GreyFormat format);

/// "instrument/east_8-12_20260715T040000Z": an instrument's picture without its extension, and its
/// calibration "instrument/east_8-12_calibration.csv".
std::string instrument_base(const std::string& observer, const std::string& band, Instant instant);
std::string calibration_file(const std::string& observer, const std::string& band);

/// Files of one frame, as rendered, from instruments, and both: for every band an EXR, a PNG beside
/// it and a grey one; for every cube an EXR and ENVI's two; for every instrument an EXR, the counts
/// and their display picture.
std::vector<std::string> picture_files(const ObserverInput& observer, Instant instant,
                                       GreyFormat format);
std::vector<std::string> instrument_files(const ObserverInput& observer, Instant instant,
                                          GreyFormat format);
std::vector<std::string> frame_files(const ObserverInput& observer, Instant instant,
                                     GreyFormat format);
/// Of all frames of some observers.
std::vector<std::string> frame_files(const std::vector<ObserverInput>& observers,
                                     GreyFormat format);

}  // namespace diurna
