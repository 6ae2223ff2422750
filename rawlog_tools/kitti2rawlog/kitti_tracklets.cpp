// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "kitti2rawlog/kitti_tracklets.h"

#include <tinyxml2.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace lidar_upsampling::kitti {
namespace {

using tinyxml2::XMLElement;

constexpr int kFullyOccluded = 2;

// An element of the file, and the file's name for what is wrong with it.
class Element {
 public:
  Element(const XMLElement* element, const std::string& path) : element_(element), path_(path) {}

  [[nodiscard]] Element child(const char* name) const {
    const XMLElement* const found = element_->FirstChildElement(name);
    if (found == nullptr) fail(std::string("no <") + name + "> in it");
    return {found, path_};
  }

  [[nodiscard]] std::vector<Element> children(const char* name) const {
    std::vector<Element> found;
    for (const XMLElement* item = element_->FirstChildElement(name); item != nullptr;
         item = item->NextSiblingElement(name)) {
      found.emplace_back(item, path_);
    }
    return found;
  }

  [[nodiscard]] std::string text(const char* name) const {
    const char* const text = child(name).element_->GetText();
    if (text == nullptr) fail(std::string("<") + name + "> in it is empty");
    return text;
  }

  [[nodiscard]] double number(const char* name) const {
    double value = NAN;
    if (child(name).element_->QueryDoubleText(&value) != tinyxml2::XML_SUCCESS ||
        !std::isfinite(value)) {
      fail(std::string("<") + name + "> in it is no number");
    }
    return value;
  }

  [[nodiscard]] int integer(const char* name, int fallback) const {
    const XMLElement* const found = element_->FirstChildElement(name);
    return found == nullptr ? fallback : found->IntText(fallback);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(path_ + ", line " + std::to_string(element_->GetLineNum()) + ", <" +
                             element_->Name() + ">: " + what);
  }

 private:
  const XMLElement* element_;
  const std::string& path_;
};

// Labels stand on the ground: their point is in the middle of the box's bottom.
Tracklet::Placed placed(const Element& pose, double height) {
  Tracklet::Placed result;
  result.T_lidar_object =
      Eigen::Translation3d(pose.number("tx"), pose.number("ty"), pose.number("tz")) *
      Eigen::AngleAxisd(pose.number("rz"), Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(pose.number("ry"), Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(pose.number("rx"), Eigen::Vector3d::UnitX()) *
      Eigen::Translation3d(0, 0, 0.5 * height);
  result.hidden = pose.integer("occlusion", -1) == kFullyOccluded;
  return result;
}

Tracklet tracklet_from(const Element& item) {
  Tracklet tracklet;
  tracklet.type = item.text("objectType");
  tracklet.size = {item.number("l"), item.number("w"), item.number("h")};
  if (!(tracklet.size.minCoeff() > 0)) item.fail("a box without extent");
  const double first_frame = item.number("first_frame");
  if (!(std::abs(first_frame) < 1e9)) item.fail("<first_frame> in it is no frame");
  tracklet.first_frame = static_cast<int>(first_frame);
  for (const Element& pose : item.child("poses").children("item")) {
    tracklet.poses.push_back(placed(pose, tracklet.size.z()));
  }
  return tracklet;
}

}  // namespace

std::vector<Tracklet> read_tracklets(const std::string& path) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(path.c_str()) != tinyxml2::XML_SUCCESS) {
    throw std::runtime_error("cannot read the tracklets " + path + ": " + document.ErrorStr());
  }
  if (document.RootElement() == nullptr)
    throw std::runtime_error("the tracklets " + path + " hold nothing");
  const Element root(document.RootElement(), path);
  std::vector<Tracklet> tracklets;
  for (const Element& item : root.child("tracklets").children("item")) {
    tracklets.push_back(tracklet_from(item));
  }
  return tracklets;
}

std::vector<importing::ObjectTrack> tracks_in_world(const std::vector<Tracklet>& tracklets,
                                                    const std::vector<Frame>& scans,
                                                    const Pose& T_vehicle_lidar,
                                                    const Trajectory& ego) {
  std::map<int, Stamp> stamps;
  for (const Frame& scan : scans) stamps[scan.number] = scan.stamp;
  std::vector<importing::ObjectTrack> tracks;
  for (std::size_t id = 0; id < tracklets.size(); ++id) {
    const Tracklet& tracklet = tracklets[id];
    importing::ObjectTrack track;
    track.id = static_cast<int>(id);
    track.class_name = importing::class_name_from(tracklet.type);
    track.size = tracklet.size;
    for (std::size_t i = 0; i < tracklet.poses.size(); ++i) {
      const auto stamp = stamps.find(tracklet.first_frame + static_cast<int>(i));
      if (stamp == stamps.end()) continue;
      const auto vehicle = ego.at(stamp->second);
      if (!vehicle) continue;
      const auto& [T_lidar_object, hidden] = tracklet.poses[i];
      track.poses.push_back(
          {stamp->second, vehicle->T_world_vehicle * T_vehicle_lidar * T_lidar_object, hidden});
    }
    if (!track.poses.empty()) tracks.push_back(std::move(track));
  }
  return tracks;
}

}  // namespace lidar_upsampling::kitti
