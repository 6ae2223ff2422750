// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "lidar_upsampling/settings.h"

#include "lidar_upsampling/config.h"

namespace lidar_upsampling {
namespace {

constexpr Range kPositive{1e-9, 1e9};
constexpr Range kNotNegative{0, 1e9};
constexpr Range kShare{0, 1};

void list_main(Config& c, SettingList& v) {
  v.section("", "What goes in and out.");
  v.text("lidar_label", c.lidar_label, "sensor label of the LiDAR; empty: the only one there is");
  v.list("camera_labels", c.camera_labels,
         "sensor labels of the cameras, separated by commas; empty: every one with a calibration");
  v.text("output_label", c.output_label,
         "sensor label of the virtual scans; empty: the LiDAR's with _VIRTUAL behind it");
  v.word("carrier", c.carrier, {"auto", "3drangescan", "pointcloud", "same"},
         "MRPT class of the virtual scans; auto: 3drangescan, which keeps rings and columns, and "
         "which every MRPT's maps and viewers handle");
  v.packing("compression", c.compression,
            "of the output: none; fast or small (6 % smaller, for five times the work), or gzip:1 "
            "to gzip:9, which any MRPT reads; zstd:1 to zstd:19, which MRPT reads from 2.15.7 on");
  v.former("0", "none");
  for (const char* level : {"1", "2", "3"}) v.former(level, "fast");
  for (const char* level : {"4", "5", "6", "7", "8", "9"}) v.former(level, "small");
  v.word("mode", c.mode, {"causal", "offline"},
         "causal: only the past is used, as a live system must; offline: the next real scan, too");
  v.integer("scans_ahead", c.scans_ahead, {1, 20},
            "offline: real scans after the key scan that tell of its objects' motions");
  v.word("preset", c.preset, {"default", "paper"},
         "paper: exactly the published method, every object moved by its own pose");
  v.word("resample", c.resample, {"none", "beam"},
         "none: every virtual point is a real one, moved; beam: as the sensor would have measured "
         "it, on its own beams");
  v.choice_of("scan_time", c.sweep.scan_time, {"auto", "none", "azimuth", "points"},
              "instants of a scan's points; auto: points, if the log tells them; none: all at the "
              "stamp, or corrected already; azimuth: as the scanner turns; points: the log tells");
  v.choice_of("outside_view", c.compose.outside_view, {"ego", "drop"},
              "points that no camera sees: moved by the ego-motion, or left out");
  v.choice_of("objects", c.compose.objects, {"keep", "drop"},
              "moving objects in the virtual scans; drop: the static world only");
  v.integer("annotate", c.annotate, {0, 1},
            "1: the tracked objects beside each virtual scan, as boxes with arrows that "
            "RawLogViewer shows");
}

void list_timing(Config& c, SettingList& v) {
  TimingOptions& t = c.timing;
  v.section("timing", "How observations are brought together in time.");
  v.number("camera_time_offset_ms", t.camera_time_offset_ms, {-1000, 1000},
           "an image was taken this long before its stamp");
  v.number("pair_tolerance_ms", t.pair_tolerance_ms, {0, 50},
           "an image this close to a scan shows the scan's own instant");
  v.number("min_gap_ms", t.min_gap_ms, {0, 1000},
           "no virtual scan is due this close to a real one");
  v.number("group_tolerance_ms", t.group_tolerance_ms, {0, 100},
           "images of several cameras this close make one virtual scan");
  v.number("max_key_age_ms", t.max_key_age_ms, {1, 10000},
           "no virtual scan is made from a scan older than this");
  v.number("max_anchor_gap_ms", t.max_anchor_gap_ms, {0, 1000},
           "the scan's points are put on an image at most this far from it");
}

void list_sweep(Config& c, SettingList& v) {
  SweepOptions& s = c.sweep;
  v.section("sweep", "How the scanner turns, with scan_time = azimuth.");
  v.number("start_deg", s.start_deg, {-360, 360},
           "where a scan begins; 0 is ahead, 90 to the left");
  v.choice_of("direction", s.direction, {"clockwise", "counterclockwise"}, "seen from above");
  v.number("reference", s.reference, kShare, "share of the turn at the stamp; 0: its begin");
  v.number("period_ms", s.period_ms, {0, 10000},
           "of a turn; 0: the shortest time between two scans of the log");
}

void list_ego(Config& c, SettingList& v) {
  EgoMotionOptions& e = c.ego_motion;
  v.section("ego_motion", "How the vehicle moves.");
  v.choice_of("source", e.source, {"auto", "poses", "odometry", "gnss", "camera", "none"},
              "auto: the first of poses, odometry, gnss that the log offers, joined with scans and "
              "camera; else those alone");
  v.flag("fuse", e.fuse,
         "if source = auto, poses are weighed by how well they agree with registered scans; false: "
         "taken at their word, as by the paper");
  v.number("max_interpolation_gap_s", e.max_interpolation_gap_s, kPositive,
           "samples further apart are not joined");
  v.number("max_extrapolation_s", e.max_extrapolation_s, kNotNegative,
           "past the last sample, at the last velocity; 0: never");
  v.number("gnss_min_step_m", e.gnss_min_step_m, kPositive,
           "heading comes from displacements longer than this");
  PoseFileOptions& f = c.pose_file;
  v.text("poses_file", f.path, "poses that take the place of the log's; empty: none");
  v.choice_of("poses_format", f.format, {"auto", "tum", "kitti", "csv"},
              "t x y z qx qy qz qw, the 12 numbers of a matrix, or a table with a header; auto: "
              "what the first line looks like");
  v.text("poses_times", f.times,
         "kitti: file with a time per line; empty: there is a pose per real scan");
  v.text("poses_of", f.sensor,
         "label of the sensor whose poses these are; empty: the vehicle, of kitti the first "
         "camera");
}

void list_detector(Config& c, SettingList& v) {
  DetectorOptions& d = c.detector;
  v.section("detector", "Where object candidates come from.");
  v.choice_of("type", d.type, {"clusters", "network", "csv"},
              "clusters of the scan itself, a neural network on the image, or boxes from a file");
  ClusterDetectorOptions& k = d.clusters;
  v.integer("cluster_min_points", k.min_points, kPositive, "clusters: fewer points are no object");
  v.number("cluster_max_range_m", k.max_range, kPositive, "clusters: farther ones are left static");
  v.number("cluster_min_height_m", k.min_height, kNotNegative,
           "clusters: highest point over ground, at least");
  v.number("cluster_max_height_m", k.max_height, kPositive,
           "clusters: highest point over ground, at most");
  v.number("cluster_max_bottom_m", k.max_bottom, kNotNegative,
           "clusters: lowest point over ground, at most");
  v.number("cluster_min_length_m", k.min_length, kNotNegative,
           "clusters: longer side of the footprint, at least");
  v.number(
      "cluster_max_length_m", k.max_length, kPositive,
      "clusters: longer side of the footprint, at most; larger ones are split, or left static");
  v.number("cluster_max_width_m", k.max_width, kPositive,
           "clusters: shorter side of the footprint, at most; likewise");
  NetworkDetectorOptions& n = d.network;
  v.text("model", n.model, "network: Darknet .weights or .onnx of the YOLO families");
  v.text("config", n.config, "network: Darknet .cfg, empty for ONNX");
  v.text("classes", n.classes, "network: file with a class name per line");
  v.list("wanted", n.wanted, "network: classes that count");
  v.number("min_confidence", n.min_confidence, kShare, "network: weaker boxes are dropped");
  v.number("max_overlap", n.max_overlap, kShare,
           "network: of two boxes that overlap more, one goes");
  v.integer("input_width", n.input_width, kNotNegative, "network: pixels; 0: as the model says");
  v.integer("input_height", n.input_height, kNotNegative, "network: pixels; 0: as the model says");
  v.text("boxes", d.csv.path, "csv: label,stamp,class,score,left,top,right,bottom[,track]");
  v.number("stamp_tolerance_ms", d.csv.stamp_tolerance_ms, kNotNegative,
           "csv: how far a row's stamp may be from the image's");
}

void list_scene(Config& c, SettingList& v) {
  GroundOptions& g = c.segments.ground;
  v.section("ground", "The ground, which belongs to no object.");
  v.number("cell_size_m", g.cell_size, kPositive,
           "side of the cells whose lowest points are followed");
  v.number("max_tilt_deg", g.max_tilt_deg, {0, 60}, "from the vehicle's xy plane, near the sensor");
  v.number("max_slope", g.max_slope, kPositive, "rise per distance from cell to cell");
  v.number("ground_thickness_m", g.ground_thickness, kPositive, "points up to here belong to it");
  ClusterOptions& k = c.segments.clusters;
  v.section("clusters", "Euclidean clusters of what stands on the ground.");
  v.number("min_distance_m", k.min_distance, kPositive,
           "between points of one object, at the sensor");
  v.number("distance_per_range", k.distance_per_range, kNotNegative,
           "added per metre from the sensor");
  v.number("max_distance_m", k.max_distance, kPositive, "between points of one object, at most");
  v.number("voxel_size_m", k.voxel_size, kNotNegative,
           "points this close are handled as one; 0: each alone");
  v.integer("min_points", k.min_points, kPositive, "smaller clusters are dropped");
}

void list_vision(Config& c, SettingList& v) {
  PointTrackOptions& p = c.point_tracks;
  v.section("points", "Which LiDAR points are followed on the picture.");
  v.integer("max_points_per_object", p.max_points_per_object, {4, 5000},
            "well spread, best texture first");
  v.integer("num_static_points", c.static_points.max_points, {20, 5000},
            "for ego-motion from the camera");
  v.integer("border_px", p.border_px, kNotNegative, "distance kept from the picture's border");
  v.flag("own_surface", p.own_surface,
         "patches are compared where they show their object, not what is before or behind it");
  KltOptions& k = c.klt;
  v.section("klt", "Following points from image to image (Kanade-Lucas-Tomasi).");
  v.integer("window_px", k.window_px, {5, 63, /*odd=*/true}, "side of the patch, odd");
  v.integer("pyramid_levels", k.pyramid_levels, {0, 8}, "halvings above the full picture");
  v.integer("max_iterations", k.max_iterations, {1, 1000}, "per level");
  v.number("epsilon_px", k.epsilon_px, kPositive, "a step this short ends the iteration");
  v.number("max_forward_backward_px", k.max_forward_backward_px, kPositive,
           "error after tracking there and back");
  v.number("min_eigenvalue", k.min_eigenvalue, kNotNegative, "of the patch's gradient matrix");
  v.number("max_residual", k.max_residual, kPositive,
           "mean difference of the patches, gray levels");
  v.flag("align_first", k.align_first,
         "what lies where it is expected is brought into place there; false: all is searched for, "
         "as in the paper");
}

void list_motion(Config& c, SettingList& v) {
  PictureMotionOptions& o = c.object_motion.picture;
  v.section("object_motion",
            "Each object's own motion: what is asked, and the pose of its points.");
  v.flag("world_tracks", c.object_motion.world_tracks,
         "each object one track in the world; false: the pose of its points on each picture alone, "
         "as in the paper");
  TrackOptions& t = c.object_tracks;
  v.flag("static_test", t.static_test,
         "an object that cannot be told from a parked one stays parked");
  v.flag("scan_prior", t.scan_factor, "the motion between real scans weighs in, by registration");
  v.flag("image_prior", t.image_factor, "the motion seen on earlier images weighs in");
  v.flag("ground_prior", t.ground_factor, "that vehicles stay on the ground and level weighs in");
  v.number("sigma_px", o.pose.sigma_px, kPositive, "noise of a followed point, per axis");
  v.number("outlier_range_px", o.pose.outlier_range_px, kPositive,
           "square in which a wrong point may lie");
  v.number("loss_scale_px", o.pose.loss_scale_px, kPositive, "of the Cauchy loss");
  v.integer("min_inliers", o.pose.min_inliers, {4, 1e6}, "fewer are no consensus");
  v.number("min_inlier_ratio", o.pose.min_inlier_ratio, kShare, "less is no consensus");
  v.integer("max_iterations", o.pose.ransac.max_iterations, {1, 1e6}, "of the MLESAC loop");
  v.number("confidence", o.pose.ransac.confidence, {0.01, 0.999999},
           "of having drawn a clean sample");
  v.integer("min_points", o.min_points, {4, 1e6}, "followed points; fewer: no pose of them");
  v.number("max_speed_m_s", o.max_speed, kPositive, "over ground; faster is no consensus");
}

void list_tracks(Config& c, SettingList& v) {
  TrackOptions& t = c.object_tracks;
  constexpr Range kProbability{1e-6, 1 - 1e-6};
  v.section("object_tracks", "Objects as tracks in the world.");
  v.number("moving_prior", t.moving_prior, kProbability,
           "probability that a candidate moves of which nothing else is known");
  v.number("loss_ratio", t.loss_ratio, kPositive,
           "how much worse a parked object that jumps is than a mover left standing");
  v.number("memory_s", t.memory_s, kPositive,
           "log-odds of moving decay to the prior's within this");
  v.number("unknown_speed_sigma_m_s", t.noise.unknown_speed_sigma, kPositive,
           "per axis, of an object seen for the first time");
  v.number(
      "slow_speed_sigma_m_s", t.noise.slow_speed_sigma, kPositive,
      "likewise, of one that looks like a person; and across our road or its own sides, of one "
      "that goes along these, as half of the others do");
  v.number("unknown_yaw_rate_sigma_rad_s", t.noise.unknown_yaw_rate_sigma, kPositive,
           "of an object seen for the first time");
  v.number("acceleration_sigma_m_s2", t.noise.acceleration_sigma, kPositive,
           "per axis, by which velocities change");
  v.number("acceleration_time_s", t.noise.acceleration_time, kPositive, "that it lasts");
  v.number("yaw_acceleration_rad2_s3", t.noise.yaw_acceleration, kPositive,
           "white noise by which yaw rates change");
  v.number("birth_density_per_m2", t.birth_density, kPositive, "new objects from scan to scan");
  v.number(
      "piece_share", t.piece_share, kShare,
      "of moving objects, that a scan shows in pieces; 0: new ones are no piece of known ones");
  v.number("extent_error", t.extent_error, kPositive,
           "share of its length by which what is seen of an object shifts");
  v.number("outlier_share", t.outlier_share, kProbability,
           "of registrations, and of pictures, that are wrong");
  v.number("outlier_density_per_m2", t.outlier_density, kPositive, "of where these lead");
  v.number("common_error_px", t.common_error_px, kPositive,
           "what all points of an object have wrong alike on the picture");
  v.number("degrees_of_freedom", t.points.degrees_of_freedom, kPositive,
           "of Student's t: the fewer, the more points go astray");
  v.number("points_per_observation", t.points.points_per_observation, {1, 1000},
           "neighbouring points err alike: so many count as one");
  v.number("height_sigma_m", t.height_sigma_m, kPositive, "vehicles stay on the ground");
  v.number("tilt_sigma_deg", t.tilt_sigma_deg, kPositive, "vehicles stay level");
  v.number("ground_time_s", t.ground_time_s, kPositive, "both grow by as much again within this");
}

void list_resampling(Config& c, SettingList& v) {
  ResampleOptions& r = c.resampling;
  v.section("resample", "The moved scan on the sensor's own beams, with resample = beam.");
  v.number("min_motion_m", r.min_motion_m, kNotNegative,
           "where nothing moves as far on average, points stay as they are");
  v.number("max_step_m", r.patches.max_step_m, kPositive,
           "in range between neighbouring points of one surface");
  v.number("max_step_per_range", r.patches.max_step_per_range, kNotNegative,
           "added per metre from the sensor");
  v.number("max_bend_m", r.patches.max_bend_m, kPositive,
           "of a steep surface from straight, over three points");
  v.number("max_bend_per_range", r.patches.max_bend_per_range, kNotNegative,
           "added per metre from the sensor");
}

}  // namespace

std::vector<SettingSection> settings_of(Config& config) {
  SettingList list;
  for (const auto add : {list_main, list_timing, list_sweep, list_ego, list_detector, list_scene,
                         list_vision, list_motion, list_tracks, list_resampling})
    add(config, list);
  return list.sections;
}

}  // namespace lidar_upsampling
