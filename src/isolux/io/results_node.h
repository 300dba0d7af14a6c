#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "isolux/base/estimate.h"
#include "isolux/base/vec.h"

namespace isolux {

/// A value of a results file and its place in it, for messages. Looks at JSON that someone else
/// holds. Every reader of a value throws InputError where the value is of another kind.
class ResultsNode {
public:
    /// @param json  an nlohmann::json, which no header of ours may name; outlives the node
    ResultsNode(const void* json, const std::string& source, std::string pointer = "")
        : json_(json), source_(&source), pointer_(std::move(pointer)) {}

    /// @throws InputError  always: `source#/pointer: what`
    [[noreturn]] void fail(const std::string& what) const;

    [[nodiscard]] std::optional<ResultsNode> find(const char* key) const;
    [[nodiscard]] ResultsNode at(const char* key) const;
    [[nodiscard]] std::vector<ResultsNode> items() const;
    [[nodiscard]] double number() const;
    [[nodiscard]] std::vector<double> numbers() const;
    [[nodiscard]] std::uint64_t count() const;
    [[nodiscard]] bool boolean() const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] Vector3 vector() const;
    [[nodiscard]] Point3 point() const;

    /// As written, without normalising again: every bit survives.
    [[nodiscard]] UnitVector3 direction() const;

    [[nodiscard]] Estimate estimate() const;

private:
    const void* json_;
    const std::string* source_;
    std::string pointer_;
};

} // namespace isolux
