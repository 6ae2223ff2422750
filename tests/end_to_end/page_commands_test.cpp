// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "pages.h"
#include "pipeline.h"

namespace lidar_upsampling {
namespace {

namespace fs = std::filesystem;

struct NotRun {
  const char* commands;  ///< a regular expression for their beginning
  const char* reason;
};

constexpr NotRun kNotRun[] = {
    {"(bash )?(share/(demo|install-deps|on-debian|cross-read)|tests/run)\\.sh",
     "install packages and build all"},
    {"cmake |cpack ", "build; install_test.cpp and package_test.cpp do"},
    {"git ls-files", "changes the sources; tests/run.sh runs it with --dry-run"},
    {"build/dev/tests/benchmarks/|tests/benchmarks/", "measure for minutes"},
    {"(BY=\\w+ )?share/(measure|results|mapping-study)\\.sh", "measure for minutes to hours"},
    {"(export SLURM|share/fleet/one-node-slurm|snakemake .*slurm)",
     "need Slurm's daemons, as root"},
    {"snakemake ", "fleet_test.cpp does, with a file fleet.yaml of its own"},
    {"RawLogViewer |SceneViewer3D ", "stay open; rawlogviewer_test.cpp does"},
    {"rosbag2rawlog ", "ros_bag_test.cpp does, with a bag that it makes"},
    {"rawlog-grabber \\.\\.\\.", "is cut short; rawlog-grabber stands in full above"},
};

const char* reason_not_to_run(const std::string& command) {
  for (const NotRun& kept : kNotRun)
    if (std::regex_search(command, std::regex("^(?:" + std::string(kept.commands) + ")")))
      return kept.reason;
  return nullptr;
}

// A program, and a file that it is to work on: what names a program or an option alone is none.
bool is_command(const std::string& line) {
  static const std::regex program(
      R"(^(\w+=\w+ )?((\$bin|build|share|tests)/[\w/.-]+ .|)"
      R"((bash|mkdir|cmake|cpack|git|snakemake|sleep|export|rawlog-\w+(-\w+)?|\w+2rawlog|icp-slam|)"
      R"(rbpf-slam|observations2map|RawLogViewer|SceneViewer3D) .*[\w>]*[./|]))");
  return std::regex_search(line, program);
}

std::string in_one_line(const std::string& text) {
  return std::regex_replace(text, std::regex(R"(\s+)"), " ");
}

/// What is typed at once: a block, or a command within a sentence.
std::vector<std::string> scripts_of(const std::string& page) {
  const Fenced parts = fenced(page);
  std::vector<std::string> scripts;
  for (const std::string& block : parts.blocks) {
    std::istringstream lines(std::regex_replace(block, std::regex(R"(\\\n *)"), ""));
    std::string script;
    bool has_command = false;
    for (std::string line; std::getline(lines, line); script += line + "\n")
      has_command |= is_command(line);
    if (has_command) scripts.push_back(script);
  }
  for (const std::string& span : matches(parts.prose, "`([^`]+)`"))
    if (is_command(in_one_line(span))) scripts.push_back(in_one_line(span) + "\n");
  return scripts;
}

/// The folder of a reader who has built, with stand-ins for logs that the pages take for given.
class Reader {
 public:
  Reader() {
    fs::create_directories(folder_.path() / "build");
    fs::create_symlink(BUILD_FOLDER, folder_.path() / "build/release");
    fs::copy(CONFIG_FOLDER, folder_.path() / "config", fs::copy_options::recursive);
    std::ofstream(folder_ / "config/scenarios/demo.ini") << kSmallStreet << kSmallLidar;
    expect_done("mkfifo " + folder_ / "silence");  // rawlog-grabber ends at the end of its input
    fs::create_directory(folder_.path() / "stand_ins");
    simulate_in(folder_ / "stand_ins",
                std::string(kSmallStreet) + kSmallLidar + "[log]\nformat = sensory_frames\n");
    expect_done(densify_command(folder_ / "stand_ins/in.rawlog", folder_ / "stand_ins/dense.rawlog",
                                "--report " + folder_ / "report.json"));
  }

  /// @return what went wrong, or nothing.
  std::string type(std::string script) {
    script = std::regex_replace(script, std::regex("<name>"), "demo");
    const std::vector<std::string> made =
        matches(script, R"((?:-o|--output|--truth|--html|--film) (\S+))");
    for (const std::string& log : matches(script, R"(([\w.-]+\.rawlog)\b)"))
      if (std::count(made.begin(), made.end(), log) == 0 && !fs::exists(folder_ / log))
        fs::create_symlink(
            folder_ / (log == "dense.rawlog" ? "stand_ins/dense.rawlog" : "stand_ins/in.rawlog"),
            folder_ / log);
    for (const std::string& drive : matches(script, R"(--drive (\S+))")) link_begin_of(drive);
    std::ofstream(folder_ / "script") << "set -eu\n" << script;
    const ToolResult result =
        run("cd " + folder_.path().string() +
            " && PATH=$PWD/build/release/bin:$PATH timeout 300 bash script <>silence");
    if (result.status != 0) return result.text + "\nstatus " + std::to_string(result.status);
    for (const std::string& file : made)
      if (!fs::exists(folder_ / file)) return file + " was not made";
    return {};
  }

