#include "scenes/job/plan/frame_files.hpp"

#include "render/picture/frame.hpp"

namespace diurna {

std::string frame_base(const std::string& observer, const std::string& band, Instant instant) {
    Frame named;
    named.observer = observer;
    named.instant = instant;
    return "frames/" + frame_name(named, band);
}

std::string grey_picture(const std::string& observer, const std::string& band, Instant instant,
                         GreyFormat format) {
    return "images" + frame_base(observer, band, instant).substr(6) + extension_of(format);
}

std::string instrument_base(const std::string& observer, const std::string& band, Instant instant) {
    return "instrument" + frame_base(observer, band, instant).substr(6);
}

std::string calibration_file(const std::string& observer, const std::string& band) {
    const std::string dated = instrument_base(observer, band, Instant{});
    return dated.substr(0, dated.rfind('_')) + "_calibration.csv";
}

std::vector<std::string> picture_files(const ObserverInput& observer, Instant instant,
                                       GreyFormat format) {
    std::vector<std::string> files;
    for (const std::string& band : observer.bands) {
        const std::string name = frame_base(observer.name, band, instant);
        files.push_back(name + ".exr");
        files.push_back(name + ".png");
        files.push_back(grey_picture(observer.name, band, instant, format));
    }
    for (const std::string& cube : observer.cubes) {
        const std::string name = frame_base(observer.name, cube, instant);
        for (const char* extension : {".exr", ".img", ".hdr"}) files.push_back(name + extension);
    }
    return files;
}

std::vector<std::string> instrument_files(const ObserverInput& observer, Instant instant,
                                          GreyFormat format) {
    std::vector<std::string> files;
    for (const std::string& band : observer.instruments) {
        const std::string name = instrument_base(observer.name, band, instant);
        files.push_back(name + ".exr");
        files.push_back(name + extension_of(format));
        files.push_back(name + "_display.png");
    }
    return files;
}

std::vector<std::string> frame_files(const ObserverInput& observer, Instant instant,
                                     GreyFormat format) {
    std::vector<std::string> files = picture_files(observer, instant, format);
    for (std::string& file : instrument_files(observer, instant, format)) {
        files.push_back(std::move(file));
    }
    return files;
}

std::vector<std::string> frame_files(const std::vector<ObserverInput>& observers,
                                     GreyFormat format) {
    std::vector<std::string> files;
    for (const ObserverInput& observer : observers) {
        if (observer.frames.empty()) continue;
        for (const Instant instant : observer.frames) {
            for (std::string& file : frame_files(observer, instant, format)) {
                files.push_back(std::move(file));
            }
        }
        for (const std::string& band : observer.instruments) {
            files.push_back(calibration_file(observer.name, band));
        }
    }
    return files;
}

}  // namespace diurna
