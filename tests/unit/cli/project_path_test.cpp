#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "isolux/base/error.h"
#include "isolux/cli/project_path.h"

namespace isolux {
namespace {

namespace fs = std::filesystem;

class FindProjectFile : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir())
                  / ("isolux-path-" + std::to_string(getpid()) + "-"
                     + testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder_);
    }

    void TearDown() override { fs::remove_all(folder_); }

    void touch(const char* name) const {
        fs::create_directories((folder_ / name).parent_path());
        std::ofstream(folder_ / name) << "{}";
    }

    [[nodiscard]] std::string in_folder(const char* name) const {
        return (folder_ / name).string();
    }

    [[nodiscard]] static std::string message_for(const std::string& argument) {
        try {
            return find_project_file(argument).string();
        } catch (const InputError& e) {
            return e.what();
        }
    }

    fs::path folder_;
};

TEST_F(FindProjectFile, TakesAFileAsItIs) {
    touch("office.json");
    EXPECT_EQ(find_project_file(in_folder("office.json")), folder_ / "office.json");
}

TEST_F(FindProjectFile, LooksIntoAFolder) {
    touch("project.json");
    EXPECT_EQ(find_project_file(folder_.string()), folder_ / "project.json");
    EXPECT_EQ(find_project_file(folder_.string() + "/"), folder_ / "project.json");
}

TEST_F(FindProjectFile, PointsAtTheOnlyOtherProjectInTheFolder) {
    touch("office.json");
    touch("readme.txt");
    EXPECT_EQ(message_for(folder_.string()),
              folder_.string() + ": no project.json in this folder. Did you mean "
                  + in_folder("office.json") + "?");
    touch("hall.json");
    EXPECT_EQ(message_for(folder_.string()),
              folder_.string()
                  + ": no project.json in this folder. Name the project file itself");
}

TEST_F(FindProjectFile, SuggestsASimilarName) {
    touch("offices/project.json");
    EXPECT_EQ(message_for(in_folder("ofices")),
              in_folder("ofices") + ": no such file or folder. Did you mean "
                  + in_folder("offices") + "?");
    EXPECT_EQ(message_for(in_folder("ofices/")),
              in_folder("ofices/") + ": no such file or folder. Did you mean "
                  + in_folder("offices") + "?");
}

TEST_F(FindProjectFile, DoesNotSuggestAStrangerInTheSameFolder) {
    touch("hall.json");
    EXPECT_EQ(message_for(in_folder("offices")),
              in_folder("offices") + ": no such file or folder");
}

TEST_F(FindProjectFile, SaysSoWhenNothingIsThere) {
    EXPECT_EQ(message_for("/nowhere/at/all.json"),
              "/nowhere/at/all.json: no such file or folder");
}

} // namespace
} // namespace isolux
