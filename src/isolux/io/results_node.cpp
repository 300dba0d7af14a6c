#include "isolux/io/results_node.h"

#include <nlohmann/json.hpp>

#include "isolux/base/error.h"

namespace isolux {

namespace {

const nlohmann::json& as_json(const void* json) {
    return *static_cast<const nlohmann::json*>(json);
}

} // namespace

void ResultsNode::fail(const std::string& what) const {
    throw InputError(
        *source_ + "#" + pointer_, what, "Is this the results.json of an isolux calculation?");
}

std::optional<ResultsNode> ResultsNode::find(const char* key) const {
    if (!as_json(json_).is_object())
        fail("not an object");
    const auto found = as_json(json_).find(key);
    if (found == as_json(json_).end())
        return std::nullopt;
    return ResultsNode(&*found, *source_, pointer_ + "/" + key);
}

ResultsNode ResultsNode::at(const char* key) const {
    if (const std::optional<ResultsNode> member = find(key))
        return *member;
    fail(std::string("'") + key + "' is missing");
}

std::vector<ResultsNode> ResultsNode::items() const {
    const nlohmann::json& json = as_json(json_);
    if (!json.is_array())
        fail("not a list");
    std::vector<ResultsNode> nodes;
    nodes.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i)
        nodes.emplace_back(&json[i], *source_, pointer_ + "/" + std::to_string(i));
    return nodes;
}

double ResultsNode::number() const {
    if (!as_json(json_).is_number())
        fail("not a number");
    return as_json(json_).get<double>();
}

std::vector<double> ResultsNode::numbers() const {
    std::vector<double> values;
    for (const ResultsNode& item : items())
        values.push_back(item.number());
    return values;
}

std::uint64_t ResultsNode::count() const {
    if (!as_json(json_).is_number_unsigned())
        fail("not a whole number");
    return as_json(json_).get<std::uint64_t>();
}

bool ResultsNode::boolean() const {
    if (!as_json(json_).is_boolean())
        fail("neither true nor false");
    return as_json(json_).get<bool>();
}

std::string ResultsNode::text() const {
    if (!as_json(json_).is_string())
        fail("not a text");
    return as_json(json_).get<std::string>();
}

Vector3 ResultsNode::vector() const {
    if (!as_json(json_).is_array() || as_json(json_).size() != 3)
        fail("not three numbers");
    const std::vector<double> c = numbers();
    return {c[0], c[1], c[2]};
}

Point3 ResultsNode::point() const {
    const Vector3 v = vector();
    return {v.x, v.y, v.z};
}

UnitVector3 ResultsNode::direction() const { return UnitVector3::from_unit(vector()); }

Estimate ResultsNode::estimate() const {
    return {at("value").number(), at("standard_error").number(), at("replicates").count()};
}

} // namespace isolux
