#include "base/atomic_write.hpp"
#include "support/expect_error.hpp"
#include "support/scratch_directory.hpp"
#include <csignal>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace argand;
using namespace argand::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

/// Lets root, whom permissions do not bind, act as the user nobody until the end of the scope.
class WithoutPrivilege {
public:
    WithoutPrivilege() {
        if (::geteuid() == 0) {
            was_root_ = ::seteuid(65534) == 0;
        }
    }
    ~WithoutPrivilege() {
        if (was_root_ && ::seteuid(0) != 0) {
            ADD_FAILURE() << "cannot become root again";
        }
    }

private:
    bool was_root_ = false;
};

/// Makes writes beyond `bytes` of a file fail, as on a full disk, until the end of the scope.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_{};
    void (*handler_)(int) = SIG_DFL;
};

/// Changes the working directory until the end of the scope.
class WorkingDirectory {
public:
    explicit WorkingDirectory(const fs::path& path) : before_(fs::current_path()) {
        fs::current_path(path);
    }
    ~WorkingDirectory() { fs::current_path(before_); }

private:
    fs::path before_;
};

TEST(AtomicWrite, WritesBytesAndReplacesAFile) {
    const ScratchDirectory scratch;
    const fs::path target = scratch / "picture.bin";
    const std::string bytes("a\0b\n\xff", 5);
    write_atomically(target, bytes);
    EXPECT_EQ(read_text(target), bytes);
    write_atomically(target, "new");
    EXPECT_EQ(read_text(target), "new");
    write_atomically(target, "");
    EXPECT_EQ(read_text(target), "");
    EXPECT_THAT(scratch.names(), ElementsAre("picture.bin"));
}

TEST(AtomicWrite, TakesRelativePathsAndTheLongestNames) {
    const ScratchDirectory scratch;
    const WorkingDirectory there(scratch.path());
    write_atomically("plain", "1");
    EXPECT_EQ(read_text(scratch / "plain"), "1");
    fs::create_directory("folder");
    write_atomically("folder/../folder/./file", "2");
    EXPECT_EQ(read_text(scratch / "folder/file"), "2");
    const std::string longest(255, 'n');
    write_atomically(longest, "3");
    EXPECT_EQ(read_text(scratch / longest), "3");
}

TEST(AtomicWrite, KeepsPermissionsAndLinks) {
    const ScratchDirectory scratch;
    const fs::path file = scratch / "file", link = scratch / "link";
    write_text(file, "old");
    fs::permissions(file, fs::perms(0604));
    fs::create_symlink("file", link);
    write_atomically(link, "new");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(read_text(file), "new");
    EXPECT_EQ(fs::status(file).permissions(), fs::perms(0604));

    fs::create_symlink("not-yet", scratch / "dangling");
    write_atomically(scratch / "dangling", "through");
    EXPECT_EQ(read_text(scratch / "not-yet"), "through");
}

TEST(AtomicWrite, GivesNewFilesTheUsersMask) {
    const ScratchDirectory scratch;
    const mode_t mask = ::umask(027);
    write_atomically(scratch / "file", "x");
    ::umask(mask);
    EXPECT_EQ(fs::status(scratch / "file").permissions(), fs::perms(0640));
}

TEST(AtomicWrite, WritesToDevicesWithoutReplacingThem) {
    write_atomically("/dev/null", "gone");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    const std::string message = error_of([] { write_atomically("/dev/full", "too much"); });
    EXPECT_THAT(message, HasSubstr("/dev/full"));
    EXPECT_THAT(message, HasSubstr("No space left"));
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicWrite, RefusesADirectory) {
    const ScratchDirectory scratch;
    fs::create_directory(scratch / "folder");
    for (const fs::path& target : {scratch / "folder", scratch / "folder/",
                                   scratch / "folder/missing/..", fs::path("."), fs::path("/")}) {
        EXPECT_THAT(error_of([&] { write_atomically(target, "x"); }),
                    ::testing::AnyOf(HasSubstr("directory"), HasSubstr("does not exist")))
            << target;
    }
    EXPECT_THAT(error_of([&] { write_atomically(scratch / "folder", "x"); }),
                HasSubstr("it is a directory"));
    EXPECT_TRUE(fs::is_empty(scratch / "folder"));
}

