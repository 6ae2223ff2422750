// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the lidar_upsampling authors
#include "install/installed.h"
#include "io/test_folder.h"

namespace lidar_upsampling {
namespace {

bool has(const std::string& program) { return run("command -v " + program).status == 0; }

/// Of packages that ctest has packed before, once for all of these tests.
class DebianPackage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has("dpkg-shlibdeps")) GTEST_SKIP() << "dpkg-dev is not installed";
  }
  [[nodiscard]] std::string file(const std::string& name) const {
    for (const auto& entry : std::filesystem::directory_iterator(PACKAGES_FOLDER))
      if (entry.path().filename().string().rfind(name + "_", 0) == 0) return entry.path().string();
    return name + ", which is not there";
  }
  [[nodiscard]] std::string field(const std::string& name, const std::string& what) const {
    return text_of("dpkg-deb --field " + file(name) + " " + what);
  }
  [[nodiscard]] std::string contents(const std::string& name) const {
    return text_of("dpkg-deb --contents " + file(name));
  }
  [[nodiscard]] std::string folder(const std::string& name) const { return folder_ / name; }

 private:
  TestFolder folder_;
};

TEST_F(DebianPackage, needs_the_libraries_that_it_uses_and_holds_what_runs) {
  const std::string depends = field("lidar-upsampling", "Depends");
  for (const char* library :
       {"libmrpt-obs", "libopencv-core", "libtbb", "libc6", "libgeographiclib"})
    EXPECT_TRUE(contains(depends, library)) << library << " is not in " << depends;
  EXPECT_FALSE(contains(depends, "-dev"));
  const std::string listed = contents("lidar-upsampling");
  for (const std::string& tool : tool_names())
    for (const std::string& path : {"./usr/bin/" + tool, "./usr/share/man/man1/" + tool + ".1.gz",
                                    "./usr/share/bash-completion/completions/" + tool})
      EXPECT_TRUE(contains(listed, path + "\n")) << path << " is not in\n" << listed;
  EXPECT_FALSE(contains(listed, "./usr/include/lidar_upsampling"));
}

TEST_F(DebianPackage, for_developers_holds_library_and_headers) {
  EXPECT_TRUE(contains(field("liblidar-upsampling-dev", "Depends"), "libmrpt-obs-dev"));
  const std::string listed = contents("liblidar-upsampling-dev");
  for (const char* path :
       {"./usr/" INSTALLED_LIBDIR "/liblidar_upsampling.a",
        "./usr/include/lidar_upsampling/upsampler.h",
        "./usr/" INSTALLED_LIBDIR "/cmake/lidar_upsampling/lidar_upsampling-config.cmake"})
    EXPECT_TRUE(contains(listed, std::string(path) + "\n")) << path << " is not in\n" << listed;
}

TEST_F(DebianPackage, is_left_in_the_build_folder_not_where_cpack_is_called) {
  text_of("cd " + folder(".") +
          " && cpack -G DEB --config " BUILD_FOLDER
          "/CPackConfig.cmake -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip"
          " -D CPACK_COMPONENTS_ALL=development");
  EXPECT_TRUE(std::filesystem::is_empty(folder(".")));
  EXPECT_TRUE(std::filesystem::exists(BUILD_FOLDER "/packages"));
}

TEST_F(DebianPackage, tells_what_is_new) {
  for (const char* const name : {"lidar-upsampling", "liblidar-upsampling-dev"}) {
    text_of("dpkg-deb --extract " + file(name) + " " + folder(name));
    text_of("gunzip --stdout " + folder(name) + "/usr/share/doc/" + name + "/changelog.gz > " +
            folder("changelog"));
    const std::string changes = text_of("dpkg-parsechangelog -l " + folder("changelog"));
    EXPECT_TRUE(contains(changes, "Source: lidar-upsampling\n")) << changes;
    EXPECT_TRUE(contains(changes, "  * ")) << changes;
  }
}

TEST_F(DebianPackage, runs_from_where_it_is_unpacked) {
  text_of("dpkg-deb --extract " + file("lidar-upsampling") + " " + folder("root"));
  const std::string usr = folder("root/usr/");
  text_of(usr + "bin/rawlog-simulate --scenario " + usr +
          "share/lidar_upsampling/config/scenarios/small.ini --duration 0.2 --output " +
          folder("in.rawlog"));
  EXPECT_TRUE(contains(text_of(usr + "bin/rawlog-densify --config " + usr +
                               "share/lidar_upsampling/config/default.ini --input " +
                               folder("in.rawlog") + " --output " + folder("out.rawlog")),
                       "virtual scans"));
  EXPECT_TRUE(contains(text_of("readelf --dynamic " + usr + "bin/rawlog-densify"),
                       "RUNPATH)            Library runpath: [$ORIGIN/../" INSTALLED_LIBDIR
                       "/lidar_upsampling]\n"));
}

TEST_F(DebianPackage, has_no_error_that_lintian_knows) {
  if (!has("lintian")) GTEST_SKIP() << "lintian is not installed";
  const ToolResult found = run("lintian --allow-root --fail-on none " + file("lidar-upsampling") +
                               " " + file("liblidar-upsampling-dev"));
  EXPECT_FALSE(contains("\n" + found.text, "\nE: ")) << found.text;
}

}  // namespace
}  // namespace lidar_upsampling
