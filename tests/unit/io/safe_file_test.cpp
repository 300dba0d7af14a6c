#include <csignal>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "isolux/io/safe_file.h"

#include "support/temporary_folder.h"

namespace isolux {
namespace {

using test::read_bytes;
using testing::ElementsAre;

std::string message_of(const std::filesystem::path& path) {
    try {
        write_file_safely(path, "text");
    } catch (const WriteError& error) {
        return error.what();
    }
    return "no error";
}

TEST(SafeFile, WritesNewAndReplacesOldFiles) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "results.json";
    write_file_safely(path, "old");
    write_file_safely(path, std::string("new\0text", 8));
    EXPECT_EQ(read_bytes(path), std::string("new\0text", 8));
    EXPECT_THAT(folder.names(), ElementsAre("results.json"));
}

TEST(SafeFile, LeavesThePermissionsToTheUsersMask) {
    const test::TemporaryFolder folder;
    const mode_t mask = ::umask(0027);
    write_file_safely(folder.path() / "a", "");
    ::umask(mask);

    struct stat status {};

    ASSERT_EQ(::stat((folder.path() / "a").c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777U, 0640U);
}

TEST(SafeFile, TakesNamesOfAnyScript) {
    const test::TemporaryFolder folder;
    write_file_safely(folder.path() / "Büro 机房 \"1\".csv", "x");
    EXPECT_EQ(read_bytes(folder.path() / "Büro 机房 \"1\".csv"), "x");
}

TEST(SafeFile, SaysThatTheFolderIsMissing) {
    const test::TemporaryFolder folder;
    const std::string path = (folder.path() / "none" / "a.csv").string();
    EXPECT_EQ(message_of(path),
              path + ": cannot be written (No such file or directory). Does the folder exist?");
}

TEST(SafeFile, SaysThatAFileStandsWhereAFolderShould) {
    const test::TemporaryFolder folder;
    write_file_safely(folder.path() / "file", "x");
    const std::string path = (folder.path() / "file" / "a.csv").string();
    EXPECT_EQ(message_of(path),
              path + ": cannot be written (Not a directory). Does the folder exist?");
}

TEST(SafeFile, SaysThatAFolderIsInTheWayAndCleansUp) {
    const test::TemporaryFolder folder;
    const std::string path = (folder.path() / "maps").string();
    std::filesystem::create_directory(path);
    EXPECT_EQ(
        message_of(path),
        path + ": cannot be written (Is a directory). Is a folder of this name in the way?");
    EXPECT_THAT(folder.names(), ElementsAre("maps"));
}

TEST(SafeFile, HasASuggestionForAFullDiskAndForForbiddenFolders) {
    const auto text = [](std::errc why) {
        return std::string(WriteError("out/a.csv", std::make_error_code(why)).what());
    };
    EXPECT_EQ(text(std::errc::no_space_on_device),
              "out/a.csv: cannot be written (No space left on device). Free some space, or "
              "write to another disk?");
    EXPECT_EQ(text(std::errc::permission_denied),
              "out/a.csv: cannot be written (Permission denied). Write to a folder of your "
              "own?");
    EXPECT_EQ(text(std::errc::io_error),
              "out/a.csv: cannot be written (Input/output error). Is the disk all right?");
}

/// Runs `f` in a child process; its exit status, or minus the signal that ended it.
template <class F> int in_child(F&& f) {
    const pid_t child = ::fork();
    if (child == 0)
        ::_exit(f());
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(SafeFile, KeepsTheOldFileWhenTheNewOneDoesNotFit) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "results.json";
    write_file_safely(path, "old");
    const int status = in_child([&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{100'000, 100'000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_file_safely(path, std::string(1'000'000, 'x'));
        } catch (const WriteError& error) {
            return error.code() == std::errc::file_too_large ? 7 : 8;
        }
        return 9;
    });
    EXPECT_EQ(status, 7);
    EXPECT_EQ(read_bytes(path), "old");
    EXPECT_THAT(folder.names(), ElementsAre("results.json"));
}

TEST(SafeFile, IsNeverHalfWrittenHoweverTheProgramIsKilled) {
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "results.json";
    const std::string a(3'000'000, 'a');
    const std::string b(2'000'000, 'b');
    write_file_safely(path, a);
    for (int i = 0; i < 12; ++i) {
        const pid_t child = ::fork();
        if (child == 0)
            for (;;) {
                write_file_safely(path, b);
                write_file_safely(path, a);
            }
        ::usleep(static_cast<useconds_t>(1000 + 1700 * i));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        const std::string found = read_bytes(path);
        EXPECT_TRUE(found == a || found == b) << found.size() << " bytes";
    }
    for (const std::string& name : folder.names())
        EXPECT_TRUE(name == "results.json" || (name.front() == '.' && name.ends_with(".tmp")))
            << name;
}

TEST(MakeFolder, MakesAllThatIsMissingAndRefusesAFile) {
    const test::TemporaryFolder folder;
    make_folder(folder.path() / "a" / "b");
    make_folder(folder.path() / "a" / "b");
    EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "a" / "b"));
    write_file_safely(folder.path() / "file", "x");
    EXPECT_THROW(make_folder(folder.path() / "file"), WriteError);
    EXPECT_THROW(make_folder(folder.path() / "file" / "c"), WriteError);
}

} // namespace
} // namespace isolux