TEST(AtomicWrite, NamesWhatIsMissing) {
    const ScratchDirectory scratch;
    const fs::path target = scratch / "no/such/place.exr";
    const std::string message = error_of([&] { write_atomically(target, "x"); });
    EXPECT_THAT(message, HasSubstr(target.string()));
    EXPECT_THAT(message, HasSubstr("no/such' does not exist"));
    EXPECT_THAT(message, HasSubstr("create it"));
    EXPECT_THAT(error_of([] { write_atomically("", "x"); }), HasSubstr("name is empty"));
    write_text(scratch / "file", "");
    EXPECT_THAT(error_of([&] { write_atomically(scratch / "file/below.png", "x"); }),
                HasSubstr("Not a directory"));
    EXPECT_THAT(error_of([&] { write_atomically(scratch / std::string(256, 'n'), "x"); }),
                HasSubstr("too long"));
    fs::create_symlink("loop", scratch / "loop");
    EXPECT_THAT(error_of([&] { write_atomically(scratch / "loop", "x"); }),
                HasSubstr("symbolic links"));
}

TEST(AtomicWrite, RespectsWriteProtection) {
    const ScratchDirectory scratch;
    fs::permissions(scratch.path(), fs::perms(0777));
    fs::create_directory(scratch / "locked");
    fs::permissions(scratch / "locked", fs::perms(0555));
    write_text(scratch / "kept.png", "old");
    fs::permissions(scratch / "kept.png", fs::perms(0444));
    {
        const WithoutPrivilege nobody;
        EXPECT_THAT(error_of([&] { write_atomically(scratch / "kept.png", "new"); }),
                    HasSubstr("write-protected"));
        const std::string message =
            error_of([&] { write_atomically(scratch / "locked/new.png", "new"); });
        EXPECT_THAT(message, HasSubstr("locked/new.png"));
        EXPECT_THAT(message, HasSubstr("Permission denied"));
        EXPECT_THAT(error_of([&] { check_writable(scratch / "locked/new.png"); }),
                    HasSubstr("Permission denied"));
    }
    EXPECT_EQ(read_text(scratch / "kept.png"), "old");
    EXPECT_TRUE(fs::is_empty(scratch / "locked"));
}

TEST(AtomicWrite, LeavesTheOldFileWhenTheDiskIsFull) {
    const ScratchDirectory scratch;
    const fs::path target = scratch / "picture.exr";
    write_text(target, "old");
    {
        const FullDisk full(4096);
        EXPECT_THAT(error_of([&] { write_atomically(target, std::string(100000, 'x')); }),
                    HasSubstr("make room"));
    }
    EXPECT_EQ(read_text(target), "old");
    EXPECT_THAT(scratch.names(), ElementsAre("picture.exr"));
}

TEST(AtomicWrite, PutsAFileThatAnotherProgramWroteInPlace) {
    const ScratchDirectory scratch;
    const fs::path target = scratch / "film", link = scratch / "link";
    write_text(target, "old");
    fs::permissions(target, fs::perms(0604));
    fs::create_symlink("film", link);
    {
        const Replacement unfinished(link);
        std::ofstream(unfinished.path()) << "half";
        EXPECT_EQ(unfinished.path().parent_path(), scratch.path());
        EXPECT_EQ(read_text(target), "old");
    }
    EXPECT_EQ(scratch.names().size(), 2u);
    Replacement finished(link);
    std::ofstream(finished.path()) << "whole";
    finished.put_in_place();
    EXPECT_EQ(read_text(target), "whole");
    EXPECT_EQ(fs::status(target).permissions(), fs::perms(0604));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(scratch.names().size(), 2u);
    EXPECT_THAT(error_of([] { const Replacement of_device("/dev/null"); }),
                HasSubstr("it is a pipe or a device"));
}

TEST(AtomicWrite, ChecksWithoutATrace) {
    const ScratchDirectory scratch;
    check_writable(scratch / "later.png");
    EXPECT_TRUE(scratch.names().empty());
    write_text(scratch / "there.png", "old");
    check_writable(scratch / "there.png");
    EXPECT_EQ(read_text(scratch / "there.png"), "old");
    check_writable("/dev/null");
    EXPECT_THAT(error_of([&] { check_writable(scratch / "missing/x.png"); }),
                HasSubstr("does not exist"));
}

} // namespace
