#include "isolux/io/json_build.h"

#include <cmath>
#include <utility>

namespace isolux {

JsonValue json_text(std::string text) {
    JsonValue v;
    v.kind = JsonValue::Kind::text;
    v.text = std::move(text);
    return v;
}

JsonValue json_number(double number) {
    JsonValue v;
    v.kind = JsonValue::Kind::number;
    v.is_integer = number == std::floor(number);
    v.number = number;
    return v;
}

JsonValue json_object(std::vector<JsonMember> members) {
    JsonValue v;
    v.kind = JsonValue::Kind::object;
    v.members = std::move(members);
    return v;
}

} // namespace isolux
