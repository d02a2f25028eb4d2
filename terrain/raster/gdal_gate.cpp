#include "terrain/raster/gdal_gate.hpp"

#include <cpl_http.h>
#include <cpl_vsi_virtual.h>
#include <gdal_priv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "terrain/raster/gdal_formats.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr std::array file_systems{"/vsimem/", "/vsizip/", "/vsigzip/"};  // beside the disk

thread_local GdalGate* gate = nullptr;

/// Where the tables are that GDAL comes with; "": none are found.
fs::path own_data;

CPLHTTPResult* fetch_nothing(const char*, CSLConstList, GDALProgressFunc, void*,
                             CPLHTTPFetchWriteFunc, void*, void*) {
    constexpr const char* why = "network access is not permitted";
    CPLError(CE_Failure, CPLE_AppDefined, "%s", why);
    // With no result at all GDAL would fetch it itself. Its own to free.
    auto* result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
    result->nStatus = 1;
    result->pszErrBuf = CPLStrdup(why);
    return result;
}

/// Networks, standard input, archives that nobody asks for.
class ClosedFiles final : public VSIFilesystemHandler {
 public:
    VSIVirtualHandle* Open(const char*, const char*, bool, CSLConstList) override {
        return nullptr;
    }
    int Stat(const char*, VSIStatBufL*, int) override {
        errno = ENOENT;
        return -1;
    }
};

}  // namespace

/// The disk as GDAL sees it, behind the gate of the thread; without one it is as it was.
class GuardedDisk final : public VSIFilesystemHandler {
 public:
    explicit GuardedDisk(VSIFilesystemHandler* disk) : disk_(disk) {}

    VSIVirtualHandle* Open(const char* name, const char* access, bool set_error,
                           CSLConstList options) override {
        if (gate != nullptr) {
            const std::string_view mode = access;
            const bool writes = mode.find_first_of("wa+") != std::string_view::npos;
            if (writes || !gate->admits(name, true)) {
                errno = EACCES;
                return nullptr;
            }
        }
        return disk_->Open(name, access, set_error, options);
    }
    int Stat(const char* name, VSIStatBufL* found, int flags) override {
        if (gate != nullptr && !gate->admits(name, false)) {
            errno = ENOENT;
            return -1;
        }
        return disk_->Stat(name, found, flags);
    }
    int Unlink(const char* name) override { return disk_->Unlink(name); }
    int Rename(const char* from, const char* to) override { return disk_->Rename(from, to); }
    int Mkdir(const char* name, long mode) override { return disk_->Mkdir(name, mode); }
    int Rmdir(const char* name) override { return disk_->Rmdir(name); }
    char** ReadDirEx(const char* name, int most) override { return disk_->ReadDirEx(name, most); }
    int IsCaseSensitive(const char* name) override { return disk_->IsCaseSensitive(name); }
    GIntBig GetDiskFreeSpace(const char* name) override { return disk_->GetDiskFreeSpace(name); }
    int SupportsSparseFiles(const char* name) override { return disk_->SupportsSparseFiles(name); }

 private:
    std::unique_ptr<VSIFilesystemHandler> disk_;
};

GdalGate::GdalGate(Confines confines) : confines_(std::move(confines)) {
    prepare_gdal();
    before_ = std::exchange(gate, this);
}

GdalGate::~GdalGate() { gate = before_; }

bool GdalGate::admits(const char* name, bool reported) {
    std::error_code problem;
    const fs::file_status status = fs::status(name, problem);
    if (!fs::exists(status) || fs::is_directory(status)) return true;  // nothing is read of it
    const fs::path file = name, folder = file.parent_path();
    if (!own_data.empty() && folder == own_data) return true;
    const std::string why = why_not(confines_, file);
    if (why.empty()) {
        if (reported) note_file_read(file);
        return true;
    }
    // GDAL looks for many a name far off that is none of this raster's.
    if (refused_.empty() && (reported || why_not(confines_, folder / "beside").empty())) {
        refused_ = file;
        why_ = why;
    }
    return false;
}

void GdalGate::check() const {
    if (!refused_.empty()) throw InputError(refused_.string(), why_, allow_outside_hint);
}

void prepare_gdal() {
    static std::once_flag once;
    std::call_once(once, [] {
        const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
        GDALAllRegister();
        GDALDriverManager& manager = *GetGDALDriverManager();
        for (int i = manager.GetDriverCount(); i-- > 0;) {
            GDALDriver* driver = manager.GetDriver(i);
            if (is_gdal_driver_used(driver->GetDescription())) continue;
            manager.DeregisterDriver(driver);
            delete driver;
        }
        const char* table = CPLFindFile("gdal", "gdalvrt.xsd");
        if (table != nullptr) own_data = fs::path(table).parent_path();
        char** const prefixes = VSIGetFileSystemsPrefixes();
        for (char** p = prefixes; p != nullptr && *p != nullptr; ++p) {
            const std::string_view prefix = *p;
            const bool wanted =
                std::find(file_systems.begin(), file_systems.end(), prefix) != file_systems.end();
            if (!wanted) VSIFileManager::InstallHandler(*p, new ClosedFiles);
        }
        CSLDestroy(prefixes);
        VSIFileManager::InstallHandler("", new GuardedDisk(VSIFileManager::GetHandler("")));
        CPLSetConfigOption("CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");  // beside the archive
        CPLSetConfigOption("SQLITE_USE_OGR_VFS", "YES");  // else SQLite opens files by itself
        CPLHTTPSetFetchCallback(fetch_nothing, nullptr);
        OSRSetPROJEnableNetwork(FALSE);
    });
}

}  // namespace diurna
