#include <filesystem>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/io/project_json.h"

#include "support/source_dir.h"
#include "support/temporary_folder.h"

namespace isolux::test {
namespace {

using Random = std::mt19937;

std::size_t below(std::size_t n, Random& random) { return n == 0 ? 0 : random() % n; }

/// Gives some digits other values: still JSON, with other numbers.
std::string change_numbers(std::string bytes, Random& random) {
    for (std::size_t times = 1 + below(3, random); times > 0;) {
        char& c = bytes[below(bytes.size(), random)];
        if (c < '0' || c > '9')
            continue;
        c = static_cast<char>('0' + below(10, random));
        --times;
    }
    return bytes;
}

/// Replaces, removes, repeats or swaps some bytes, or cuts the end off: seldom still JSON.
std::string change_bytes(std::string bytes, Random& random) {
    const std::string interesting = "{}[]\",:-+.e0123456789 \n\\/\x80\xff";
    for (std::size_t times = 1 + below(4, random); times > 0 && !bytes.empty(); --times) {
        const std::size_t at = below(bytes.size(), random);
        switch (below(5, random)) {
        case 0:
            bytes[at] = interesting[below(interesting.size(), random)];
            break;
        case 1:
            bytes.erase(at, 1 + below(8, random));
            break;
        case 2:
            bytes.insert(below(bytes.size(), random), bytes.substr(at, 1 + below(30, random)));
            break;
        case 3:
            std::swap(bytes[at], bytes[below(bytes.size(), random)]);
            break;
        default:
            bytes.resize(at);
        }
    }
    return bytes;
}

TEST(ReadProject, AnswersEveryMutationWithAProjectOrAnInputError) {
    constexpr int mutations = 200; // of each file, the same in every run
    const std::string corpus =
        isolux::test::source_dir().string() + "/tests/fuzz/corpus/project";
    int projects = 0;
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
        const std::string bytes = read_bytes(entry.path());
        Random random(20240101);
        for (int i = 0; i < mutations; ++i) {
            const bool keeps_digits =
                i % 2 == 0 || bytes.find_first_of("0123456789") == bytes.npos;
            const std::string text =
                keeps_digits ? change_bytes(bytes, random) : change_numbers(bytes, random);
            try {
                static_cast<void>(parse_project(text, "no-such-folder/project.json"));
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