 private:
  /// The first frames of a drive, which take a reader's place for all of them.
  void link_begin_of(const std::string& drive) const {
    constexpr int kFrames = 8;
    const fs::path from = fs::canonical(data_folder() / "kitti_raw" / drive);
    const fs::path to = folder_.path() / drive;
    if (fs::exists(to)) return;
    fs::create_directories(to);
    for (const auto& file : fs::directory_iterator(from.parent_path()))
      if (file.is_regular_file())
        fs::create_symlink(file.path(), to.parent_path() / file.path().filename());
    for (const auto& part : fs::directory_iterator(from)) {
      if (!part.is_directory()) {
        fs::create_symlink(part.path(), to / part.path().filename());
        continue;
      }
      const fs::path copy = to / part.path().filename();
      fs::create_directories(copy / "data");
      expect_done("head -n " + std::to_string(kFrames) + " " +
                  (part.path() / "timestamps.txt").string() + " > " +
                  (copy / "timestamps.txt").string());
      std::vector<fs::path> frames(fs::directory_iterator(part.path() / "data"), {});
      std::sort(frames.begin(), frames.end());
      frames.resize(std::min<std::size_t>(frames.size(), kFrames));
      for (const fs::path& frame : frames)
        fs::create_symlink(frame, copy / "data" / frame.filename());
    }
  }

  TestFolder folder_;
};

bool has_drives_of(const std::string& script) {
  const std::vector<std::string> drives = matches(script, R"(--drive (\S+))");
  return std::all_of(drives.begin(), drives.end(), [](const std::string& drive) {
    return fs::exists(data_folder() / "kitti_raw" / drive);
  });
}

/// What of a page is run, and what went wrong.
struct Outcome {
  int num_run = 0;
  std::vector<std::string> faults, not_run;
};

Outcome outcome_of(const std::string& page) {
  Reader reader;
  Outcome outcome;
  for (const std::string& written : scripts_of(page)) {
    std::istringstream lines(written);
    std::string script;
    int num_commands = 0;
    for (std::string line; std::getline(lines, line);) {
      if (reason_not_to_run(line) != nullptr) {
        outcome.not_run.push_back(line);
      } else {
        script += line + "\n";
        num_commands += is_command(line) ? 1 : 0;
      }
    }
    if (num_commands == 0) continue;
    if (!has_drives_of(script)) {
      outcome.not_run.push_back(script);
      continue;
    }
    const std::string fault = reader.type(script);
    if (!fault.empty()) outcome.faults.push_back(script + fault);
    outcome.num_run += num_commands;
  }
  return outcome;
}

TEST(PageCommands, do_as_written_what_they_promise) {
  if (run("command -v rawlog-grabber && command -v gnuplot").status != 0)
    GTEST_SKIP() << "mrpt-apps or gnuplot-nox is not installed";
  int num_run = 0;
  for (const fs::path& page : pages()) {
    const Outcome outcome = outcome_of(text_of_page(page));
    for (const std::string& fault : outcome.faults) ADD_FAILURE() << page << ": " << fault;
    num_run += outcome.num_run;
    std::cout << page.filename().string() << ": " << outcome.num_run << " run, "
              << outcome.not_run.size() << " not\n";
  }
  EXPECT_GE(num_run, 20);
}

TEST(PageCommands, that_fail_are_told_in_blocks_and_sentences) {
  const Outcome outcome = outcome_of(
      "```\nrawlog-decimate --label LIDAR -i in.rawlog -o out.rawlog\n```\nOr `rawlog-densify "
      "--chek in.rawlog`, or `rawlog-densify --check in.rawlog`.\n");
  EXPECT_EQ(outcome.num_run, 3);
  ASSERT_EQ(outcome.faults.size(), 2U);
  EXPECT_TRUE(contains(outcome.faults[0], "--keep-every is required")) << outcome.faults[0];
  EXPECT_TRUE(contains(outcome.faults[1], "--chek")) << outcome.faults[1];
}

TEST(PageCommands, that_are_not_run_are_still_in_the_pages) {
  std::string all;
  for (const fs::path& page : pages())
    for (const std::string& script : scripts_of(text_of_page(page))) all += "\n" + script;
  for (const NotRun& kept : kNotRun)
    EXPECT_TRUE(std::regex_search(all, std::regex("\n(?:" + std::string(kept.commands) + ")")))
        << kept.commands;
}

TEST(PageCommands, name_scripts_and_presets_that_there_are) {
  const std::string presets = text_of_page(PROJECT_FOLDER "/CMakePresets.json");
  for (const fs::path& page : pages()) {
    const std::string text = text_of_page(page);
    for (const std::string& preset : matches(text, R"(--preset (\w+))"))
      EXPECT_TRUE(contains(presets, "\"name\": \"" + preset + "\"")) << page << ": " << preset;
    for (const std::string& script : matches(text, R"(\b((?:share|tests)/[\w/-]+\.(?:sh|py)))"))
      EXPECT_TRUE(fs::exists(fs::path(PROJECT_FOLDER) / script)) << page << ": " << script;
  }
}

}  // namespace
}  // namespace lidar_upsampling
