#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/source_dir.h"

namespace isolux::test {
namespace {

namespace fs = std::filesystem;

const fs::path root = isolux::test::source_dir();

std::string read_text(const fs::path& path) {
    std::ifstream stream(path);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::vector<std::string> find_all(const std::string& text, const char* pattern) {
    const std::regex regex(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i)
        found.push_back((*i)[1]);
    return found;
}

std::vector<fs::path> documents() {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(root))
        if (entry.path().extension() == ".md")
            found.push_back(entry.path());
    for (const char* folder : {"docs", "projects", "luminaires"}) {
        if (!fs::exists(root / folder))
            continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / folder))
            if (entry.path().extension() == ".md")
                found.push_back(entry.path());
    }
    return found;
}

TEST(Documents, LinkToFilesThatExist) {
    std::size_t links = 0;
    for (const auto& document : documents()) {
        for (const auto& target : find_all(read_text(document), R"(\]\(([^)#\s]+)[^)]*\))")) {
            if (target.find("://") != std::string::npos)
                continue;
            ++links;
            EXPECT_TRUE(fs::exists(document.parent_path() / target))
                << document << " links to " << target;
        }
    }
    EXPECT_GT(links, 5U);
}

/// `scene/luminaire.h`, `tests/package/stranger`, ...: in back quotes, with a slash.
TEST(Documents, NameFilesThatExist) {
    std::size_t names = 0;
    for (const char* document : {"ARCHITECTURE.md", "CONTRIBUTING.md", "README.md"}) {
        for (const auto& name :
             find_all(read_text(root / document), R"(`([a-z_]+/[a-z_/]+(?:\.[a-z.]+)?)`)")) {
            if (name.starts_with("maps/") || name.starts_with("build/")
                || name.starts_with("results/"))
                continue;
            ++names;
            EXPECT_TRUE(fs::exists(root / name) || fs::exists(root / "src/isolux" / name))
                << document << " names " << name;
        }
    }
    EXPECT_GT(names, 20U);
}

} // namespace
} // namespace isolux::test
