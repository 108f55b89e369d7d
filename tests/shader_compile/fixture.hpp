#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/wait.h>

namespace argand::shader_compile {

namespace fs = std::filesystem;

struct Outcome {
    int status;       ///< exit status, -1 if it was ended by a signal
    std::string said; ///< stdout and stderr
};

inline Outcome run(const std::string& command) {
    Outcome outcome{-1, ""};
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) {
        return outcome;
    }
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
        outcome.said += static_cast<char>(c);
    }
    const int ended = pclose(pipe);
    outcome.status = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    return outcome;
}

/// The first lines of every kernel here; the fourth is the test's own.
inline const std::string head = "#version 460\n"
                                "layout(local_size_x = 64) in;\n"
                                "#include \"kernel.glsl\"\n";

/// A folder of its own for each test, laid out as the repository: shaders/comp, shaders/shared,
/// out.
struct ShaderCompile : testing::Test {
    fs::path root =
        fs::temp_directory_path() /
        ("argand_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
         std::to_string(getpid()));

    void SetUp() override {
        fs::remove_all(root);
        fs::create_directories(root / "out/kernels");
        for (const char* file : {"comp/kernel.glsl", "shared/prelude.h"}) {
            write(std::string("shaders/") + file,
                  read(fs::path(ARGAND_SOURCE_DIR) / "shaders" / file));
        }
    }
    void TearDown() override { fs::remove_all(root); }

    void write(const fs::path& file, const std::string& text) const {
        fs::create_directories((root / file).parent_path());
        std::ofstream(root / file, std::ios::binary) << text;
    }
    static std::string read(const fs::path& file) {
        std::ifstream stream(file, std::ios::binary);
        EXPECT_TRUE(stream) << file;
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    std::string generated(const std::string& file) const {
        return read(root / "out/kernels" / file);
    }
    bool is_generated(const std::string& file) const {
        return fs::exists(root / "out/kernels" / file);
    }

    /// Runs the tool on a kernel, as the build does.
    Outcome compile(const std::string& kernel) const {
        return run(
            "cd " + root.string() +
            " && " ARGAND_TOOL
            " -I shaders -I shaders/comp --out out/kernels --depfile out/kernels/depfile.d " +
            kernel);
    }
    /// Writes shaders/comp/test/bad.comp with `head` before `body`, and runs the tool on it.
    Outcome compile_body(const std::string& body) const {
        write("shaders/comp/test/bad.comp", head + body);
        return compile("shaders/comp/test/bad.comp");
    }
    /// Runs the C++ compiler, without writing anything, on a program that sees the generated
    /// headers.
    Outcome check_cpp(const std::string& program) const {
        write("program.cpp", program);
        return check_cpp_file("program.cpp");
    }
    Outcome check_cpp_file(const std::string& file) const {
        return run("cd " + root.string() +
                   " && " ARGAND_CXX_COMPILER
                   " -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only "
                   "-Iout -Ishaders -I" ARGAND_SOURCE_DIR "/engine " +
                   file);
    }
};

} // namespace argand::shader_compile
