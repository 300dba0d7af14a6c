#include <filesystem>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/io/project_json.h"

#include "support/temporary_folder.h"

namespace isolux::test {
namespace {

/// Replaces, removes, repeats or swaps some bytes, or cuts the end off.
std::string mutate(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : random() % n; };
    const std::string interesting = "{}[]\",:-+.e0123456789 \n\\/\x80\xff";
    for (std::size_t times = 1 + below(4); times > 0 && !bytes.empty(); --times) {
        const std::size_t at = below(bytes.size());
        switch (below(5)) {
        case 0:
            bytes[at] = interesting[below(interesting.size())];
            break;
        case 1:
            bytes.erase(at, 1 + below(8));
            break;
        case 2:
            bytes.insert(below(bytes.size()), bytes.substr(at, 1 + below(30)));
            break;
        case 3:
            std::swap(bytes[at], bytes[below(bytes.size())]);
            break;
        default:
            if (below(4) == 0)
                bytes.resize(at);
            else
                bytes.insert(at, 1, interesting[below(interesting.size())]);
        }
    }
    return bytes;
}

TEST(ReadProject, AnswersEveryMutationWithAProjectOrAnInputError) {
    constexpr int mutations = 200; // of each file, the same in every run
    const std::string corpus = std::string(ISOLUX_SOURCE_DIR) + "/tests/fuzz/corpus/project";
    int projects = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
        const std::string bytes = read_bytes(entry.path());
        std::mt19937 random(20240101);
        for (int i = 0; i < mutations; ++i) {
            try {
                static_cast<void>(
                    parse_project(mutate(bytes, random), "no-such-folder/project.json"));
                ++projects;
            } catch (const InputError&) {
                continue; // told to the user
            }
        }
    }
    EXPECT_GT(projects, 50) << "the mutations should leave some projects readable";
}

} // namespace
} // namespace isolux::test
