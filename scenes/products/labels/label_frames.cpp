#include "scenes/products/labels/label_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "materials/atmosphere/band_model.hpp"
#include "materials/base/files.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/quicklook.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/products/labels/coco.hpp"
#include "scenes/products/labels/kitti.hpp"
#include "scenes/products/labels/row_places.hpp"
#include "scenes/products/labels/split.hpp"
#include "scenes/products/labels/yolo.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// One picture to come, who takes it and which of the observer's frames it is.
struct FrameTask {
    std::size_t observer, frame;
    Band band;
};

/// Those of all observers, instants and bands.
std::vector<FrameTask> tasks_of(const Prepared& prepared) {
    std::vector<FrameTask> tasks;
    for (std::size_t o = 0; o < prepared.sequences.size(); ++o) {
        for (std::size_t i = 0; i < prepared.sequences[o].frame.size(); ++i) {
            for (const std::string& band : prepared.scene.observers[o].bands) {
                tasks.push_back({o, i, named_band(prepared.scene.bands, band, bin_edges_um())});
            }
        }
    }
    return tasks;
}

/// - whole: of the observer's objects
LabelledPicture labelled(const Prepared& prepared, const FrameTask& task,
                         const std::map<int, WholeObject>& whole, const LabelBook& book,
                         const fs::path& out) {
    const ObserverInput& input = prepared.scene.observers[task.observer];
    const Instant instant = prepared.sequences[task.observer].frame[task.frame];
    const std::string& band = task.band.name;
    LabelledPicture picture{
        .file = grey_picture(input.name, band, instant, prepared.scene.labels.format),
        .planes = frame_base(input.name, band, instant) + ".exr",
        .instant = instant,
        .observer = input.name,
        .band = band,
        .plane = shown_plane(task.band),
        .unit = ""};
    const std::array<std::string, 5> wanted = {"object", "object_behind." + band, "temperature",
                                               "apparent_temperature." + band, "radiance." + band};
    const Frame frame = read_exr(out / picture.planes, wanted);
    picture.width = frame.width;
    picture.height = frame.height;
    picture.unit = frame[picture.plane].unit;
    const int bits = prepared.scene.labels.bits;
    picture.bits = bits;
    picture.scale = grey_scale(frame, picture.plane, bits);
    picture.display = display_counts(frame, picture.plane, bits);
    picture.beyond = pixels_beyond(frame[picture.plane], picture.scale, bits);
    picture.attributes = frame.attributes;
    if (std::find(input.instruments.begin(), input.instruments.end(), band) !=
        input.instruments.end()) {
        const std::string base = instrument_base(input.name, band, instant);
        picture.attributes["instrument.counts"] = base + extension_of(prepared.scene.labels.format);
        picture.attributes["instrument.display"] = base + "_display.png";
    }
    for (ObjectMask& mask : object_masks(frame, band)) {
        const auto found = whole.find(mask.object);
        if (found == whole.end() || book.objects[std::size_t(mask.object)].kind.empty()) continue;
        Label label{
            .mask = std::move(mask), .whole = found->second, .temperature = {}, .radiance = {}};
        label.temperature =
            contrast(frame["apparent_temperature." + band], frame.width, frame.height, label.mask);
        label.radiance = contrast(frame["radiance." + band], frame.width, frame.height, label.mask);
        picture.labels.push_back(std::move(label));
    }
    return picture;
}

/// Where some of the objects go: as a frame's rows find them.
std::map<int, WholeObject> moved_objects(const Prepared& prepared, std::vector<Labelled> objects,
                                         const Sequence& sequence, std::size_t frame) {
    const RowPlaces places = row_places(prepared, sequence, frame);
    for (std::size_t m = 0; m < places.poses.size(); ++m) {
        const Eigen::Vector3d front = places.poses[m].linear().col(1);
        const auto id = static_cast<std::size_t>(prepared.world.movers[m].id);
        objects[id].heading_deg = degrees(std::atan2(front.x(), front.y()));
    }
    return whole_objects(places.seen, places.stands, prepared.world.copies, objects,
                         sequence.at(frame));
}

