#include <fstream>
#include <iterator>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/base/error.h"
#include "isolux/io/schema.h"
#include "isolux/io/schema_check.h"
#include "isolux/io/standard_json.h"

#include "support/source_dir.h"

namespace isolux {
namespace {

using testing::HasSubstr;

std::string read_source_file(const std::string& name) {
    std::ifstream file(isolux::test::source_dir().string() + "/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string tiny(const std::string& column, const std::string& row) {
    return R"({"isolux_standard": 1, "name": "T", "sources": [{"key": "k", "text": "t"}],
 "columns": [{"symbol": "Em", "quantity": "illuminance", "area": "task", "statistic": "mean",
   "sense": "at least", "unit": "lx", "clause": "1", "name": "mean")"
           + column + R"(}],
 "rows": [{"id": "a", "clause": "2", "task": "work", "limits": {"Em": 500}, "source": "k")"
           + row + "}]}";
}

std::string complaint(const std::string& text) {
    try {
        static_cast<void>(parse_standard(text, "t.json"));
    } catch (const InputError& e) {
        return e.what();
    }
    return "";
}

TEST(StandardJson, ReadsTheShippedStandardsAndTheyMatchTheSchema) {
    for (const char* name : {"en-12464-1-2021", "en-12464-2-2014", "en-1838-2013"}) {
        const std::string text = read_source_file("standards/" + std::string(name) + ".json");
        for (const SchemaFinding& f : check_schema(standard_schema(), text))
            ADD_FAILURE() << name << f.pointer << ": " << f.reason;
        EXPECT_EQ(complaint(text), "");
    }
    EXPECT_EQ(builtin_standards().size(), 3U);
}

TEST(StandardJson, HoldsTheNumbersThatTheValidationCasesState) {
    const Standard emergency = builtin_standards()[2];
    const StandardRow* centre = find_row(emergency, "route-centre");
    const StandardRow* open = find_row(emergency, "open-area");
    ASSERT_NE(centre, nullptr);
    ASSERT_NE(open, nullptr);
    EXPECT_EQ(find_limit(*centre, "Emin"), 1.0);
    EXPECT_EQ(find_limit(*centre, "Ratio"), 40.0);
    EXPECT_EQ(find_limit(*open, "Emin"), 0.5);
    for (const Requirement& r : requirements_of(emergency, *centre, RowLevel::required))
        if (r.quantity == RequiredQuantity::illuminance) {
            EXPECT_EQ(r.light, LightShare::direct);
            EXPECT_FALSE(r.is_recalled);
        }
}

TEST(StandardJson, FollowsFromTheTaskToItsSurroundingsInEveryRow) {
    const Standard s = builtin_standards()[0];
    EXPECT_GT(s.rows.size(), 100U);
    for (const StandardRow& row : s.rows) {
        const double em = find_limit(row, "Em").value_or(0.0);
        const double expected = em >= 750   ? 500
                                : em >= 500 ? 300
                                : em >= 300 ? 200
                                : em >= 200 ? 150
                                            : em;
        EXPECT_EQ(find_limit(row, "Es"), expected) << row.id;
        EXPECT_NEAR(*find_limit(row, "Eb"), expected / 3, 0.06) << row.id;
        EXPECT_GE(find_limit(row, "Em_modified").value_or(1e9), em) << row.id;
    }
}

TEST(StandardJson, MarksWhatIsRecalled) {
    const Standard s = builtin_standards()[0];
    const auto asked = requirements_of(s, *find_row(s, "34.2"), RowLevel::required);
    for (const Requirement& r : asked)
        EXPECT_EQ(r.is_recalled, r.source.find("not compared") != std::string::npos)
            << r.symbol;
}

TEST(StandardJson, ComplainsAboutWordsAndNamesItDoesNotKnow) {
    EXPECT_EQ(complaint(tiny("", "")), "");
    EXPECT_THAT(complaint(tiny(R"(, "with": "Em")", "")),
                HasSubstr("t.json:2: #/columns/0: \"with\" and \"limit\" go together"));
    EXPECT_THAT(
        complaint(tiny(R"(, "raises": "Ez")", "")),
        HasSubstr("t.json:2: #/columns/0: unknown column \"Ez\" (the file has no such one)"));
    EXPECT_THAT(complaint(tiny("", R"(, "sources": {"Em": "kk"})")),
                HasSubstr("t.json:4: #/rows/0: unknown source \"kk\""));
    std::string text = tiny("", "");
    text.replace(text.find("illuminance"), 11, "iluminance");
    EXPECT_THAT(
        complaint(text),
        HasSubstr("t.json:2: #/columns/0/quantity: unknown quantity \"iluminance\" (nothing "
                  "like it can be judged). Did you mean \"illuminance\"?"));
    EXPECT_THAT(complaint(R"({"isolux_standard": 2, "name": "T"})"),
                HasSubstr("this version of the format is not known"));
}

TEST(StandardJson, ComplainsAboutARowThatStandsTwice) {
    std::string text = tiny("", "");
    const std::size_t row = text.find("{\"id\"");
    const std::string copy = text.substr(row, text.rfind(']') - row);
    text.insert(text.rfind(']'), "," + copy);
    EXPECT_THAT(complaint(text), HasSubstr("t.json:4: #/rows/1: the row \"a\" stands twice"));
}

} // namespace
} // namespace isolux
