// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "plugin/pipeline.h"

#include <gtest/gtest.h>

#include <future>
#include <stdexcept>

#include "plugin/observed.h"

namespace lidar_upsampling {
namespace {

using mrpt::obs::CObservation;
using Names = std::vector<std::string>;

Role by_label(const CObservation& observation) {
  if (observation.sensorLabel == "LIDAR") return Role::scan;
  return observation.sensorLabel == "CAM0" ? Role::image : Role::other;
}

// A "virtual scan" behind every image that is not late. Its first observation keeps it busy until
// it is let go on.
class SlowUpsampling : public Upsampling {
 public:
  explicit SlowUpsampling(std::shared_future<void> go_on, std::promise<void>* is_busy = nullptr)
      : go_on_(std::move(go_on)), is_busy_(is_busy) {}

  std::vector<Emitted> feed(const Arrived& arrived) override {
    if (is_busy_ != nullptr) is_busy_->set_value();
    is_busy_ = nullptr;
    go_on_.wait();
    if (arrived.observation->sensorLabel == "BROKEN") throw std::runtime_error("it is broken");
    std::vector<Emitted> out{{arrived.observation, {}}};
    if (arrived.role == Role::image && !arrived.is_late) {
      num_hurried_ += arrived.is_hurried ? 1 : 0;
      auto scan = mrpt::obs::CObservationComment::Create();
      scan->sensorLabel = "VIRTUAL";
      scan->timestamp = arrived.observation->timestamp;
      out.push_back({scan, arrived.time});
    }
    return out;
  }
  std::vector<Emitted> finish() override { return {{observed("LAST", 1000), {}}}; }
  [[nodiscard]] std::size_t num_hurried() const override { return num_hurried_; }

 private:
  std::shared_future<void> go_on_;
  std::promise<void>* is_busy_;
  std::size_t num_hurried_ = 0;
};

struct LiveRun {
  explicit LiveRun(const QueueOptions& options) {
    pipeline = std::make_unique<Pipeline>(
        options, by_label, std::make_unique<SlowUpsampling>(go_on.get_future().share(), &is_busy),
        messages);
  }
  ~LiveRun() { pipeline.reset(); }

  // All that comes out until the end.
  Names rest() {
    Names names;
    while (!pipeline->end())
      for (const auto& observation : pipeline->take()) names.push_back(name_of(*observation));
    return names;
  }

  std::promise<void> go_on, is_busy;
  Messages messages;
  std::unique_ptr<Pipeline> pipeline;
};

constexpr QueueOptions::Milliseconds kAtOnce{0};

TEST(Pipeline, hurried_images_have_their_virtual_scans_and_are_counted) {
  LiveRun live({kAtOnce, std::chrono::hours(1)});
  live.pipeline->push(observed("LIDAR", 0));
  live.is_busy.get_future().wait();
  for (const int ms : {0, 33}) live.pipeline->push(observed("CAM0", ms));
  live.pipeline->finish("over");
  live.go_on.set_value();
  EXPECT_EQ(live.rest(),
            (Names{"LIDAR 0", "CAM0 0", "VIRTUAL 0", "CAM0 33", "VIRTUAL 33", "LAST 1000"}));
  const SensorStatistics statistics = live.pipeline->statistics();
  EXPECT_EQ(statistics.num_real, 3U);
  EXPECT_EQ(statistics.num_scans, 1U);
  EXPECT_EQ(statistics.num_images, 2U);
  EXPECT_EQ(statistics.num_hurried, 2U);
  EXPECT_EQ(statistics.num_late_images, 0U);
  EXPECT_EQ(statistics.num_virtual_scans, 2U);
  EXPECT_EQ(statistics.ready.count(), 2U);
  EXPECT_EQ(statistics.delivered.count(), 2U);
}

TEST(Pipeline, late_ones_are_passed_on_in_time_order_and_counted) {
  LiveRun live({kAtOnce, kAtOnce});
  live.pipeline->push(observed("POSE", 0));
  live.is_busy.get_future().wait();
  Names expected{"POSE 0"};
  for (int ms = 1; ms <= 300; ++ms) {
    const char* const label = ms % 3 == 0 ? "LIDAR" : (ms % 3 == 1 ? "CAM0" : "POSE");
    live.pipeline->push(observed(label, ms));
    expected.push_back(label + (" " + std::to_string(ms)));
  }
  live.pipeline->finish("over");
  live.go_on.set_value();
  Names real = live.rest();
  real.erase(std::remove_if(real.begin(), real.end(),
                            [](const std::string& name) {
                              return name.rfind("VIRTUAL", 0) == 0 || name.rfind("LAST", 0) == 0;
                            }),
             real.end());
  EXPECT_EQ(real, expected);
  EXPECT_EQ(live.pipeline->statistics().num_late_images, 100U);
  EXPECT_EQ(live.pipeline->statistics().num_late_scans, 100U);
  EXPECT_EQ(live.pipeline->statistics().num_virtual_scans, 0U);
  EXPECT_EQ(live.pipeline->statistics().num_out_of_order, 0U);
}

TEST(Pipeline, a_real_observation_that_arrives_far_too_late_is_passed_on_and_counted) {
  LiveRun live({});
  live.go_on.set_value();
  live.pipeline->push(observed("POSE", 50));
  while (live.pipeline->statistics().num_real == 0) std::this_thread::yield();
  live.pipeline->push(observed("POSE", 20));
  live.pipeline->finish("over");
  EXPECT_EQ(live.rest(), (Names{"POSE 50", "POSE 20", "LAST 1000"}));
  EXPECT_EQ(live.pipeline->statistics().num_out_of_order, 1U);
}

TEST(Pipeline, an_observation_that_cannot_be_worked_on_is_passed_on_with_a_message) {
  LiveRun live({});
  live.go_on.set_value();
  live.pipeline->push(observed("BROKEN", 0));
  live.pipeline->finish("over");
  EXPECT_EQ(live.rest(), (Names{"BROKEN 0", "LAST 1000"}));
  EXPECT_EQ(live.messages.take(), (Names{"it is broken"}));
}

TEST(Pipeline, the_first_reason_to_end_is_told_after_the_last_observation_was_taken) {
  LiveRun live({});
  live.go_on.set_value();
  live.pipeline->push(observed("POSE", 0));
  EXPECT_FALSE(live.pipeline->end());
  live.pipeline->finish("over");
  live.pipeline->finish("over again");
  EXPECT_EQ(live.rest().size(), 2U);
  EXPECT_EQ(live.pipeline->end(), "over");
}

TEST(Latencies, quantiles_are_those_of_the_sorted_times) {
  Latencies durations;
  EXPECT_EQ(durations.quantile_ms(0.5), 0);
  for (int ms = 100; ms >= 0; --ms) durations.add(ms);
  EXPECT_DOUBLE_EQ(durations.quantile_ms(0), 0);
  EXPECT_DOUBLE_EQ(durations.quantile_ms(0.5), 50);
  EXPECT_DOUBLE_EQ(durations.quantile_ms(0.95), 95);
  EXPECT_DOUBLE_EQ(durations.quantile_ms(1), 100);
}

}  // namespace
}  // namespace lidar_upsampling
