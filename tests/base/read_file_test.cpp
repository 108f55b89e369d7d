#include "base/read_file.hpp"

#include "base/error.hpp"
#include "support/scratch_directory.hpp"
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

struct ReadFile : ::testing::Test {
    testing::ScratchDirectory directory;
};

TEST_F(ReadFile, GivesTheBytes) {
    std::ofstream(directory / "bytes", std::ios::binary) << std::string("a\0\xff\n", 4);
    EXPECT_EQ(read_file(directory / "bytes"), (std::vector<std::uint8_t>{'a', 0, 0xff, '\n'}));
    std::ofstream(directory / "empty").flush();
    EXPECT_TRUE(read_file(directory / "empty").empty());
}

TEST_F(ReadFile, NamesTheProblem) {
    EXPECT_THAT(problem_of(directory / "absent"), ::testing::HasSubstr("there is no such file"));
    EXPECT_THAT(problem_of(directory.path()), ::testing::HasSubstr("it is a directory"));
    EXPECT_THAT(problem_of(""), ::testing::HasSubstr("there is no such file"));
    EXPECT_THAT(problem_of(directory / std::string(5000, 'x')),
                ::testing::HasSubstr("cannot read"));
}

TEST_F(ReadFile, DoesNotWaitForAPipe) {
    ASSERT_EQ(mkfifo((directory / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(problem_of(directory / "pipe"), ::testing::HasSubstr("it is not a regular file"));
}

TEST_F(ReadFile, NamesMissingPermissions) {
    namespace fs = std::filesystem;
    testing::write_text(directory / "secret", "x");
    fs::permissions(directory.path(), fs::perms::all);
    fs::permissions(directory / "secret", fs::perms::none);
    const bool is_root = geteuid() == 0; // root may read every file
    if (is_root) {
        ASSERT_EQ(seteuid(65534), 0);
    }
    const std::string problem = problem_of(directory / "secret");
    if (is_root) {
        ASSERT_EQ(seteuid(0), 0);
    }
    EXPECT_THAT(problem, ::testing::HasSubstr("permissions"));
}

} // namespace
} // namespace argand
