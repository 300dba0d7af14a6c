#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "isolux/scene/material.h"

#include "support/source_dir.h"

/// The code names equations and sections of METHODS.md; here every name is looked up.
namespace isolux::test {
namespace {

std::string read_text(const std::filesystem::path& path) {
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

/// What METHODS.md offers to be named: "eq. (12)", "3.5", "Grid statistics".
std::set<std::string> names_in(const std::string& methods) {
    std::set<std::string> names;
    std::istringstream lines(methods);
    for (std::string line; std::getline(lines, line);) {
        for (const auto& number : find_all(line, R"(^ .*\s\((\d+)\)$)"))
            names.insert("eq. (" + number + ")");
        for (const auto& title : find_all(line, R"(^#+ [\d.]*\s?(.*)$)"))
            names.insert(title);
        for (const auto& number : find_all(line, R"(^#+ ([\d.]+) )"))
            names.insert(number);
        for (const auto& title : find_all(line, R"(\*\*([^*]+)\.\*\*)"))
            names.insert(title);
    }
    return names;
}

/// A source file with its comments' line breaks undone.
std::string flattened(const std::filesystem::path& path) {
    return std::regex_replace(read_text(path), std::regex(R"(\n\s*//[/!]?\s*)"), " ");
}

/// What one place that says METHODS names: a run of titles and equations, up to other words.
std::vector<std::string> names_cited(const std::string& text) {
    std::vector<std::string> cited;
    const char* const run =
        R"(METHODS(?:\.md)?((?:[,\s]|and |or |to |says |eq\. |\(\d+\)|\d\.\d|"[^"\n]{2,60}")+))";
    for (const auto& words : find_all(text, run)) {
        for (const auto& title : find_all(words, R"rx("([^"]+)")rx"))
            cited.push_back(title);
        for (const auto& number : find_all(words, R"(\((\d+)\))"))
            cited.push_back("eq. (" + number + ")");
        for (const auto& number : find_all(words, R"(\s(\d\.\d))"))
            cited.push_back(number);
    }
    return cited;
}

bool is_source(const std::filesystem::path& path) {
    return path.extension() == ".h" || path.extension() == ".cpp";
}

TEST(Methods, HasEveryEquationAndSectionThatTheCodeNames) {
    const std::filesystem::path root = isolux::test::source_dir();
    const std::set<std::string> known = names_in(read_text(root / "METHODS.md"));
    std::size_t citations = 0;
    for (const char* house : {"src", "viz", "tests"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / house)) {
            if (!is_source(entry.path()) || entry.path().parent_path().stem() == "documents")
                continue;
            for (const auto& name : names_cited(flattened(entry.path()))) {
                ++citations;
                EXPECT_TRUE(known.contains(name))
                    << entry.path() << " names METHODS " << name << ", which is not there";
            }
        }
    }
    EXPECT_GT(citations, 20U);
}

TEST(Methods, ReadsNamesOutOfSentences) {
    EXPECT_EQ(names_cited("METHODS \"Slab\" and METHODS eq. (5), (10): all; METHODS 3.5 (i)"),
              (std::vector<std::string>{"Slab", "eq. (5)", "eq. (10)", "3.5"}));
    EXPECT_EQ(names_in("## 2 Light\n**Slab.** Thin\n    E = mc2   (7)\n"),
              (std::set<std::string>{"2", "Light", "Slab", "eq. (7)"}));
}

TEST(Methods, ListsTheEverydayMaterialsWithTheirValues) {
    const std::string methods = read_text(isolux::test::source_dir() / "METHODS.md");
    for (const Material& material : everyday_materials()) {
        std::string entry;
        if (const auto* opaque = std::get_if<Opaque>(&material.scattering))
            entry = opaque->mirror > 0.0
                        ? fmt::format("{} {} (mirror)", material.name, opaque->mirror)
                        : fmt::format("{} {}", material.name, opaque->diffuse.g);
        else
            entry =
                fmt::format("{} (pane, tau {})",
                            material.name,
                            std::get<ClearPane>(material.scattering).internal_transmittance);
        EXPECT_NE(methods.find(entry), std::string::npos) << entry;
    }
}

TEST(Methods, NumbersNoEquationTwice) {
    std::set<std::string> seen;
    std::istringstream lines(read_text(isolux::test::source_dir() / "METHODS.md"));
    for (std::string line; std::getline(lines, line);) {
        for (const auto& number : find_all(line, R"(^ .*\s\((\d+)\)$)"))
            EXPECT_TRUE(seen.insert(number).second) << "eq. (" << number << ") stands twice";
    }
    EXPECT_GT(seen.size(), 20U);
}

} // namespace
} // namespace isolux::test
