// Runs tools/setup against simulated systems. Stand-ins replace its commands (dpkg-query, apt-get,
// sudo, id): they answer from files and record their calls, so nothing is installed and the result
// does not depend on the host.

#include <array>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Setup : public testing::Test {
protected:
    void SetUp() override {
        std::string pattern = fs::temp_directory_path() / "argand_setup_XXXXXX";
        ASSERT_NE(mkdtemp(pattern.data()), nullptr);
        folder = pattern;
        fs::create_directory(folder / "bin");
        // What tools/setup needs of the real system; nothing else is on its path.
        fs::create_symlink("/bin/bash", folder / "bin/bash");
        fs::create_symlink("/usr/bin/env", folder / "bin/env");
        fs::create_symlink("/bin/cat", folder / "bin/cat");
        system("ID=debian\nVERSION_ID=\"12\"\n");
        user(0);
        // Every package is installed but those listed in the file `lacking`.
        command("dpkg-query", "for name in \"${@:4}\"; do\n"
                              "  state=installed; while read -r line; do\n"
                              "    [[ $line != \"$name\" ]] || state=not-installed\n"
                              "  done < \"$FOLDER/lacking\"; echo \"$name $state\"; done");
        command("apt-get",
                "echo \"apt-get $*\" >> \"$FOLDER/calls\"; exec bash \"$FOLDER/apt\" \"$@\"");
        write("apt", "exit 0");
        lacking("");
    }
    void TearDown() override { fs::remove_all(folder); }

    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
    }
    void command(const std::string& name, const std::string& body) const {
        write("bin/" + name, "#!" + (folder / "bin/bash").string() + "\n" + body + "\n");
        fs::permissions(folder / "bin" / name, fs::perms::owner_all);
    }
    void system(const std::string& os_release) const { write("os-release", os_release); }
    void user(int id) const { command("id", fmt::format("echo {}", id)); }
    void lacking(const std::string& packages) const { write("lacking", packages); }

    /// How apt-get was called, one line per call; empty if it was not.
    std::string calls() const {
        std::ifstream stream(folder / "calls");
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    /// Runs tools/setup; returns its exit status and keeps in `output` the text that it printed.
    int run(const std::string& arguments = "") {
        const std::string line = fmt::format(
            "env -i PATH={0}/bin FOLDER={0} ARGAND_OS_RELEASE={0}/os-release bash {1}/tools/setup "
            "{2} 2>&1 </dev/null",
            folder.string(), ARGAND_SOURCE_DIR, arguments);
        output.clear();
        FILE* const pipe = popen(line.c_str(), "r");
        if (pipe == nullptr)
            return -1;
        std::array<char, 256> part{};
        while (fgets(part.data(), static_cast<int>(part.size()), pipe) != nullptr)
            output += part.data();
        const int status = pclose(pipe);
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    fs::path folder;
    std::string output;
};

TEST_F(Setup, DoesNothingWhereNothingIsMissing) {
    EXPECT_EQ(run(), 0) << output;
    EXPECT_THAT(output, HasSubstr("packages are installed"));
    EXPECT_THAT(calls(), IsEmpty());
}

TEST_F(Setup, RootInstallsWhatIsMissingAndNothingElse) {
    lacking("libfmt-dev\nccache\n");
    EXPECT_EQ(run(), 0) << output;
    EXPECT_EQ(calls(), "apt-get update -q -o DPkg::Lock::Timeout=300\n"
                       "apt-get install -y -q --no-install-recommends -o Dpkg::Use-Pty=0 "
                       "-o DPkg::Lock::Timeout=300 ccache libfmt-dev\n");
    EXPECT_THAT(output, HasSubstr("installing ccache libfmt-dev"));
}

TEST_F(Setup, UsesSudoWhereItNeedsNoPassword) {
    user(1000);
    lacking("libfmt-dev\n");
    command("sudo", "[[ $1 != -n ]] || exit 0\necho sudo >> \"$FOLDER/calls\"; exec \"$@\"");
    EXPECT_EQ(run(), 0) << output;
    EXPECT_THAT(calls(), HasSubstr("sudo\napt-get update"));
    EXPECT_THAT(calls(), HasSubstr("sudo\napt-get install"));
}

TEST_F(Setup, NamesTheMissingWithoutRootOrSudo) {
    user(1000);
    lacking("libfmt-dev\nccache\n");
    EXPECT_EQ(run(), 1) << output;
    EXPECT_THAT(output, HasSubstr("missing packages: ccache libfmt-dev\n"));
    EXPECT_THAT(output, HasSubstr("run tools/setup as root"));
    command("sudo", "exit 1"); // it wants a password, and nobody can type one
    EXPECT_EQ(run(), 1) << output;
    EXPECT_THAT(output, HasSubstr("missing packages: ccache libfmt-dev\n"));
    EXPECT_THAT(calls(), IsEmpty());
}

TEST_F(Setup, NamesTheMissingOnAnotherDistribution) {
    lacking("libfmt-dev\n");
    system("ID=ubuntu\nVERSION_ID=\"24.04\"\n");
    EXPECT_EQ(run(), 1) << output;
    EXPECT_THAT(output, HasSubstr("missing packages: libfmt-dev\n"));
    EXPECT_THAT(output, HasSubstr("not Debian 12 (it is: ubuntu 24.04)"));
    fs::remove(folder / "os-release");
    fs::remove(folder / "bin/dpkg-query"); // no dpkg at all: nothing is known to be there
    EXPECT_EQ(run(), 1) << output;
    EXPECT_THAT(output, HasSubstr("libglm-dev"));
    EXPECT_THAT(calls(), IsEmpty());
}

TEST_F(Setup, PassesOnAnotherDistributionThatHasEverything) {
    system("ID=ubuntu\nVERSION_ID=\"24.04\"\n");
    EXPECT_EQ(run(), 0) << output;
}

TEST_F(Setup, InstallsDevelopersPackagesOnlyForThem) {
    lacking("clang-tidy\nlibomp-14-dev\n");
    EXPECT_EQ(run(), 0) << output;
    EXPECT_THAT(calls(), IsEmpty());
    EXPECT_EQ(run("--dev"), 0) << output;
    EXPECT_THAT(calls(), HasSubstr("libomp-14-dev clang-tidy\n"));
    user(1000);
    EXPECT_EQ(run("--dev"), 1) << output;
    EXPECT_THAT(output, HasSubstr("missing packages: libomp-14-dev clang-tidy\n"));
}

TEST_F(Setup, RefusesOtherArguments) {
    EXPECT_EQ(run("--help"), 2) << output;
    EXPECT_THAT(output, HasSubstr("usage: tools/setup [--dev]"));
    EXPECT_EQ(run("--dev --dev"), 2) << output;
}

TEST_F(Setup, EmbreeIsOptional) {
    lacking("libembree-dev\n");
    write("apt", "[[ $1 != install ]]"); // an architecture without Embree
    EXPECT_EQ(run(), 0) << output;
    EXPECT_THAT(calls(), HasSubstr("libembree-dev"));
    EXPECT_THAT(output, HasSubstr("continuing without libembree-dev"));
    user(1000);
    EXPECT_EQ(run(), 0) << output;
    EXPECT_THAT(output, HasSubstr("missing, but optional: libembree-dev"));
}

TEST_F(Setup, FailsWhereAptFails) {
    lacking("libfmt-dev\n");
    write("apt", "[[ $1 != update ]]");
    EXPECT_EQ(run(), 1) << output;
    EXPECT_THAT(output, HasSubstr("apt-get update failed"));
    EXPECT_THAT(calls(), Not(HasSubstr("install")));
    write("apt", "[[ $1 != install ]]");
    EXPECT_EQ(run(), 1) << output;
    EXPECT_THAT(output, HasSubstr("could not install"));
}

} // namespace
