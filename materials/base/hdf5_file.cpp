#include "materials/base/hdf5_file.hpp"

#include <hdf5.h>

#include <algorithm>
#include <new>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/plain_text.hpp"

namespace diurna {

namespace {

// What stops a visit; less than 0 is a failure, which is given by who reads the values.
constexpr herr_t go_on = 0, found = 1;

herr_t look_at_link(hid_t, const char* name, const H5L_info_t* link, void* where) {
    if (link->type == H5L_TYPE_HARD || link->type == H5L_TYPE_SOFT) return go_on;
    *static_cast<std::string*>(where) = name;
    return found;
}

herr_t look_at_object(hid_t group, const char* name, const H5O_info_t* object, void* where) {
    if (object->type != H5O_TYPE_DATASET) return go_on;
    const hid_t dataset = H5Dopen2(group, name, H5P_DEFAULT);
    if (dataset < 0) return go_on;
    const hid_t made = H5Dget_create_plist(dataset);
    const bool elsewhere = H5Pget_external_count(made) > 0 || H5Pget_layout(made) == H5D_VIRTUAL;
    H5Pclose(made);
    H5Dclose(dataset);
    if (!elsewhere) return go_on;
    *static_cast<std::string*>(where) = name;
    return found;
}

/// Sets the library up, and keeps messages of its own off the terminal. By H5open and before all
/// else: where memory fails while it sets itself up inside of another call, HDF5 1.10 reports
/// itself of the error without end.
void begin_hdf5() {
    if (H5open() < 0) throw std::bad_alloc();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// Throws InputError of an open file that has values elsewhere; closes it.
void check_and_close(hid_t id, const std::string& file) {
    std::string name;
    const bool link = H5Lvisit(id, H5_INDEX_NAME, H5_ITER_NATIVE, look_at_link, &name) == found;
    const bool values = !link && H5Ovisit2(id, H5_INDEX_NAME, H5_ITER_NATIVE, look_at_object, &name,
                                           H5O_INFO_BASIC) == found;
    H5Fclose(id);
    if (link || values) {
        throw InputError(file,
                         "\"" + plain(name).substr(0, 60) + "\" stores its values in another file",
                         "copy them into this file");
    }
}

}  // namespace

std::vector<std::byte> hdf5_with_nothing_in_it() {
    begin_hdf5();
    const unsigned ordered = H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED;
    const hid_t made = H5Pcreate(H5P_FILE_CREATE), reached = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_link_creation_order(made, ordered);
    H5Pset_attr_creation_order(made, ordered);
    H5Pset_obj_track_times(made, false);  // same input, same bytes
    H5Pset_fapl_core(reached, 1 << 16, false);
    const hid_t file = H5Fcreate("in memory", H5F_ACC_TRUNC, made, reached);
    H5Fflush(file, H5F_SCOPE_LOCAL);
    std::vector<std::byte> bytes(
        std::size_t(std::max<ssize_t>(0, H5Fget_file_image(file, nullptr, 0))));
    if (!bytes.empty()) H5Fget_file_image(file, bytes.data(), bytes.size());
    H5Fclose(file);
    H5Pclose(reached);
    H5Pclose(made);
    return bytes;
}

void check_values_are_its_own(const std::filesystem::path& file) {
    begin_hdf5();
    if (H5Fis_hdf5(file.c_str()) <= 0) return;
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (id >= 0) check_and_close(id, file.string());
}

void check_values_are_its_own(std::span<const std::byte> bytes, const std::string& name) {
    begin_hdf5();
    const hid_t reached = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(reached, 1 << 16, false);
    // The library copies the bytes, which it takes for writable.
    H5Pset_file_image(reached, const_cast<std::byte*>(bytes.data()), bytes.size());
    const hid_t id = H5Fopen("in memory", H5F_ACC_RDONLY, reached);
    H5Pclose(reached);
    if (id >= 0) check_and_close(id, name);
}

}  // namespace diurna
