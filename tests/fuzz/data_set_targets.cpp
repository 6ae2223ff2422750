// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <memory>
#include <sstream>

#include "argoverse2rawlog/argoverse_log.h"
#include "dgp2rawlog/dgp_labels.h"
#include "dgp2rawlog/dgp_log.h"
#include "fuzz/data_set_files.h"
#include "fuzz/file_set.h"
#include "fuzz/fuzz_folder.h"
#include "fuzz/target.h"
#include "import/label_files.h"
#include "kitti2rawlog/kitti_recording.h"

namespace lidar_upsampling::fuzz {
namespace {

// As the importers do.
void import(std::vector<importing::LogItem> items, const importing::LabelledLog* labels) {
  std::optional<importing::LabelFiles> tables;
  if (labels != nullptr)
    tables.emplace(importing::LabelPaths{in_work_folder("made_boxes.csv"),
                                         in_work_folder("made_objects.csv"), true});
  RawlogWriter writer(in_work_folder("made.rawlog"), true);
  importing::write_items(writer, std::move(items), [](double) {});
  if (tables) tables->write(*labels);
  writer.commit();
  if (tables) tables->commit();
}

void import_kitti(kitti::Recording recording, const std::string& labels, const std::string& drive) {
  if (labels.empty()) {
    import(kitti::items_of(recording), nullptr);
    return;
  }
  static_cast<void>(kitti::add_tracks(recording, drive, labels));
  const importing::LabelledLog labelled = kitti::labels_of(recording);
  import(kitti::items_of(recording), &labelled);
}

void read_drive(const FileSet& files, Random& random) {
  const std::string drive = files.path("drive");
  import_kitti(kitti::open_drive(drive, {}),
               random.one_in(2) ? drive + "/tracklet_labels.xml" : files.path("label_02.txt"),
               drive);
}

void read_sequence(const FileSet& files, Random&) {
  const std::string folder = files.path("sequences/04");
  import_kitti(kitti::open_sequence(folder, {}), "", folder);
}

void read_argoverse(const FileSet& files, Random&) {
  argoverse::TrackingLog log = argoverse::open_log(files.folder(), {"ring_front_center"});
  argoverse::add_tracks(log, files.folder());
  const importing::LabelledLog labelled = argoverse::labels_of(log);
  import(argoverse::items_of(log), &labelled);
}

void read_dgp(const FileSet& files, Random&) {
  const dgp::Scene scene = dgp::open_scene(files.path("scene_0a.json"), {});
  const importing::LabelledLog labelled = dgp::labelled_log(scene, dgp::read_labels(scene).tracks);
  import(dgp::items_of(scene), &labelled);
}

Target target_of(const std::string& name, Files (*files)(), void (*read)(const FileSet&, Random&)) {
  const auto set = std::make_shared<std::unique_ptr<FileSet>>();
  const auto made = [name, files, set]() -> FileSet& {
    if (*set == nullptr) *set = std::make_unique<FileSet>(name, files());
    return **set;
  };
  return {name,
          [made, read](Random& random) {
            made().spoil(random);
            read(made(), random);
          },
          [made, read] {
            made().mend();
            for (const std::uint64_t seed : {1, 2, 3, 4}) {
              Random random(seed);
              read(made(), random);
            }
          }};
}

}  // namespace

std::vector<Target> data_set_targets() {
  return {target_of("kitti_drive", drive_files, read_drive),
          target_of("kitti_sequence", sequence_files, read_sequence),
          target_of("argoverse", argoverse_files, read_argoverse),
          target_of("dgp", dgp_files, read_dgp)};
}

}  // namespace lidar_upsampling::fuzz
