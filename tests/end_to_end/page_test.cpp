// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "pipeline.h"

namespace lidar_upsampling {
namespace {

bool has_program(const std::string& name) { return run("command -v " + name).status == 0; }

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A simulated log, densified and judged, and the page about it in a browser.
class Page : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_program("gnuplot")) GTEST_SKIP() << "gnuplot is not installed";
    simulate(folder_);
    densify(folder_, "--report " + folder_ / "report.json");
    ASSERT_FALSE(HasFailure());
  }

  /// page.html, and what the terminal shows beside it.
  std::string make_page(const std::string& more) {
    const std::string command = std::string(RAWLOG_EVALUATE) + " --input " +
                                folder_ / "out.rawlog" + " --html " + folder_ / "page.html " + more;
    const ToolResult made = run(command);
    EXPECT_EQ(made.status, 0) << command << '\n' << made.text;
    return made.text;
  }
  std::string make_full_page() {
    return make_page("--reference " + folder_ / "truth.rawlog" + " --truth-objects " +
                     folder_ / "in_objects.csv" + " --report " + folder_ / "report.json");
  }

  [[nodiscard]] std::string chromium(const std::string& what, const std::string& page) const {
    return "chromium --headless --no-sandbox --disable-gpu --disable-dev-shm-usage "
           "--hide-scrollbars --virtual-time-budget=10000 --user-data-dir=" +
           folder_ / "profile " + what + " file://" + folder_ / page;
  }

  /// The document as the browser built it, with what a script in it found out.
  std::string dom_of_page(int width) {
    constexpr const char* kScript = R"(<script>addEventListener('load', () => {
      const images = [...document.images];
      const root = document.documentElement;
      document.body.dataset.broken = images.filter(image => !image.naturalWidth).length;
      document.body.dataset.aside = Math.max(0, root.scrollWidth - root.clientWidth);
    });</script>)";
    std::string page = text_of(folder_ / "page.html");
    page.insert(page.rfind("</body>"), kScript);
    std::ofstream(folder_ / "probed.html") << page;
    const ToolResult dom =
        run(chromium("--window-size=" + std::to_string(width) + ",2000 --dump-dom", "probed.html"));
    EXPECT_EQ(dom.status, 0) << dom.text;
    return dom.text;
  }

  TestFolder folder_;
};

TEST_F(Page, holds_all_sections_plots_and_pictures) {
  make_full_page();
  const std::string page = text_of(folder_ / "page.html");
  for (const char* id :
       {"objects", "distribution", "conditions", "scans", "worst", "coverage", "tracks", "time"}) {
    EXPECT_TRUE(contains(page, std::string("<section id=\"") + id + "\"")) << id;
    EXPECT_TRUE(contains(page, std::string("href=\"#") + id + "\"")) << id;
  }
  // Distributions, and horizon, range, number of points for moving and static; gaps and speeds.
  EXPECT_EQ(count_of(page, "<svg"), 2 + 6 + 2);
  EXPECT_EQ(count_of(page, "<article"), 12);
  EXPECT_EQ(count_of(page, "<img"), 3 * 12);
  EXPECT_TRUE(contains(page, "Moving objects: mean position error"));
  EXPECT_TRUE(contains(page, "<p class=\"headline\">Moving objects are "));
  EXPECT_EQ(count_of(page, "class=\"headline\""), 1);
  EXPECT_EQ(count_of(page, "<title>"), 1);  // more would be wrong names beside the pointer
  EXPECT_TRUE(contains(page, "constant-velocity"));
}

TEST_F(Page, needs_no_other_file_and_no_network) {
  make_full_page();
  const std::string page = text_of(folder_ / "page.html");
  EXPECT_EQ(count_of(page, "<img"), count_of(page, "<img src=\"data:image/"));
  for (const char* outside : {"<link", "<script", "src=\"http", "url(http", "@import", "<iframe"})
    EXPECT_FALSE(contains(page, outside)) << outside;
}

