#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "isolux/io/schema.h"

#include "support/source_dir.h"

namespace isolux {
namespace {

std::string read_source_file(const std::string& name) {
    std::ifstream file(isolux::test::source_dir().string() + "/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Schema, IsThePublishedFileByteForByte) {
    ASSERT_FALSE(results_schema().empty());
    EXPECT_EQ(results_schema(), read_source_file("schema/results.schema.json"));
    EXPECT_EQ(standard_schema(), read_source_file("schema/standard.schema.json"));
    EXPECT_EQ(project_schema(), read_source_file("schema/project.schema.json"));
}

} // namespace
} // namespace isolux
