// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "worst_objects.h"

#include <algorithm>
#include <cmath>

#include "object_pictures.h"
#include "palette.h"

namespace lidar_upsampling {

namespace {

constexpr double kSameInstant_s = 0.02;  // a camera's clock may be off by its shutter's delay

double error_of(const ShownObject& shown) { return shown.errors[Row::ours]->position_m; }

Positions key_points(const LidarScan& key, const std::vector<int>& indices, const Pose& T) {
  Positions points;
  points.reserve(indices.size());
  for (const int i : indices) points.emplace_back(T * key.points[i].cast<double>());
  return points;
}

/// What the sensor really saw there, at the object's height: the road would hide its outline.
Positions real_surroundings(const LidarScan& reference, const Window& window,
                            const Positions& object) {
  const auto [low, high] = std::minmax_element(
      object.begin(), object.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
  constexpr double kRoom_m = 0.1;
  Positions points;
  for (const auto& p : reference.points) {
    const Eigen::Vector3d point = p.cast<double>();
    if (point.z() < low->z() - kRoom_m || point.z() > high->z() + kRoom_m) continue;
    if ((point.head<2>() - window.center).cwiseAbs().maxCoeff() < 0.5 * window.size_m)
      points.push_back(point);
  }
  return points;
}

void draw(const ScanSet& scans, const ObjectResult& result, const Pictured& pictures,
          ShownObject& shown) {
  const std::vector<int>& indices = result.object.points;
  const Positions before = key_points(scans.key, indices, Pose::Identity());
  const Positions after = key_points(scans.key, indices, *result.estimates[Row::ours]);
  const Positions real = key_points(scans.key, indices, result.object.motion.T_lidar_t_lidar_k);
  for (const auto& [label, image] : pictures) {
    if (std::abs(seconds_between(image.stamp, scans.virtual_scan.stamp)) > kSameInstant_s) continue;
    const auto crop = draw_on_crop(image, scans.virtual_scan.T_vehicle_lidar, after, real);
    if (!crop) continue;
    shown.camera = label;
    shown.crop = jpeg_uri(*crop);
    break;
  }
  const Window window = window_around({&before, &after, &real});
  const Positions surroundings = real_surroundings(scans.reference, window, real);
  shown.before = png_uri(draw_from_above(window, surroundings, before, color_of(Row::hold)));
  shown.after = png_uri(draw_from_above(window, surroundings, after, color_of(Row::ours)));
}

std::string image_html(const std::string& address, const std::string& description,
                       const std::string& caption) {
  return "<figure><img src=\"" + address + "\" alt=\"" + escaped(description) + "\"><figcaption>" +
         escaped(caption) + "</figcaption></figure>\n";
}

std::string errors_html(const ShownObject& shown) {
  std::string html = "<div class=\"errors\">";
  for (const Row row : kRows) {
    if (!shown.errors[row]) continue;
    const std::string text =
        std::string(name_of(row)) + " " + fixed(shown.errors[row]->position_m, 3) + " m";
    html += std::string("<span><i class=\"mark\" style=\"background:") + color_of(row) + "\"></i>" +
            (row == Row::ours ? "<b>" + text + "</b>" : text) + "</span>";
  }
  return html + "</div>\n";
}

std::string object_html(const ShownObject& shown, std::size_t place, Stamp first_stamp) {
  const ObjectReference& object = shown.object;
  const std::string name = object.class_name + " " + object.id;
  const std::string what =
      (object.moving ? "moving at " + fixed(object.speed, 1) + " m/s" : "static") + ", " +
      fixed(object.motion.centroid_k.head<2>().norm(), 0) + " m away, " +
      std::to_string(shown.num_points) + " points, " + fixed(1e3 * shown.dt, 0) +
      " ms after the key scan";
  std::string html = "<article class=\"object\"><h3>" + std::to_string(place) + ". " +
                     escaped(name) +
                     "<span>t = " + fixed(seconds_between(first_stamp, shown.stamp), 2) +
                     " s</span></h3>\n" + paragraph(what, "note");
  if (shown.crop.empty())
    html += paragraph("No picture of that instant shows it.", "note");
  else
    html += image_html(shown.crop, name + " on the picture of " + shown.camera,
                       "on the picture of " + shown.camera);
  html += "<div class=\"views\">" +
          image_html(shown.before, name + " from above, as in the key scan",
                     "before: as in the key scan") +
          image_html(shown.after, name + " from above, moved by ours", "after: moved by ours") +
          "</div>\n";
  return html + errors_html(shown) + "</article>\n";
}

std::string key_html() {
  const auto mark = [](const std::string& color) {
    return "<i class=\"mark\" style=\"background:" + color + "\"></i>";
  };
  return "<p class=\"key\">The key scan's points of the object: " + mark(color_of(Row::ours)) +
         "where ours puts them, " + mark(color_of(Row::oracle)) +
         "where the reference motion puts them, " + mark(color_of(Row::hold)) +
         "where they were. From above, also " + mark("#28323c") +
         "the real scan of that instant, at the object's height; forward is up.</p>\n";
}

}  // namespace

void WorstObjects::add(const ScanSet& scans, const ScanResult& result, const Pictured& pictures) {
  for (const ObjectResult& object : result.objects) {
    if (!is_counted(object) || object.object.points.empty()) continue;
    const double error = object.errors[Row::ours]->position_m;
    if (found_.size() == capacity_ && error <= error_of(found_.back())) continue;
    ShownObject shown{object.object,
                      object.object.points.size(),
                      object.errors,
                      result.stamp,
                      result.dt,
                      "",
                      "",
                      "",
                      ""};
    shown.object.points = {};
    draw(scans, object, pictures, shown);
    const auto place = std::upper_bound(
        found_.begin(), found_.end(), error,
        [](double value, const ShownObject& other) { return value > error_of(other); });
    found_.insert(place, std::move(shown));
    if (found_.size() > capacity_) found_.pop_back();
  }
}

std::string worst_objects_html(const std::vector<ShownObject>& objects, Stamp first_stamp) {
  if (objects.empty()) return paragraph("No object could be compared.");
  std::string html = key_html() + "<div class=\"objects\">\n";
  for (std::size_t i = 0; i < objects.size(); ++i)
    html += object_html(objects[i], i + 1, first_stamp);
  return html + "</div>\n";
}

}  // namespace lidar_upsampling