TEST_F(Page, is_shown_whole_by_a_browser) {
  if (!has_program("chromium")) GTEST_SKIP() << "chromium is not installed";
  make_full_page();
  const std::string dom = dom_of_page(1280);
  EXPECT_TRUE(contains(dom, "data-broken=\"0\""));
  EXPECT_TRUE(contains(dom, "data-aside=\"0\""));
  EXPECT_EQ(count_of(dom, "<section"), 9);
  EXPECT_EQ(count_of(dom, "<article"), 12);
  EXPECT_TRUE(contains(dom_of_page(500), "data-aside=\"0\""));  // as narrow as it goes

  const ToolResult shot =
      run(chromium("--window-size=1280,3000 --screenshot=" + folder_ / "page.png", "page.html"));
  ASSERT_EQ(shot.status, 0) << shot.text;
  const cv::Mat picture = cv::imread(folder_ / "page.png");
  ASSERT_EQ(picture.cols, 1280);
  for (int top = 0; top < 3000; top += 1000) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(picture.rowRange(top, top + 1000), mean, deviation);
    EXPECT_GT(mean[0], 180) << top;  // a light page
    EXPECT_GT(deviation[0], 10) << top;
  }
}

TEST_F(Page, without_a_reference_tells_of_coverage_tracks_and_time) {
  const std::string terminal = make_page("--report " + folder_ / "report.json");
  EXPECT_TRUE(contains(terminal, "running time per virtual scan, ms"));
  const std::string page = text_of(folder_ / "page.html");
  for (const char* id : {"coverage", "tracks", "time"})
    EXPECT_TRUE(contains(page, std::string("<section id=\"") + id + "\"")) << id;
  EXPECT_FALSE(contains(page, "<section id=\"objects\""));
  EXPECT_TRUE(contains(page, "8 virtual scans raise 5 real ones"));
  EXPECT_EQ(count_of(page, "<svg"), 2);
}

TEST_F(Page, counts_an_image_at_a_real_scans_instant_there_and_not_with_the_virtual_one_beside_it) {
  make_page("--report " + folder_ / "report.json");
  EXPECT_TRUE(contains(text_of(folder_ / "page.html"),
                       "CAM0</th><td>13</td><td>8</td><td>5</td><td>0</td>"));
}

TEST_F(Page, running_times_add_up) {
  std::ifstream file(folder_ / "report.json");
  const auto report = nlohmann::json::parse(file, nullptr, false);
  double total = 0, writing = 0;
  for (const auto& stage : report["stages"]) {
    const std::string name = stage["stage"];
    if (name == "writing") writing = stage["total_ms"];
    if (name != "reading" && name != "packing" && name != "writing")
      total += stage["total_ms"].get<double>();
  }
  ASSERT_GT(writing, 0);
  const std::string text = run(std::string(RAWLOG_EVALUATE) + " --input " + folder_ / "out.rawlog" +
                               " --report " + folder_ / "report.json")
                               .text;
  double printed = 0;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find("  total "), " total %lf", &printed), 1) << text;
  EXPECT_NEAR(printed, total / report["virtual_scans"].get<double>(), 0.051);
}

TEST_F(Page, tells_of_times_that_were_taken_beside_other_work) {
  std::ifstream file(folder_ / "report.json");
  auto report = nlohmann::json::parse(file, nullptr, false);
  const int cores = report["machine"]["cores"];
  for (const int load : {cores, 3 * cores}) {
    report["machine"]["load"] = load;
    std::ofstream(folder_ / "report.json") << report;
    make_page("--report " + folder_ / "report.json");
    EXPECT_EQ(contains(text_of(folder_ / "page.html"), "Other work shared the machine"),
              load > cores);
  }
}

TEST_F(Page, asks_for_gnuplot_before_it_starts_working) {
  const ToolResult result = run_for_errors("PATH=/nowhere " + std::string(RAWLOG_EVALUATE) +
                                           " --input missing.rawlog --html " + folder_ / "x.html");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.text, "gnuplot-nox")) << result.text;
}

TEST_F(Page, a_report_that_is_none_is_refused_by_name) {
  std::ofstream(folder_ / "other.json") << R"({"stages": []})";
  const ToolResult result =
      run_for_errors(std::string(RAWLOG_EVALUATE) + " --input " + folder_ / "out.rawlog" +
                     " --report " + folder_ / "other.json");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.text, "other.json")) << result.text;
  EXPECT_EQ(run(std::string(RAWLOG_EVALUATE) + " --input " + folder_ / "out.rawlog").status, 2);
}

}  // namespace
}  // namespace lidar_upsampling
