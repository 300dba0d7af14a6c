#include "isolux/io/schema_check.h"

#include <algorithm>

// valijson's headers compile slowly: they stay in this file. It validates nlohmann's own
// documents, which is why that header is here a second time.
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "isolux/io/json_node.h"
#include "isolux/io/schema.h"

namespace isolux {

namespace {

using Adapter = valijson::adapters::NlohmannJsonAdapter;

/// valijson names a place as {"<root>", "[rooms]", "[0]"}.
std::string pointer_of(const std::vector<std::string>& context) {
    std::string pointer;
    for (std::size_t i = 1; i < context.size(); ++i) {
        std::string_view step = context[i];
        if (step.size() >= 2 && step.front() == '[' && step.back() == ']')
            step = step.substr(1, step.size() - 2);
        pointer += pointer_step(step);
    }
    return pointer;
}

bool is_below(const SchemaFinding& inner, const SchemaFinding& outer) {
    return inner.pointer.size() > outer.pointer.size()
           && inner.pointer.compare(0, outer.pointer.size(), outer.pointer) == 0
           && inner.pointer[outer.pointer.size()] == '/';
}

} // namespace

std::vector<SchemaFinding> check_project_schema(std::string_view text) {
    return check_schema(project_schema(), text);
}

std::vector<SchemaFinding> check_schema(std::string_view schema_text, std::string_view text) {
    const nlohmann::json schema_document = nlohmann::json::parse(schema_text);
    valijson::Schema schema;
    valijson::SchemaParser parser;
    parser.populateSchema(Adapter(schema_document), schema);

    const nlohmann::json document = nlohmann::json::parse(text, nullptr, true, true);
    valijson::ValidationResults results;
    valijson::Validator validator;
    if (validator.validate(schema, Adapter(document), &results))
        return {};

    constexpr std::size_t enough = 1000;
    std::vector<SchemaFinding> all;
    valijson::ValidationResults::Error error;
    while (all.size() < enough && results.popError(error))
        all.push_back({pointer_of(error.context), error.description});
    std::vector<SchemaFinding> deepest;
    for (const SchemaFinding& finding : all) {
        const auto hides = [&](const SchemaFinding& other) { return is_below(other, finding); };
        const auto is_same = [&](const SchemaFinding& other) {
            return other.pointer == finding.pointer;
        };
        if (std::none_of(all.begin(), all.end(), hides)
            && std::none_of(deepest.begin(), deepest.end(), is_same))
            deepest.push_back(finding);
    }
    return deepest;
}

} // namespace isolux
