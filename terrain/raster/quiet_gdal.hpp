#pragma once

#include <gdal_priv.h>

#include <algorithm>
#include <string>

#include "terrain/raster/gdal_gate.hpp"

namespace diurna {

/// Keeps GDAL's messages off the terminal and stores the first, for use in our messages.
class QuietGdal {
 public:
    QuietGdal() {
        prepare_gdal();
        CPLPushErrorHandlerEx(remember, &first_);
    }
    ~QuietGdal() { CPLPopErrorHandler(); }
    QuietGdal(const QuietGdal&) = delete;
    QuietGdal& operator=(const QuietGdal&) = delete;

    std::string because() const { return first_.empty() ? "" : ": " + first_; }

 private:
    static void CPL_STDCALL remember(CPLErr level, CPLErrorNum, const char* message) {
        auto* first = static_cast<std::string*>(CPLGetErrorHandlerUserData());
        if (level < CE_Failure || !first->empty()) return;
        *first = message;
        std::replace(first->begin(), first->end(), '\n', ' ');
    }
    std::string first_;
};

}  // namespace diurna
