#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "isolux/io/schemas.h"

namespace isolux {
namespace {

TEST(Schemas, AreThePublishedFilesByteForByte) {
    ASSERT_FALSE(schema_names().empty());
    for (const std::string& name : schema_names()) {
        std::ostringstream published;
        published << std::ifstream(ISOLUX_SOURCE_DIR "/schema/" + name + ".schema.json",
                                   std::ios::binary)
                         .rdbuf();
        EXPECT_FALSE(published.str().empty()) << name;
        EXPECT_EQ(find_schema(name), published.str()) << name;
    }
}

TEST(Schemas, DoNotExistUnderOtherNames) {
    EXPECT_EQ(find_schema("luminaire"), std::nullopt);
    EXPECT_EQ(find_schema(""), std::nullopt);
}

} // namespace
} // namespace isolux
