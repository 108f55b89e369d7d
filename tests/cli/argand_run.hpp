#pragma once

#include "picture_bytes.hpp"
#include "support/scratch_directory.hpp"

#include <algorithm>
#include <cstdlib>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <sys/wait.h>
#include <vector>

namespace argand::testing {

// Exit codes.
inline constexpr int failure = 1;
inline constexpr int usage = 2;

struct Outcome {
    int exit_code = -1; ///< -1: ended by a signal
    std::string out, error;
};

/// Runs the command-line tool in a directory of its own.
class ArgandTest : public ::testing::Test {
protected:
    /// Environment of runs for which the device does not matter: the host compiles no kernels.
    static constexpr const char* on_host = "ARGAND_BACKEND=cpu";

    static std::string asset(const std::string& name) {
        return ARGAND_SOURCE_DIR "/assets/" + name;
    }

    /// Path of a file in the directory.
    std::string file(const std::string& name) const { return (directory_ / name).string(); }

    std::vector<std::string> files() const {
        std::vector<std::string> names = directory_.names();
        std::sort(names.begin(), names.end());
        return names;
    }

    std::string pixels(const std::string& name) const { return picture_bytes(file(name)); }

    /// Runs the tool with the API's validation on, so that any message of it is a failure.
    /// `arguments` are read by a shell, redirections included; `environment`: NAME=VALUE ...
    Outcome argand(const std::string& arguments, const std::string& environment = "") const {
        const ScratchDirectory streams;
        const std::string command =
            "cd '" + directory_.path().string() + "' && env ARGAND_VALIDATION=1 " + environment +
            " '" ARGAND_EXECUTABLE "' >'" + (streams / "out").string() + "' 2>'" +
            (streams / "error").string() + "' </dev/null " + arguments;
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(streams / "out"),
                read_text(streams / "error")};
    }

    /// Expects this exit code, an error of one line that contains `text`, no standard output and no
    /// new file.
    void expect_failure(const std::string& arguments, int exit_code, const std::string& text,
                        const std::string& environment = "") const {
        SCOPED_TRACE(arguments);
        const std::vector<std::string> before = files();
        const Outcome run = argand(arguments, environment);
        EXPECT_EQ(run.exit_code, exit_code) << run.error;
        EXPECT_THAT(run.error, ::testing::StartsWith("argand: "));
        EXPECT_THAT(run.error, ::testing::HasSubstr(text));
        EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1) << run.error;
        EXPECT_EQ(run.out, "");
        EXPECT_EQ(files(), before);
    }

private:
    ScratchDirectory directory_;
};

} // namespace argand::testing