std::vector<LabelledPicture> labelled_pictures(const Prepared& prepared, const LabelBook& book,
                                               const fs::path& out) {
    // What an observer would see of each object alone, from each of its places.
    std::vector<std::vector<std::map<int, WholeObject>>> whole;
    for (const Sequence& sequence : prepared.sequences) {
        const bool goes = sequence.goes || !prepared.movement.none();
        auto& of_pose = whole.emplace_back(goes ? sequence.frame.size() : 1);
        for_each_index(
            of_pose.size(),
            [&](std::size_t i) {
                of_pose[i] =
                    prepared.movement.none()
                        ? whole_objects(prepared.world.facets, prepared.world.facets,
                                        prepared.world.copies, book.objects, sequence.at(i))
                        : moved_objects(prepared, book.objects, sequence, i);
            },
            1);
    }
    const std::vector<FrameTask> tasks = tasks_of(prepared);
    std::vector<LabelledPicture> pictures(tasks.size());
    const std::vector<Instant>& instants = prepared.plan.frames;
    const std::vector<bool> validation = validation_instants(
        instants.size(), prepared.scene.labels.validation_share, prepared.scene.seed);
    for_each_index(
        tasks.size(),
        [&](std::size_t t) {
            const auto& of_pose = whole[tasks[t].observer];
            pictures[t] = labelled(prepared, tasks[t],
                                   of_pose[of_pose.size() > 1 ? tasks[t].frame : 0], book, out);
            const auto at = std::lower_bound(instants.begin(), instants.end(), pictures[t].instant);
            pictures[t].validation = validation[std::size_t(at - instants.begin())];
        },
        1);
    return pictures;
}

/// "images/NAME.png" as a text in another folder.
std::string text_beside(const std::string& folder, const std::string& picture) {
    return folder + picture.substr(picture.find('/'), picture.rfind('.') - picture.find('/')) +
           ".txt";
}

}  // namespace

std::vector<std::string> label_frames(const Prepared& prepared, const fs::path& out) {
    LabelBook book{.objects = labelled_objects(prepared.scene, prepared.world), .classes = {}};
    book.classes = class_list(book.objects);
    const std::vector<LabelledPicture> pictures = labelled_pictures(prepared, book, out);
    std::vector<std::string> files;
    const auto write = [&](const std::string& name, const std::string& text) {
        write_whole_file(out / name, text);
        files.push_back(name);
    };
    std::vector<const LabelledPicture*> all;
    std::array<std::vector<const LabelledPicture*>, 2> part;  // training, validation
    std::array<std::string, 2> list;
    std::size_t next = 0;
    for (const FrameTask& task : tasks_of(prepared)) {
        const LabelledPicture& picture = pictures[next++];
        all.push_back(&picture);
        part[picture.validation].push_back(&picture);
        list[picture.validation] += "./" + picture.file + "\n";
        write(text_beside("labels", picture.file), yolo_text(book, picture));
        const Observer& eye = prepared.sequences[task.observer].at(task.frame);
        write(text_beside("kitti", picture.file), kitti_text(book, picture, eye));
        const std::string calibration = kitti_calibration(eye);
        if (!calibration.empty()) write(text_beside("kitti/calib", picture.file), calibration);
    }
    write("annotations.json", coco_json(book, all));
    write("annotations_train.json", coco_json(book, part[0]));
    write("annotations_validation.json", coco_json(book, part[1]));
    write("train.txt", list[0]);
    write("validation.txt", list[1]);
    write("data.yaml", yolo_data(book));
    std::string names;
    for (const std::string& kind : book.classes) names += kind + "\n";
    write("classes.txt", names);
    return files;
}

}  // namespace diurna
