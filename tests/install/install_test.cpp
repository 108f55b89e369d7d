#include "image/files.hpp"
#include "support/scratch_directory.hpp"
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>

using namespace argand;
using namespace argand::testing;
using ::testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

/// Installs this build into an empty prefix and runs commands beside it.
class Install : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_EQ(run(fmt::format("{} --install {} --prefix {}", ARGAND_CMAKE, ARGAND_BINARY_DIR,
                                  prefix().string())),
                  0)
            << log();
    }

    fs::path prefix() const { return directory_ / "prefix"; }
    fs::path file(const std::string& name) const { return directory_ / name; }

    /// Exit status of a shell command; `log` then is what it printed. -1: ended by a signal.
    int run(const std::string& command) const {
        const std::string logged = fmt::format("(cd {} && {}) >{} 2>&1", directory_.path().string(),
                                               command, file("log").string());
        const int status = std::system(logged.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string log() const { return read_text(file("log")); }

    /// Configures and builds a project that finds Argand in the prefix.
    void build(const fs::path& source) const {
        ASSERT_EQ(
            run(fmt::format("{} -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER={} "
                            "-DCMAKE_PREFIX_PATH={} -S {} -B build",
                            ARGAND_CMAKE, ARGAND_CXX_COMPILER, prefix().string(), source.string())),
            0)
            << log();
        ASSERT_EQ(run(fmt::format("{} --build build", ARGAND_CMAKE)), 0) << log();
    }

private:
    ScratchDirectory directory_;
};

TEST_F(Install, PlacesTheToolTheLibraryItsHeadersAndTheLicence) {
    EXPECT_EQ(run(prefix().string() + "/bin/argand --version"), 0);
    EXPECT_THAT(log(), HasSubstr(ARGAND_VERSION));
    EXPECT_TRUE(fs::exists(prefix() / "include/argand/session/render.hpp"));
    EXPECT_TRUE(fs::exists(prefix() / "include/argand/shared/footprint_records.h"));
    EXPECT_FALSE(fs::exists(prefix() / "include/argand/device/vulkan"));
    EXPECT_TRUE(fs::exists(prefix() / "share/doc/argand/LICENSE"));
    int libraries = 0, packages = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(prefix())) {
        libraries += entry.path().filename() == "libargand.a";
        packages += entry.path().filename() == "argand-config.cmake";
    }
    EXPECT_EQ(libraries, 1);
    EXPECT_EQ(packages, 1);
}

TEST_F(Install, PackageNamesNoPathOfTheSourcesOrTheBuild) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(prefix())) {
        if (entry.path().extension() == ".cmake") {
            const std::string text = read_text(entry.path());
            EXPECT_EQ(text.find(ARGAND_SOURCE_DIR), std::string::npos) << entry.path();
            EXPECT_EQ(text.find(ARGAND_BINARY_DIR), std::string::npos) << entry.path();
        }
    }
}

TEST_F(Install, SlowExampleRendersTheSameImageAsTheTool) {
    ASSERT_NO_FATAL_FAILURE(build(ARGAND_SOURCE_DIR "/examples/render"));
    const std::string scene = ARGAND_SOURCE_DIR "/assets/cornell_glass.glb ";
    ASSERT_EQ(run("build/render " + scene + "example.exr"), 0) << log();
    EXPECT_THAT(log(), HasSubstr("100 %"));
    ASSERT_EQ(run(prefix().string() + "/bin/argand render " + scene +
                  "--size 128x128 --photons 600000 -o tool.exr"),
              0)
        << log();
    const std::vector<Layer> example = read_image(file("example.exr"));
    const std::vector<Layer> tool = read_image(file("tool.exr"));
    ASSERT_EQ(example.size(), tool.size());
    for (std::size_t i = 0; i < tool.size(); ++i) {
        EXPECT_EQ(example[i].name, tool[i].name);
        EXPECT_TRUE(example[i].image.pixels == tool[i].image.pixels) << tool[i].name;
    }
    EXPECT_EQ(run("build/render missing.glb example.exr"), 1);
    EXPECT_THAT(log(), HasSubstr("missing.glb"));
}

TEST_F(Install, SlowEveryHeaderCompiles) {
    const fs::path headers = prefix() / "include/argand";
    std::string source;
    int count = 0;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(headers)) {
        // The .h files are those of kernels, too; C++ sources get them through the .hpp files.
        if (entry.path().extension() == ".hpp") {
            source += "#include \"" + fs::relative(entry.path(), headers).string() + "\"\n";
            ++count;
        }
    }
    EXPECT_GT(count, 40);
    write_text(file("headers.cpp"), source);
    write_text(file("CMakeLists.txt"), "cmake_minimum_required(VERSION 3.25)\n"
                                       "project(headers LANGUAGES C CXX)\n"
                                       "find_package(argand REQUIRED)\n"
                                       "add_library(headers OBJECT headers.cpp)\n"
                                       "target_link_libraries(headers PRIVATE argand::argand)\n");
    ASSERT_NO_FATAL_FAILURE(build("."));
}

} // namespace
