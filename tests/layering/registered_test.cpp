// Checks that every CTest test runs at least one test.
#include "support/scratch_directory.hpp"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <regex>
#include <set>

namespace argand {
namespace {

using testing::read_text;
namespace fs = std::filesystem;

/// Test folders that contain a test, or an instantiation of tests, whose name contains "Slow" (or
/// does not).
std::set<std::string> folders_with_tests(bool slow) {
    const std::regex begin(
        R"((TEST|TEST_F|TEST_P)\(\s*\w+,\s*\w+\s*\)\s*\{|INSTANTIATE_TEST_SUITE_P\(Slow)");
    std::set<std::string> folders;
    for (const fs::directory_entry& entry :
         fs::recursive_directory_iterator(fs::path(ARGAND_SOURCE_DIR) / "tests")) {
        if (entry.path().extension() != ".cpp") {
            continue;
        }
        const std::string text = read_text(entry.path());
        for (std::sregex_iterator match(text.begin(), text.end(), begin), end; match != end;
             ++match) {
            if ((match->str().find("Slow") != std::string::npos) == slow) {
                folders.insert(entry.path().parent_path().filename());
            }
        }
    }
    return folders;
}

/// The folders FOLDER of the CTest tests FOLDER.kind.
std::set<std::string> registered(const std::string& kind) {
    const std::string text = read_text(fs::path(ARGAND_BINARY_DIR) / "tests/CTestTestfile.cmake");
    const std::regex line(R"(add_test\(\S*?(\w+)\.)" + kind + R"(\W)");
    std::set<std::string> folders;
    for (std::sregex_iterator match(text.begin(), text.end(), line), end; match != end; ++match) {
        folders.insert((*match)[1]);
    }
    return folders;
}

TEST(Registered, FoldersWithSlowTestsAreRegistered) {
    EXPECT_TRUE(registered("slow").contains("parallel"));
    EXPECT_EQ(registered("slow"), folders_with_tests(true));
}

TEST(Registered, FoldersWithQuickTestsAreRegistered) {
    EXPECT_TRUE(registered("quick").contains("layering"));
    EXPECT_EQ(registered("quick"), folders_with_tests(false));
}

} // namespace
} // namespace argand
