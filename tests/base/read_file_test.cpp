#include "base/read_file.hpp"

#include "base/error.hpp"
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace argand {
namespace {

std::string problem_of(const std::filesystem::path& path) {
    try {
        read_file(path);
    } catch (const Error& problem) {
        return problem.what();
    }
    return "none";
}

struct ReadFile : testing::Test {
    std::filesystem::path directory =
        std::filesystem::path(testing::TempDir()) / ("argand_read_file_" + std::to_string(getpid()));
    void SetUp() override { std::filesystem::create_directories(directory); }
    void TearDown() override { std::filesystem::remove_all(directory); }
};

TEST_F(ReadFile, GivesTheBytes) {
    std::ofstream(directory / "bytes", std::ios::binary) << std::string("a\0\xff\n", 4);
    EXPECT_EQ(read_file(directory / "bytes"), (std::vector<std::uint8_t>{'a', 0, 0xff, '\n'}));
    std::ofstream(directory / "empty").flush();
    EXPECT_TRUE(read_file(directory / "empty").empty());
}

TEST_F(ReadFile, SaysWhatIsWrong) {
    EXPECT_THAT(problem_of(directory / "absent"), testing::HasSubstr("there is no such file"));
    EXPECT_THAT(problem_of(directory), testing::HasSubstr("it is a directory"));
    EXPECT_THAT(problem_of(""), testing::HasSubstr("there is no such file"));
    EXPECT_THAT(problem_of(directory / std::string(5000, 'x')), testing::HasSubstr("cannot read"));
}

TEST_F(ReadFile, DoesNotWaitForAPipe) {
    ASSERT_EQ(mkfifo((directory / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(problem_of(directory / "pipe"), testing::HasSubstr("it is not a regular file"));
}

TEST_F(ReadFile, SaysThatPermissionsForbidIt) {
    if (geteuid() == 0) {
        GTEST_SKIP() << "root may read everything";
    }
    std::ofstream(directory / "secret") << "x";
    std::filesystem::permissions(directory / "secret", std::filesystem::perms::none);
    EXPECT_THAT(problem_of(directory / "secret"), testing::HasSubstr("permissions"));
}

} // namespace
} // namespace argand
