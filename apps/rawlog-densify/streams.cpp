// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "streams.h"

#include <mrpt/system/datetime.h>

#include <algorithm>
#include <stdexcept>

namespace lidar_upsampling {
namespace {

bool named(const std::vector<std::string>& labels, const std::string& label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

std::string span_of(const StreamInfo& stream) {
  return stream.label + " from " + mrpt::system::dateTimeToString(stream.stamps.front()) + " to " +
         mrpt::system::dateTimeToString(stream.stamps.back());
}

const StreamInfo* select_lidar(const LogIndex& index, const Config& config) {
  if (!config.lidar_label.empty()) {
    if (const auto* stream = index.find(config.lidar_label, StreamKind::lidar)) return stream;
    throw std::runtime_error(index.path + ": no 3D scans are labelled '" + config.lidar_label +
                             "' (setting lidar_label); the log holds " + labels_of(index));
  }
  const auto lidars = index.of_kind(StreamKind::lidar);
  if (lidars.empty())
    throw std::runtime_error(index.path + ": there are no 3D scans; the log holds " +
                             labels_of(index));
  if (lidars.size() > 1)
    throw std::runtime_error(
        index.path + ": several streams of 3D scans (" + lidars[0]->label + ", " +
        lidars[1]->label + (lidars.size() > 2 ? ", ..." : "") +
        "): name one with --set lidar_label=" + lidars[0]->label +
        (lidars[1]->label == config.virtual_label(lidars[0]->label)
             ? ", or remove the virtual scans of an earlier run with rawlog-edit"
             : ""));
  return lidars.front();
}

std::vector<const StreamInfo*> select_cameras(
    const LogIndex& index, const Config& config,
    const std::vector<std::string>& calibrated_elsewhere) {
  for (const std::string& label : config.camera_labels)
    if (index.find(label, StreamKind::camera) == nullptr)
      throw std::runtime_error(index.path + ": no images are labelled '" + label +
                               "' (setting camera_labels); the log holds " + labels_of(index));
  const auto all = index.of_kind(StreamKind::camera);
  if (all.empty())
    throw std::runtime_error(index.path + ": there are no images; the log holds " +
                             labels_of(index));
  std::vector<const StreamInfo*> cameras;
  for (const StreamInfo* stream : all) {
    const bool usable = stream->calibrated() || named(calibrated_elsewhere, stream->label);
    if (config.camera_labels.empty() ? usable : named(config.camera_labels, stream->label))
      cameras.push_back(stream);
    if (!usable && named(config.camera_labels, stream->label)) cameras.clear();
  }
  if (cameras.empty())
    throw std::runtime_error(index.path + ": the images of '" + all.front()->label +
                             "' have no calibration; give it in a section [camera." +
                             all.front()->label +
                             "] with fx_px, fy_px, cx_px, cy_px and pose, or put it into the log "
                             "with rawlog-edit --camera-params");
  return cameras;
}

void check_clocks(const LogIndex& index, const StreamInfo& lidar, const StreamInfo& camera) {
  if (lidar.stamps.empty() || camera.stamps.empty())
    throw std::runtime_error(index.path + ": '" + (lidar.stamps.empty() ? lidar : camera).label +
                             "' has no valid time stamps");
  const double period_s = std::max(1., lidar.median_period_s);
  // A wrong stamp here and there is for the work to pass on.
  const auto [lidar_first, lidar_last] =
      std::minmax_element(lidar.stamps.begin(), lidar.stamps.end());
  const auto [camera_first, camera_last] =
      std::minmax_element(camera.stamps.begin(), camera.stamps.end());
  if (seconds_between(*lidar_last, *camera_first) > period_s ||
      seconds_between(*camera_last, *lidar_first) > 0)
    throw std::runtime_error(index.path + ": the clocks do not overlap: " + span_of(lidar) +
                             ", but " + span_of(camera) +
                             "; set the clocks right with rawlog-edit --remap-timestamps");
}

}  // namespace

std::vector<std::string> labels_of_calibrated(const RigOverrides& rig) {
  std::vector<std::string> labels;
  for (const auto& [label, camera] : rig.cameras)
    if (camera.fx && camera.fy && camera.cx && camera.cy) labels.push_back(label);
  return labels;
}

StreamSelection select_streams(const LogIndex& index, const Config& config,
                               const std::vector<std::string>& calibrated_elsewhere) {
  const StreamSelection selection = select_again(index, config, calibrated_elsewhere);
  for (const StreamInfo* camera : selection.cameras) check_clocks(index, *selection.lidar, *camera);
  return selection;
}

StreamSelection select_again(const LogIndex& index, const Config& config,
                             const std::vector<std::string>& calibrated_elsewhere) {
  StreamSelection selection;
  selection.lidar = select_lidar(index, config);
  selection.cameras = select_cameras(index, config, calibrated_elsewhere);
  const std::string label = config.virtual_label(selection.lidar->label);
  const bool is_camera = std::any_of(selection.cameras.begin(), selection.cameras.end(),
                                     [&](const auto* camera) { return camera->label == label; });
  if (is_camera || label == selection.lidar->label)
    throw std::runtime_error(index.path + ": output_label = " + label +
                             " is the label of a sensor that virtual scans are made of; choose "
                             "another");
  if (index.find(label, StreamKind::lidar) != nullptr)
    throw std::runtime_error(
        index.path + ": it already holds virtual scans labelled '" + label +
        "'; remove them with rawlog-decimate --keep-every 0, or choose another output_label");
  return selection;
}

}  // namespace lidar_upsampling
