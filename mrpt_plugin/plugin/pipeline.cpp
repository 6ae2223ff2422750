// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/pipeline.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "lidar_upsampling/text.h"

namespace lidar_upsampling {

using mrpt::obs::CObservation;

namespace {

double ms_since(SteadyTime time) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - time).count();
}

}  // namespace

Pipeline::Pipeline(const QueueOptions& options, std::function<Role(const CObservation&)> role_of,
                   std::unique_ptr<Upsampling> upsampling, Messages& messages)
    : queue_(options),
      role_of_(std::move(role_of)),
      upsampling_(std::move(upsampling)),
      messages_(messages),
      worker_([this] { work(); }) {}

Pipeline::~Pipeline() {
  queue_.abandon();
  worker_.join();
}

void Pipeline::push(const CObservation::Ptr& observation,
                    const std::optional<Pose>& pose_by_actions) {
  const std::lock_guard<std::mutex> lock(push_mutex_);
  Arrived arrived;
  arrived.observation = observation;
  arrived.pose_by_actions = pose_by_actions;
  arrived.role = role_of_(*observation);
  queue_.push(std::move(arrived));
}

void Pipeline::finish(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!end_) end_ = reason;
  queue_.close();
}

std::vector<CObservation::Ptr> Pipeline::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<CObservation::Ptr> taken;
  for (Emitted& emitted : ready_) {
    if (emitted.image_arrival) statistics_.delivered.add(ms_since(*emitted.image_arrival));
    taken.push_back(std::move(emitted.observation));
  }
  ready_.clear();
  return taken;
}

std::optional<std::string> Pipeline::end() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return is_done_ && ready_.empty() ? end_ : std::nullopt;
}

SensorStatistics Pipeline::statistics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return statistics_;
}

void Pipeline::work() {
  while (const auto arrived = queue_.pop()) {
    count(*arrived);
    try {
      put_out(upsampling_->feed(*arrived));
    } catch (const std::exception& error) {
      messages_.add(one_line(error));
      put_out({{arrived->observation, {}}});
    }
  }
  auto last = upsampling_->finish();
  put_out(std::move(last));
  const std::lock_guard<std::mutex> lock(mutex_);
  is_done_ = true;
}

void Pipeline::count(const Arrived& arrived) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++statistics_.num_real;
  if (arrived.role == Role::scan) ++statistics_.num_scans;
  if (arrived.role == Role::image) ++statistics_.num_images;
  const bool is_image = arrived.role == Role::image;
  if (arrived.is_late && arrived.role == Role::scan) ++statistics_.num_late_scans;
  if (arrived.is_late && is_image) ++statistics_.num_late_images;
  const Stamp stamp = arrived.observation->timestamp;
  if (stamp < last_stamp_) ++statistics_.num_out_of_order;
  last_stamp_ = std::max(last_stamp_, stamp);
}

void Pipeline::put_out(std::vector<Emitted> emitted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  statistics_.num_hurried = upsampling_->num_hurried();
  for (Emitted& one : emitted) {
    if (one.image_arrival) {
      ++statistics_.num_virtual_scans;
      statistics_.ready.add(ms_since(*one.image_arrival));
    }
    ready_.push_back(std::move(one));
  }
}

}  // namespace lidar_upsampling
