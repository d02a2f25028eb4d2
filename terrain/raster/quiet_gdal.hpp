#pragma once

#include <cpl_http.h>
#include <gdal_priv.h>

#include <algorithm>
#include <mutex>
#include <string>

namespace diurna {

/// Keeps GDAL's messages off the terminal and remembers the first, for our own.
class QuietGdal {
 public:
    QuietGdal() {
        static std::once_flag once;
        std::call_once(once, [] {
            GDALAllRegister();
            // A file is data: what it names on a network is not fetched.
            CPLHTTPSetFetchCallback(fetch_nothing, nullptr);
        });
        CPLPushErrorHandlerEx(remember, &first_);
    }
    ~QuietGdal() { CPLPopErrorHandler(); }
    QuietGdal(const QuietGdal&) = delete;
    QuietGdal& operator=(const QuietGdal&) = delete;

    std::string because() const { return first_.empty() ? "" : ": " + first_; }

 private:
    static CPLHTTPResult* fetch_nothing(const char*, CSLConstList, GDALProgressFunc, void*,
                                        CPLHTTPFetchWriteFunc, void*, void*) {
        constexpr const char* why = "nothing is fetched from a network";
        CPLError(CE_Failure, CPLE_AppDefined, "%s", why);
        // With no result at all GDAL would fetch it itself. Its own to free.
        auto* result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
        result->nStatus = 1;
        result->pszErrBuf = CPLStrdup(why);
        return result;
    }
    static void CPL_STDCALL remember(CPLErr level, CPLErrorNum, const char* message) {
        auto* first = static_cast<std::string*>(CPLGetErrorHandlerUserData());
        if (level < CE_Failure || !first->empty()) return;
        *first = message;
        std::replace(first->begin(), first->end(), '\n', ' ');
    }
    std::string first_;
};

}  // namespace diurna
